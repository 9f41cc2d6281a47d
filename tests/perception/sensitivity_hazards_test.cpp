// CSF, elevation and the Aleph map with inputs for which the printed formulas have no finite result.

#include "engine/base/flush_denormals.h"
#include "engine/base/sampling.h"
#include "perception/aleph_map.h"
#include "perception/band_response.h"
#include "perception/perception.h"
#include "perception/sanitize.h"
#include "perception/vision/band_frequencies.h"
#include "perception/vision/kelly_vision.h"
#include "perception/vision/retinal_velocity.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

constexpr double largest = std::numeric_limits<float>::max();

float hazard_velocity(float image, float efficiency) {
    float out = 0.0f;
    retinal_velocity_row(&image, &efficiency, 1, &out);
    return out;
}

Image<float> constant_image(int width, int height, double value) {
    return Image<float>(width, height, static_cast<float>(value));
}

TEST(RetinalVelocity, Eq55_KnownValues) {
    EXPECT_NEAR(hazard_velocity(10.0f, 0.82f), 10 - (8.2 + 0.15), 1e-6);
    EXPECT_NEAR(hazard_velocity(10.0f, 0.0f), 9.85, 1e-6);
    EXPECT_EQ(hazard_velocity(200.0f, 1.0f), 120.0f);  // the eye follows at most 80 deg/s
    EXPECT_EQ(hazard_velocity(79.85f, 1.0f), 0.15f);   // as printed: -.15
}

TEST(SensitivityHard, CS01_RestAndEverythingBelowTheDriftIsTheDrift) {
    for (const double v : {0.0, -0.0, denormal, 1e-38, 0.1, 0.15}) {
        for (const double rho : {4.0, 16.0, 1e4})
            EXPECT_EQ(thesis_elevation(rho, v), thesis_elevation(rho, 0.15)) << rho << " " << v;
    }
    EXPECT_NEAR(thesis_elevation(16, 0), 9.25, 0.01);
}

TEST(SensitivityHard, CS02_NegativeAndNanVelocity) {
    for (const double v : {-1.2, -double{largest}, -infinity, not_a_number})
        EXPECT_EQ(thesis_elevation(16, v), thesis_elevation(16, 0.15)) << v;
    for (const float v : {-1.2f, -float_infinity, float_nan}) EXPECT_EQ(hazard_velocity(v, 0.5f), 0.15f) << v;
}

TEST(SensitivityHard, CS03_HugeVelocity) {
    for (const double v : {1e3, 1e5, 1e10, 1e30, largest, infinity}) {
        for (const double rho : {0.25, 1.0, 16.0, 1e3}) {
            EXPECT_GE(thesis_elevation(rho, v), 1.0) << rho << " " << v;
            EXPECT_LE(thesis_elevation(rho, v), 250.8) << rho << " " << v;
        }
    }
    EXPECT_EQ(thesis_elevation(1e4, infinity), thesis_elevation(1e4, 1e30));
    EXPECT_EQ(hazard_velocity(float_infinity, 0.0f), hazard_velocity(1e30f, 0.0f));
    EXPECT_EQ(hazard_velocity(1e30f, 1.0f), 1e30f);
    EXPECT_NEAR(thesis_elevation(16, 920), 32, 0.5);
}

TEST(SensitivityHard, CS04_SameBitsWithAndWithoutFlushToZero) {
    const auto rho = band_frequencies(Bands::printed, 31.0);
    std::vector<float> velocity;
    for (double v = 0.15; v < 1e6; v *= 1.05) velocity.push_back(static_cast<float>(v));
    KellyRow row(rho, static_cast<int>(velocity.size()));
    std::vector<float> plain(velocity.size()), flushed(velocity.size());
    for (int band = 0; band < band_count; ++band) {
        row.load({.retinal = velocity.data()});
        row.elevations(band, plain.data());
        {
            const FlushDenormals flush;
            row.load({.retinal = velocity.data()});
            row.elevations(band, flushed.data());
        }
        ASSERT_EQ(plain, flushed);
    }
}

TEST(SensitivityHard, CS05_ZeroAndOddFrequencies) {
    for (const double rho : {0.0, -0.0, denormal, -3.0, -infinity, not_a_number}) {
        EXPECT_EQ(thesis_elevation(rho, 5), 1.0) << rho;
    }
    for (const double rho : {1e3, 1e10, largest, infinity}) EXPECT_NEAR(thesis_elevation(rho, 5), 169.8, 0.05) << rho;
}

