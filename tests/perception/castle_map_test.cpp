// castleCSF in the Aleph map: rows of floats against single values in double, the hold of displays, thresholds.

#include "engine/base/sampling.h"
#include "perception/perception.h"
#include "perception/threshold.h"
#include "perception/vision/castle.h"
#include "perception/vision/castle_vision.h"
#include "perception/vision/display_hold.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"
#include "tests/support/vision_formulas.h"

namespace aleph {
namespace {

constexpr FrameRate thirty{30, 1};

/// The largest |f / castle_elevation - 1| of random pixels.
/// @param low, high  log10 of luminance
double worst_row_error(const ViewingConditions& viewing, double low, double high) {
    constexpr int width = 150;
    const auto rho = band_frequencies(Bands::measured, viewing.pixels_per_degree);
    std::vector<float> velocity(width), tracked(width), luminance(width);
    RandomStream random({11, 0, 0, 0});
    for (int x = 0; x < width; ++x) {
        velocity[x] = static_cast<float>(0.15 * std::pow(10.0, 3.5 * random.next()));
        tracked[x] = x % 3 == 0 ? 0.0f : 80.0f * random.next();
        luminance[x] = static_cast<float>(std::pow(10.0, low + (high - low) * random.next()));
    }
    CastleRow row(std::make_shared<CastleTable>(rho, viewing, thirty), width);
    row.load({velocity.data(), tracked.data(), luminance.data()});
    std::vector<float> f(width);
    double worst = 0.0;
    for (int band = 0; band < band_count; ++band) {
        row.elevations(band, f.data());
        for (int x = 0; x < width; ++x) {
            const double exact =
                castle_elevation(rho[band], velocity[x], tracked[x], luminance[x], viewing.persistence, thirty);
            worst = std::max(worst, std::abs(f[x] / exact - 1.0));
        }
    }
    return worst;
}

TEST(CastleRow, InterpolationErrorIsWhatTheHeaderSays) {
    for (const double ppd : {12.0, 31.0, 60.0}) {
        for (const double persistence : {0.0, 0.1, 1.0}) {
            const ViewingConditions viewing{.pixels_per_degree = ppd, .persistence = persistence};
            EXPECT_LT(worst_row_error(viewing, -3.0, 4.0), 2e-3) << ppd << " " << persistence;
        }
    }
}

/// How many times the threshold of a pattern rises when it moves at 10 deg/s and the eye follows .82 of that.
double tracked_elevation(double rho, double persistence) {
    const double at_rest = castle_sensitivity(rho, 0.0, 100.0);
    const double moving = castle_sensitivity(rho, rho * (10.0 - 8.2), 100.0);
    return at_rest / (moving * hold_transfer(rho, 8.2, persistence, thirty));
}

TEST(DisplayHold, KnownElevationsOfATrackedPattern) {
    EXPECT_NEAR(tracked_elevation(8, 1.0), 36.0, 0.5);
    EXPECT_NEAR(tracked_elevation(4, 1.0), 5.2, 0.05);
    EXPECT_NEAR(tracked_elevation(8, 0.0), 3.6, 0.05);
    EXPECT_NEAR(tracked_elevation(4, 0.0), 1.7, 0.05);
}

TEST(DisplayHold, NothingBlursAtRestOrWithoutPersistence) {
    for (const double rho : {0.25, 4.0, 16.0}) {
        EXPECT_EQ(hold_transfer(rho, 0.0, 1.0, thirty), 1.0);
        EXPECT_EQ(hold_transfer(rho, 40.0, 0.0, thirty), 1.0);
        // More speed and more persistence blur more; more frames per second less.
        EXPECT_LT(hold_transfer(rho, 20.0, 1.0, thirty), hold_transfer(rho, 10.0, 1.0, thirty));
        EXPECT_LT(hold_transfer(rho, 10.0, 1.0, thirty), hold_transfer(rho, 10.0, 0.1, thirty));
        EXPECT_LT(hold_transfer(rho, 10.0, 1.0, thirty), hold_transfer(rho, 10.0, 1.0, {120, 1}));
    }
}

TEST(CastleMap, SettingsReachTheMap) {
    const SyntheticFrame frame = make_synthetic_frame(160, 120);
    const auto aleph_with = [&](const VisionModel* vision, double persistence) {
        const ViewingConditions viewing{.persistence = persistence};
        const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, viewing, {}, {.vision = vision});
        EXPECT_EQ(maps.clamped, 0u);
        EXPECT_EQ(maps.adaptation.empty(), vision != &castle_vision());
        return mean_of(maps.aleph);
    };
    EXPECT_GT(aleph_with(&castle_vision(), 1.0), aleph_with(&castle_vision(), 0.1));
    EXPECT_EQ(aleph_with(&thesis_vision(), 1.0), aleph_with(&thesis_vision(), 0.1));
    EXPECT_NE(aleph_with(&thesis_vision(), 1.0), aleph_with(&laird_vision(), 1.0));
    EXPECT_THROW(aleph_with(&thesis_vision(), 1.5), InputError);
    EXPECT_THROW(aleph_with(&castle_vision(), not_a_number), InputError);
}

TEST(CastleThreshold, IsLuminanceOverTheHighestSensitivity) {
    std::vector<double> luminances;
    for (double l = 1e-4; l < 1e6; l *= 1.37) luminances.push_back(l);
    const int count = static_cast<int>(luminances.size());
    Image<float> adaptation(count, 1);
    for (int i = 0; i < count; ++i) adaptation(i, 0) = static_cast<float>(luminances[i]);
    const Image<float> threshold = compute_threshold(Image<float>(count, 1, 3.0f), adaptation, castle_vision());
    for (int i = 0; i < count; ++i) {
        EXPECT_NEAR(threshold(i, 0) * castle_peak(luminances[i]) / (3.0 * std::max(luminances[i], 1e-3)), 1.0, 1e-3)
            << luminances[i];
    }
}

}  // namespace
}  // namespace aleph
