// Published values of castleCSF, and of the elevations of the three models of vision side by side.

#include "perception/vision/castle.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

constexpr double printed = 0.50001e-4;  // half a unit of the fourth decimal

struct FlickerRow {
    double luminance, omega;
    std::array<double, 8> sensitivity;  // at .25 to 32 cycles per degree
};

// castleCSF version 0.2.4, achromatic, 1 square degree, at the fovea.
constexpr FlickerRow flicker_rows[] = {
    {1, 0, {9.2867, 20.5125, 35.3714, 39.6326, 27.8403, 11.2242, 2.3893, 0.2829}},
    {1, 1, {15.9103, 26.3504, 39.5552, 42.5268, 30.2383, 13.1189, 3.4722, 0.7375}},
    {1, 2, {25.7291, 35.1378, 46.0769, 47.2026, 34.0583, 16.0203, 5.0869, 1.4076}},
    {1, 4, {34.2264, 41.2807, 48.2220, 47.0307, 34.4615, 17.5152, 6.3810, 2.0294}},
    {1, 8, {25.4277, 28.6267, 30.9383, 29.0480, 21.5480, 11.5934, 4.5964, 1.5664}},
    {1, 16, {7.1219, 7.5854, 7.6301, 6.8878, 5.1764, 2.9465, 1.2568, 0.4512}},
    {1, 32, {0.4902, 0.5059, 0.4864, 0.4273, 0.3241, 0.1916, 0.0854, 0.0315}},
    {10, 0, {11.6746, 23.3212, 51.5831, 81.3198, 80.3724, 45.5909, 13.6549, 2.2751}},
    {10, 1, {14.7785, 25.5010, 51.0390, 77.5893, 75.8584, 43.0985, 13.1467, 2.3374}},
    {10, 2, {23.9825, 33.6127, 55.2701, 76.9188, 73.0822, 41.6980, 13.3362, 2.7445}},
    {10, 4, {41.8865, 49.3650, 63.4054, 75.4451, 67.5092, 38.8762, 13.6771, 3.5328}},
    {10, 8, {48.3724, 52.3457, 56.6862, 57.7251, 47.9437, 27.9468, 10.9950, 3.4505}},
    {10, 16, {23.5533, 24.5239, 24.1824, 22.0284, 17.1381, 10.1036, 4.3612, 1.5500}},
    {10, 32, {3.0625, 3.1563, 3.0296, 2.6602, 2.0201, 1.1961, 0.5338, 0.1972}},
    {100, 0, {12.5306, 25.0311, 51.4673, 104.9921, 134.2779, 98.5628, 38.1997, 8.2359}},
    {100, 1, {13.8724, 25.3206, 49.2684, 97.6658, 123.7935, 90.6363, 35.1846, 7.6522}},
    {100, 2, {21.4535, 31.6594, 52.0124, 92.8022, 113.4686, 82.2081, 32.1276, 7.2373}},
    {100, 4, {44.9205, 52.9461, 65.8753, 90.6779, 98.8221, 68.9880, 27.6130, 6.9737}},
    {100, 8, {73.0242, 77.9300, 80.8366, 84.1822, 75.9905, 49.2230, 20.6942, 6.3462}},
    {100, 16, {54.0547, 55.9706, 54.3055, 48.9905, 38.4106, 23.1760, 10.2200, 3.6460}},
    {100, 32, {11.2671, 11.6103, 11.1383, 9.7752, 7.4221, 4.3966, 1.9633, 0.7255}},
};

TEST(Castle, GivesThePublishedSensitivityToFlicker) {
    for (const FlickerRow& row : flicker_rows) {
        for (int i = 0; i < 8; ++i) {
            EXPECT_NEAR(castle_sensitivity(std::ldexp(0.25, i), row.omega, row.luminance), row.sensitivity[i], printed)
                << row.luminance << " cd/m2, " << row.omega << " Hz, column " << i;
        }
    }
}

/// (5.9) by the thesis's constants, those of Laird et al. 2006, and castleCSF at 100 cd/m2.
struct PublishedElevations {
    // Velocity on the retina, deg/s; Daly's peak and its frequency, cycles per degree; the same of castleCSF.
    std::array<double, 5> peaks;
    std::array<double, 18> by_frequency;  // at .5 to 16 cycles per degree, of the three models each
};

