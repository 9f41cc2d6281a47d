// The formulas of Yee 2000, section 5.4, against known values.

#include "perception/vision/band_frequencies.h"
#include "perception/vision/retinal_velocity.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

double csf(double rho, double v) {
    return written_thesis_sensitivity(rho, v);
}
double csf_max(double v) {
    return csf(written_thesis_peak(v), v);
}

TEST(Sensitivity, KnownPeaks) {
    EXPECT_NEAR(csf_max(0.15), 245.436, 5e-4);
    EXPECT_NEAR(written_thesis_peak(0.15), 4.835, 5e-4);

    double best = 0.0, at = 0.0;
    for (double v = 0.15; v < 5.0; v += 1e-4) {
        if (csf_max(v) > best) best = csf_max(v), at = v;
    }
    EXPECT_NEAR(best, 250.751, 5e-4);
    EXPECT_NEAR(at, 0.926, 2e-3);
}

TEST(Sensitivity, Eq57_LogarithmIsBaseTen) {
    EXPECT_NEAR(csf(4.835, 0.15), 245.4, 0.1);  // with the natural logarithm: 1882
}

TEST(Sensitivity, Eq510_PeakIsWhereGoldenSectionFindsIt) {
    const double shrink = (std::sqrt(5.0) - 1) / 2;
    for (const double v : {0.15, 0.926, 3.0, 20.0, 80.0, 500.0}) {
        double low = 1e-4, high = 20.0;
        for (int i = 0; i < 200; ++i) {
            const double a = high - shrink * (high - low), b = low + shrink * (high - low);
            (csf(a, v) < csf(b, v) ? low : high) = csf(a, v) < csf(b, v) ? a : b;
        }
        EXPECT_NEAR(csf((low + high) / 2, v) / csf_max(v), 1.0, 1e-6) << v;
        EXPECT_NEAR((low + high) / 2 / written_thesis_peak(v), 1.0, 1e-4) << v;
        EXPECT_NEAR(thesis_elevation(1e4, v) / csf_max(v), 1.0, 2e-5) << v;  // of what is too fine to be seen
    }
}

TEST(Elevation, KnownValuesAt16CyclesPerDegree) {
    EXPECT_NEAR(thesis_elevation(16, 1), 239, 0.5);
    EXPECT_NEAR(thesis_elevation(16, 5), 170, 0.5);
    EXPECT_NEAR(thesis_elevation(16, 20), 125, 0.5);
    EXPECT_NEAR(thesis_elevation(16, 80), 91, 0.5);
}

TEST(Elevation, Eq59_ContinuousAtThePeakAndNeverBelowOne) {
    for (double v = 0.15; v < 1e3; v *= 1.7) {
        const double peak = written_thesis_peak(v);
        EXPECT_NEAR(thesis_elevation(peak, v), 1.0, 1e-6);
        EXPECT_NEAR(thesis_elevation(peak * (1 + 1e-6), v), 1.0, 1e-5);
        double previous = 1.0;
        for (double rho = peak; rho < 64; rho *= 1.02) {
            EXPECT_GE(thesis_elevation(rho, v), previous * (1 - 4e-6)) << "rises with frequency";
            previous = thesis_elevation(rho, v);
        }
    }
}

TEST(Elevation, Eq511_BoundedForEveryVelocityThoughNotMonotone) {
    double highest = 0.0;
    for (double v = 0.15; v < 1e30; v *= 1.01) {
        for (const double rho : band_frequencies(Bands::printed, 31.0)) {
            const double f = thesis_elevation(rho, v);
            ASSERT_GE(f, 1.0) << rho << " " << v;
            ASSERT_LE(f, highest_aleph) << rho << " " << v;
            highest = std::max(highest, f);
        }
    }
    // The supremum of the printed set: CSF(16) falls to 1 at a velocity above that of the maximum of CSF_max.
    EXPECT_NEAR(highest, 250.60, 0.02);
    EXPECT_GT(thesis_elevation(16, 1), thesis_elevation(16, 20));
    EXPECT_LT(thesis_elevation(16, 0.15), thesis_elevation(16, 1));
    EXPECT_EQ(thesis_elevation(16, 2e5), 1.0);  // no contrast is visible
}

float retinal_velocity(float image, float efficiency) {
    float out = 0.0f;
    retinal_velocity_row(&image, &efficiency, 1, &out);
    return out;
}

TEST(RetinalVelocity, Eq55_AtLeastTheDriftAndMonotone) {
    EXPECT_EQ(retinal_velocity(0.0f, 0.0f), 0.15f);
    EXPECT_EQ(retinal_velocity(0.0f, 1.0f), 0.15f);
    for (float s = 0.0f; s <= 1.0f; s += 0.05f) {
        float previous = 0.15f;
        for (float v = 0.0f; v < 1e6f; v = v * 1.1f + 0.01f) {
            const float r = retinal_velocity(v, s);
            ASSERT_GE(r, 0.15f);
            ASSERT_GE(r, previous) << "rises with image velocity";
            ASSERT_LE(r, retinal_velocity(v, std::max(0.0f, s - 0.05f))) << "falls with saliency";
            previous = r;
        }
    }
}

TEST(RetinalVelocity, Eq55_KnownValues) {
    EXPECT_NEAR(retinal_velocity(10.0f, 0.82f), 10 - (8.2 + 0.15), 1e-6);
    EXPECT_NEAR(retinal_velocity(10.0f, 0.0f), 9.85, 1e-6);
    EXPECT_EQ(retinal_velocity(200.0f, 1.0f), 120.0f);  // the eye follows at most 80 deg/s
    EXPECT_EQ(retinal_velocity(79.85f, 1.0f), 0.15f);   // as printed: -.15
}

TEST(BandFrequencies, BothSets) {
    const auto printed = band_frequencies(Bands::printed, 31.0);
    const double measured[] = {15.5, 3.27, 1.57, 0.79, 0.36, 0.18, 0.12};
    for (std::size_t i = 0; i < printed.size(); ++i) {
        EXPECT_DOUBLE_EQ(printed[i], std::ldexp(16.0, -static_cast<int>(i)));
        EXPECT_DOUBLE_EQ(band_frequencies(Bands::measured, 31.0)[i], measured[i]);
    }
}

}  // namespace
}  // namespace aleph
