// castleCSF, the hold of displays and their thresholds with inputs for which the printed formulas have no finite
// result.

#include <cfloat>

#include "perception/threshold.h"
#include "perception/vision/castle.h"
#include "perception/vision/castle_vision.h"
#include "perception/vision/display_hold.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

constexpr double extremes[] = {0.0, -0.0, denormal, FLT_MIN, 1.0, FLT_MAX, infinity, -infinity, not_a_number, -3.0};
constexpr FrameRate thirty{30, 1};

TEST(CastleHard, CS15_EveryInputHasADocumentedResult) {
    for (const double x : extremes) {
        // Inputs that count as 0, as 1e30, or as the nearer end of the luminance range.
        const double clamped = x > 0.0 ? std::fmin(x, 1e30) : 0.0;
        const double luminance = std::fmin(std::fmax(x, 1e-3), 1e4);
        EXPECT_EQ(castle_sensitivity(x, 2, 100), castle_sensitivity(clamped, 2, 100)) << x;
        EXPECT_EQ(castle_sensitivity(2, x, 100), castle_sensitivity(2, clamped, 100)) << x;
        EXPECT_EQ(castle_sensitivity(2, 1, x), castle_sensitivity(2, 1, luminance)) << x;
        EXPECT_EQ(castle_peak(x), castle_peak(luminance)) << x;
        EXPECT_EQ(castle_transient_peak(x), castle_transient_peak(luminance)) << x;
    }
    // A pattern without frequency or area is not seen, nor one that is infinitely fine or fast.
    for (const double none : {0.0, -0.0, -3.0, not_a_number, -infinity}) {
        EXPECT_EQ(castle_sensitivity(none, 2, 100), 0.0) << none;
        EXPECT_EQ(castle_sensitivity(2, 2, 100, none), 0.0) << none;
    }
    EXPECT_NEAR(castle_sensitivity(infinity, 2, 100), 0.0, 1e-100);
    EXPECT_EQ(castle_sensitivity(2, infinity, 100), 0.0);
    EXPECT_NEAR(castle_sensitivity(2, 2, 100, infinity) / castle_sensitivity(2, 2, 100, 1e12), 1.0, 1e-9);
    EXPECT_NEAR(castle_sensitivity(denormal, 0, 100), 0.0, 1e-30);
}

TEST(CastleHard, CS15_EveryCombinationIsFiniteAndNotNegative) {
    for (const double rho : extremes) {
        for (const double omega : extremes) {
            for (const double luminance : extremes) {
                for (const double area : extremes) {
                    const double s = castle_sensitivity(rho, omega, luminance, area);
                    ASSERT_TRUE(s >= 0.0 && s < 1e4) << rho << " " << omega << " " << luminance << " " << area;
                }
                const double f = castle_elevation(rho, omega, omega, luminance, 1.0, thirty);
                ASSERT_TRUE(f >= 1.0 && f <= 153.0) << rho << " " << omega << " " << luminance;
            }
        }
    }
}

TEST(CastleHard, CS16_TheTransientPeakIsZeroInTheDark) {
    // 2.41482 log10 L + 4.7036 is negative there, and its power not a number.
    EXPECT_EQ(castle_transient_peak(0.011), 0.0);
    EXPECT_GT(castle_transient_peak(0.0115), 0.0);
    EXPECT_EQ(castle_transient_response(0, 0.001), 1.0);
    EXPECT_NEAR(castle_transient_response(1, 0.001), std::exp(-1 / 0.0844836), 1e-12);
    EXPECT_NEAR(castle_transient_peak(100), 9.53324, 1e-9);
    EXPECT_EQ(castle_transient_response(9.53324, 100), 1.0);
}

TEST(CastleHard, CS17_HoldTransferOfEveryInput) {
    for (const double x : extremes) {
        const double clamped = x > 0.0 ? std::fmin(x, 1e30) : 0.0;
        EXPECT_EQ(hold_transfer(x, 8, 1, thirty), hold_transfer(clamped, 8, 1, thirty)) << x;
        EXPECT_EQ(hold_transfer(4, x, 1, thirty), hold_transfer(4, clamped, 1, thirty)) << x;
        EXPECT_EQ(hold_transfer(4, 8, x, thirty), hold_transfer(4, 8, std::fmin(clamped, 1.0), thirty)) << x;
        EXPECT_GE(hold_transfer(x, x, x, thirty), 0.0) << x;
        EXPECT_LE(hold_transfer(x, x, x, thirty), 1.0) << x;
    }
    // |sinc| is 0 where the blur is one period wide: its envelope is not.
    EXPECT_GT(hold_transfer(3.0, 10.0, 1.0, thirty), 0.1);
    EXPECT_EQ(hold_transfer(0.0, 1e30, 1.0, thirty), 1.0);
}

TEST(CastleHard, CS17_RowsOfExtremeValues) {
    std::vector<float> velocity, tracked, luminance;
    for (const float v : {0.15f, 80.0f, 1e6f, 1e30f}) {
        for (const float t : {0.0f, 80.0f}) {
            for (const double l : extremes) {
                velocity.push_back(v), tracked.push_back(t), luminance.push_back(static_cast<float>(l));
            }
        }
    }
    for (const double ppd : {1e-9, 31.0, 1e18}) {
        for (const FrameRate& rate : {FrameRate{1, 1000000000000000}, thirty, FrameRate{1000000000000000, 1}}) {
            const auto rho = band_frequencies(Bands::printed, ppd);
            CastleRow row(std::make_shared<CastleTable>(rho, ViewingConditions{.pixels_per_degree = ppd}, rate),
                          static_cast<int>(velocity.size()));
            row.load({velocity.data(), tracked.data(), luminance.data()});
            std::vector<float> f(velocity.size());
            for (int band = 0; band < band_count; ++band) {
                row.elevations(band, f.data());
                for (std::size_t i = 0; i < velocity.size(); ++i) {
                    const double exact = castle_elevation(rho[band], velocity[i], tracked[i], luminance[i], 1.0, rate);
                    ASSERT_NEAR(f[i] / exact, 1.0, 2e-3)
                        << ppd << " band " << band << ": " << velocity[i] << " " << tracked[i] << " " << luminance[i];
                }
            }
        }
    }
}

TEST(CastleHard, CS15_ThresholdsOfEveryLuminance) {
    for (const double x : extremes) {
        const Image<float> adaptation(1, 1, static_cast<float>(x)), aleph(1, 1, 1.0f);
        const Image<float> threshold = compute_threshold(aleph, adaptation, castle_vision());
        EXPECT_NEAR(threshold(0, 0) * castle_peak(x) / std::fmin(std::fmax(x, 1e-3), 1e12), 1.0, 2e-3) << x;
    }
}

}  // namespace
}  // namespace aleph