TEST(SensitivityHard, CS06_FrequenciesScaleWithPixelDensity) {
    const double at_31[] = {15.5, 3.27, 1.57, 0.79, 0.36, 0.18, 0.12};  // measured
    for (const double ppd : {15.0, 31.0, 60.0}) {
        const auto printed = band_frequencies(Bands::printed, ppd), measured = band_frequencies(Bands::measured, ppd);
        for (int i = 0; i < band_count; ++i) {
            EXPECT_DOUBLE_EQ(printed[i], 16 * std::pow(2.0, -i) * ppd / 31);
            EXPECT_DOUBLE_EQ(measured[i], at_31[i] * ppd / 31);
        }
    }
}

TEST(SensitivityHard, CS06_GratingAtAMeasuredPeakIsStrongestInThatBand) {
    const int width = 1024;
    for (const double ppd : {15.0, 31.0, 60.0}) {
        for (int band = 0; band < band_count; ++band) {
            const double cycles_per_degree = band_frequencies(Bands::measured, ppd)[band];
            Image<float> grating(width, 4);
            for (const auto [x, y] : all_pixels(width, 4)) {
                const double phase = 2 * std::numbers::pi * cycles_per_degree / ppd * (x + 0.5);
                grating(x, y) = static_cast<float>(0.5 + 0.4 * std::sin(phase));
            }
            const auto response = compute_band_response(grating);
            std::array<double, band_count> mean{};
            for (int x = 0; x < width; ++x) {
                for (std::size_t i = 0; i < mean.size(); ++i) mean[i] += response[i](x, 1) / width;
            }
            EXPECT_EQ(std::max_element(mean.begin(), mean.end()) - mean.begin(), band) << ppd;
        }
    }
}

TEST(SensitivityHard, CS07_UniformFrameHasOnlyTheCoarsestBand) {
    for (const double grey : {0.0, 1e-30, 0.1, 0.5, 1.0, 1e6}) {
        for (const auto& [width, height] : {std::pair{1, 1}, {640, 1}, {37, 23}, {128, 128}}) {
            const Image<Rgb> estimate(width, height, Rgb(static_cast<float>(grey)));
            for (const double v_i : {0.0, 5.0, 90.0, 130.0, 250.0}) {
                const PerceptionMaps maps =
                    compute_perception(estimate, constant_image(width, height, v_i), {}, {}, {.guide = Guide::full});
                const double expected =
                    written_elevation(&thesis_vision(), 0.25, {.retinal = written_retinal_velocity(v_i, 0.82)});
                for (const float aleph : maps.aleph.pixels) ASSERT_NEAR(aleph / expected, 1.0, 1e-5) << grey;
                if (written_retinal_velocity(v_i, 0.82) < 24.4) {
                    ASSERT_EQ(maps.aleph.pixels.front(), 1.0f) << v_i;
                }
                EXPECT_EQ(maps.clamped, 0u);
            }
        }
    }
    EXPECT_GT(thesis_elevation(0.25, written_retinal_velocity(250, 0.82)),
              5.0);  // the last case is not 1 for another reason
}

TEST(SensitivityHard, CS08_BoundsOnRandomImagesWithBrokenPixelsAndRandomMotion) {
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        RandomStream random({seed, 0, 0, 0});
        const int width = 20 + static_cast<int>(100 * random.next()),
                  height = 20 + static_cast<int>(80 * random.next());
        Image<Rgb> estimate(width, height);
        Image<float> velocity(width, height);
        for (std::size_t i = 0; i < estimate.size(); ++i) {
            const double exponent = 12 * random.next() - 8;
            estimate.pixels[i] =
                Rgb(random.next(), random.next(), random.next()) * static_cast<float>(std::pow(10.0, exponent));
            velocity.pixels[i] =
                random.next() < 0.5f ? 0.0f : static_cast<float>(std::pow(10.0, 6 * random.next() - 3));
            if (random.next() < 0.01f) estimate.pixels[i].y = float_nan;
            if (random.next() < 0.01f) estimate.pixels[i].x = float_infinity;
        }
        EXPECT_GT(sanitize_estimate(estimate).replaced, 0u);
        for (const Guide guide : {Guide::spatial, Guide::full, Guide::saliency}) {
            for (const Bands bands : {Bands::printed, Bands::measured}) {
                const PerceptionMaps maps =
                    compute_perception(estimate, velocity, {}, {}, {.guide = guide, .bands = bands});
                for (const float aleph : maps.aleph.pixels) ASSERT_TRUE(aleph >= 1.0f && aleph <= 250.8f) << aleph;
                EXPECT_EQ(maps.clamped, 0u);
            }
        }
    }
}