constexpr PublishedElevations published_elevations[] = {
    {{0.15, 245.4, 4.84, 128.7, 3.75},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.35, 1.97, 1.45, 9.25, 30.32, 4.14}},
    {{0.3, 248.0, 4.34, 122.5, 3.59},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.01, 1.59, 1.97, 1.55, 15.78, 30.32, 4.69}},
    {{0.5, 248.3, 3.83, 115.4, 3.40},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.01, 1.02, 2.03, 2.30, 1.67, 33.21, 47.56, 5.58}},
    {{1, 250.6, 2.95, 104.2, 3.04},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.11, 1.07, 1.05, 4.19, 3.52, 2.12, 238.74, 115.76, 10.20}},
    {{2, 231.2, 2.02, 94.1, 2.48},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.81, 1.35, 1.24, 23.82, 9.27, 4.06, 231.23, 116.99,
      47.91}},
    {{3, 203.5, 1.54, 89.1, 2.04},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.08, 1.00, 1.00, 3.65, 1.89, 1.62, 166.99, 27.00, 8.66, 203.53, 114.83,
      89.14}},
    {{5, 169.8, 1.04, 84.2, 1.48},
     {1.00, 1.00, 1.00, 1.00, 1.00, 1.00, 1.72, 1.12, 1.10, 20.22, 4.42, 3.23, 169.79, 103.08, 45.62, 169.79, 103.08,
      84.22}},
    {{10, 141.1, 0.57, 80.1, 0.85},
     {1.00, 1.00, 1.00, 1.45, 1.02, 1.02, 11.86, 2.54, 2.36, 141.14, 62.83, 25.69, 141.14, 80.90, 80.09, 141.14, 80.90,
      80.09}},
    {{20, 125.0, 0.30, 78.2, 0.46},
     {1.35, 1.00, 1.01, 9.16, 1.98, 2.05, 124.98, 30.91, 19.05, 124.98, 66.72, 78.23, 124.98, 66.72, 78.23, 124.98,
      66.72, 78.23}},
    {{40, 109.5, 0.16, 73.9, 0.25},
     {8.06, 1.76, 1.86, 109.51, 21.88, 15.78, 109.51, 58.92, 73.89, 109.51, 58.92, 73.89, 109.51, 58.92, 73.89, 109.51,
      58.92, 73.89}},
    {{80, 91.2, 0.08, 66.4, 0.13},
     {91.17, 18.45, 13.61, 91.17, 51.80, 66.44, 91.17, 51.80, 66.44, 91.17, 51.80, 66.44, 91.17, 51.80, 66.44, 91.17,
      51.80, 66.44}},
};

struct Peak {
    double frequency = 0.0, sensitivity = 0.0;
};

/// The largest value of castle_sensitivity at a velocity, by scanning frequencies 0.1 % apart.
Peak find_castle_peak(double velocity) {
    Peak best;
    for (double rho = 0.02; rho < 20.0; rho *= 1.001) {
        const double sensitivity = castle_sensitivity(rho, rho * velocity, 100.0);
        if (sensitivity > best.sensitivity) best = {rho, sensitivity};
    }
    return best;
}

TEST(Castle, ElevationsOfTheThreeModels) {
    for (const PublishedElevations& row : published_elevations) {
        const auto& [velocity, daly_peak, daly_at, castle_peak, castle_at] = row.peaks;
        const Peak peak = find_castle_peak(velocity);
        EXPECT_NEAR(written_thesis_sensitivity(written_thesis_peak(velocity), velocity), daly_peak, 0.0501) << velocity;
        EXPECT_NEAR(written_thesis_peak(velocity), daly_at, 0.00501) << velocity;
        EXPECT_NEAR(peak.sensitivity, castle_peak, 0.0501) << velocity;
        EXPECT_NEAR(peak.frequency / castle_at, 1.0, castle_at < 0.5 ? 0.03 : 0.006) << velocity;
        for (int i = 0; i < 6; ++i) {
            const double rho = std::ldexp(0.5, i);
            const double castle = rho > peak.frequency
                                      ? peak.sensitivity / std::max(1.0, castle_sensitivity(rho, rho * velocity, 100.0))
                                      : 1.0;
            const EyeMotion motion{.retinal = velocity};
            EXPECT_NEAR(written_elevation(&thesis_vision(), rho, motion), row.by_frequency[3 * i], 0.00501)
                << velocity << " " << rho;
            EXPECT_NEAR(written_elevation(&laird_vision(), rho, motion), row.by_frequency[3 * i + 1], 0.00501)
                << velocity << " " << rho;
            EXPECT_NEAR(castle, row.by_frequency[3 * i + 2], 0.00501) << velocity << " " << rho;
        }
    }
}