TEST(SensitivityHard, CS08_BrokenVelocitiesCountAsRestOrAsVeryFast) {
    Image<Rgb> checker(16, 16);
    for (const auto [x, y] : all_pixels(16, 16)) checker(x, y) = Rgb((x + y) % 2 == 0 ? 0.2f : 0.8f);
    const auto aleph_at = [&](double v) {
        return compute_perception(checker, constant_image(16, 16, v), {}, {}, {.guide = Guide::full}).aleph(8, 8);
    };
    for (const double v : {-5.0, -infinity, not_a_number, denormal, -0.0}) EXPECT_EQ(aleph_at(v), aleph_at(0.0)) << v;
    for (const double v : {largest, infinity, 1e30}) EXPECT_EQ(aleph_at(v), 1.0f) << v;
}

/// A model of a program's own whose elevations are out of range.
class BrokenVision final : public PlainVision {
  public:
    explicit BrokenVision(double elevation) : elevation_(elevation) {}
    std::string name() const override { return "broken"; }
    std::string summary() const override { return "out of range"; }
    double elevation(const Stimulus&, const Presentation&) const override { return elevation_; }
    double threshold(double) const override { return 1.0; }

  private:
    double elevation_;
};

TEST(SensitivityHard, CS08_ElevationsOutOfRangeAreClampedAndCounted) {
    Image<Rgb> checker(16, 16);
    for (const auto [x, y] : all_pixels(16, 16)) checker(x, y) = Rgb((x + y) % 2 == 0 ? 0.2f : 0.8f);
    for (const auto& [given, expected] : {std::pair(not_a_number, 1.0f), std::pair(0.0, 1.0f), std::pair(-5.0, 1.0f),
                                          std::pair(infinity, 1.0f), std::pair(1e9, 250.8f), std::pair(7.0, 7.0f)}) {
        const BrokenVision vision(given);
        const PerceptionMaps maps =
            compute_perception(checker, constant_image(16, 16, 1.0), {}, {}, {.guide = Guide::full, .vision = &vision});
        for (const float aleph : maps.aleph.pixels) ASSERT_NEAR(aleph, expected, 0.1) << given;
        EXPECT_EQ(maps.clamped, given == 7.0 ? 0u : 256u) << given;
    }
}

TEST(SensitivityHard, CS09_StaticCheckerAndRamp) {
    const int size = 256;
    Image<Rgb> checker(size, size), ramp(size, size);
    for (const auto [x, y] : all_pixels(size, size)) {
        checker(x, y) = Rgb((x + y) % 2 == 0 ? 0.25f : 0.75f);
        ramp(x, y) = Rgb(0.1f + 0.8f * static_cast<float>(x) / size);
    }
    const Image<float> still = constant_image(size, size, 0.0);
    const Image<float> of_checker = compute_perception(checker, still, {}, {}, {.guide = Guide::full}).aleph;
    for (const float aleph : of_checker.pixels) ASSERT_NEAR(aleph, 9.25, 0.05 * 9.25);
    const Image<float> of_ramp = compute_perception(ramp, still, {}, {}, {.guide = Guide::full}).aleph;
    for (int y = 16; y < size - 16; ++y) {
        for (int x = 16; x < size - 16; ++x) ASSERT_NEAR(of_ramp(x, y), 1.0, 0.01) << x << " " << y;
    }
}

TEST(SensitivityHard, CS14_AlephDoesNotDependOnTheEstimatesUnit) {
    Image<Rgb> estimate(64, 48);
    Image<float> velocity(64, 48);
    RandomStream random({5, 0, 0, 0});
    for (std::size_t i = 0; i < estimate.size(); ++i) {
        estimate.pixels[i] = Rgb(random.next(), random.next(), random.next());
        velocity.pixels[i] = 20 * random.next();
    }
    const PerceptionMaps plain = compute_perception(estimate, velocity, {}, {}, {});
    for (const float scale : {0x1p-20f, 0x1p20f}) {
        Image<Rgb> scaled = estimate;
        for (Rgb& c : scaled.pixels) c *= scale;
        const PerceptionMaps same = compute_perception(scaled, velocity, {}, {}, {});
        EXPECT_EQ(same.aleph, plain.aleph) << scale;  // scaling by a power of two is exact
        EXPECT_EQ(same.saliency, plain.saliency) << scale;
    }
}

}  // namespace
}  // namespace aleph