TEST(Castle, PeakAtRestIsWhereAScanFindsIt) {
    for (const double luminance : {0.001, 0.05, 1.0, 30.0, 100.0, 700.0, 1e4}) {
        double best = 0.0;
        for (double rho = 0.02; rho < 20.0; rho *= 1.0005) {
            best = std::max(best, castle_sustained(rho, luminance));
        }
        EXPECT_NEAR(castle_peak(luminance) / best, 1.0, 1e-5) << luminance;
    }
    EXPECT_NEAR(castle_peak(100.0), 134.30, 0.005);
    // At rest the transient channel adds next to nothing where its fit has a peak.
    for (const double luminance : {0.02, 1.0, 100.0, 1e4}) {
        for (const double rho : {0.25, 1.0, 4.0}) {
            EXPECT_NEAR(castle_sensitivity(rho, 0.0, luminance) / castle_sustained(rho, luminance), 1.0, 1e-3);
        }
    }
}

TEST(Castle, LargerPatternsAreSeenBetterUpToTheCriticalArea) {
    double previous = 0.0;
    for (const double area : {0.01, 0.1, 1.0, 10.0, 1000.0, 1e9}) {
        const double here = castle_sensitivity(2.0, 0.0, 100.0, area);
        EXPECT_GT(here, previous) << area;
        previous = here;
    }
    // Small patterns follow Piper's law: sensitivity grows with the square root of area.
    EXPECT_NEAR(castle_sensitivity(2, 0, 100, 4e-4) / castle_sensitivity(2, 0, 100, 1e-4), 2.0, 1e-3);
}

TEST(Castle, ChromaticMechanisms) {
    // Logarithm of red-green sensitivity at 10,000 cd/m2 to a patch with a radius of 1.5 degrees, as the table
    // csf_lut_weber_fixed_size.json of gfxdisp/ColorVideoVDP has it, which was made from another version of the model.
    const std::pair<double, double> red_green[] = {{0.80393205669145917, 2.6122275674138447},
                                                   {5.2470687940479692, 2.2513183453036421},
                                                   {63.999999999999986, 1.1253547263529633}};
    for (const auto& [rho, expected] : red_green)
        EXPECT_NEAR(std::log10(castle_red_green(rho, 0.0, 1e4, 2.25 * std::numbers::pi)), expected, 0.08) << rho;
    // Blue is seen in coarse patterns only, and both fade in the dark.
    EXPECT_LT(castle_yellow_violet(8.0, 0.0, 100.0), 0.6 * castle_yellow_violet(1.0, 0.0, 100.0));
    EXPECT_LT(castle_red_green(1.0, 0.0, 0.1), 0.1 * castle_red_green(1.0, 0.0, 100.0));
    EXPECT_LT(castle_yellow_violet(1.0, 0.0, 0.1), 0.2 * castle_yellow_violet(1.0, 0.0, 100.0));
    // Both see slow changes only.
    EXPECT_NEAR(castle_red_green(1.0, 4.0, 100.0) / castle_red_green(1.0, 0.0, 100.0),
                std::exp(-std::pow(4.0, 1.15591) / 16.4325), 1e-12);
    EXPECT_NEAR(castle_yellow_violet(1.0, 4.0, 100.0) / castle_yellow_violet(1.0, 0.0, 100.0),
                std::exp(-std::pow(4.0, 0.969123) / 7.15012), 1e-12);
}

}  // namespace
}  // namespace aleph
