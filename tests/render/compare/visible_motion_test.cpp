// Visible differences that change from frame to frame, and that move: what flickers, what lasts, what the eye follows.

#include "perception/vision/display_hold.h"
#include "tests/support/visible_patterns.h"

namespace aleph::visible_difference_test {
namespace {

TEST(VisibleDifference, FlickerHasTheSensitivityOfItsFrequencyOverTime) {
    const ViewingSettings settings;
    const int reach = filter_reach(settings.frame_rate), count = 2 * reach + 1;
    const double rate = settings.frame_rate.per_second(), frequency = 2.0, contrast = 0.02;
    const auto sinc = [](double x) { return std::sin(std::numbers::pi * x) / (std::numbers::pi * x); };
    const double lasting = show(still(grating(frequency, contrast)), still(flat)).seen;
    for (const int cycles : {1, 2, 3}) {
        const auto pictures = [&](int frame) {
            const double phase = 2.0 * std::numbers::pi * cycles * (frame - reach) / count;
            return picture_of(grating(frequency, contrast * std::cos(phase)));
        };
        const Shown shown = show(pictures, still(flat));
        const double omega = cycles * rate / count, mirror = rate - omega;
        // A display that holds frames shows each frequency with its mirror.
        const double expected = std::hypot(sinc(omega / rate) / threshold(frequency, omega),
                                           sinc(mirror / rate) / threshold(frequency, mirror)) *
                                threshold(frequency);
        EXPECT_NEAR(shown.flicker / lasting, expected, 0.1 * expected) << omega;
        EXPECT_LT(shown.lasting, 1e-3);
    }
}

TEST(VisibleDifference, ErrorThatRidesOnAFollowedSurfaceLasts) {
    ViewingSettings settings;
    settings.tracking = 1.0;
    settings.viewing.persistence = 0.0;  // no blur
    const auto pattern = [](int frame) {
        return [=](double x, double y) { return 0.03 * std::cos(0.9 * (x - 3.0 * frame)) * std::cos(0.4 * y); };
    };
    const auto pictures = [&](int frame) { return picture_of(pattern(frame)); };
    const Shown moving = show(pictures, still(flat), 3.0f, settings);
    const Shown at_rest = show(still(pattern(0)), still(flat), 0.0f, settings);
    EXPECT_LT(moving.flicker, 0.12 * moving.seen) << "bands of half size are not quite the same at odd pixels";
    EXPECT_NEAR(moving.seen, at_rest.seen, 0.03 * at_rest.seen);
    EXPECT_GT(show(pictures, still(flat), 0.0f, settings).flicker, 3.0 * moving.flicker)
        << "an eye at rest sees it change";
}

TEST(VisibleDifference, MotionThatIsNotFollowedShiftsFrequencies) {
    ViewingSettings settings;
    settings.tracking = 0.0;
    const double frequency = 1.59, contrast = 0.01;
    const double pixels = 2.0, velocity = pixels / pixels_per_degree * settings.frame_rate.per_second();
    const Frames pictures = drifting(grating(frequency, contrast), pixels);
    const double lasting = show(still(grating(frequency, contrast)), still(flat)).seen;
    const double expected = threshold(frequency) / threshold(frequency, frequency * velocity);
    EXPECT_NEAR(show(pictures, still(flat), static_cast<float>(pixels), settings).lasting / lasting, expected,
                0.2 * expected);
}

TEST(VisibleDifference, DisplayThatHoldsFramesBlursWhatIsFollowed) {
    const ViewingSettings settings;
    const double frequency = 2.0, pixels = 4.0;
    const double followed = tracking_efficiency * pixels / pixels_per_degree * settings.frame_rate.per_second();
    const Frames pictures = drifting(grating(frequency, 0.02), pixels);
    ViewingSettings strobed = settings;
    strobed.viewing.persistence = 0.05;
    const double held = show(pictures, still(flat), static_cast<float>(pixels), settings).lasting;
    const double sharp = show(pictures, still(flat), static_cast<float>(pixels), strobed).lasting;
    const double expected = hold_transfer(frequency, followed, 1.0, settings.frame_rate) /
                            hold_transfer(frequency, followed, 0.05, settings.frame_rate);
    EXPECT_NEAR(held / sharp, expected, 0.15 * expected);
}

/// Noise that is new in every frame of a window that a sequence fills.
std::vector<Image<Rgb>> noise_of_frames(std::uint32_t seed) {
    std::mt19937 generator(seed);
    std::vector<Image<Rgb>> noise;
    for (int frame = 0; frame <= 2 * filter_reach({}); ++frame) {
        std::normal_distribution<double> normal(0.0, 0.05);
        noise.push_back(picture_of([&](double, double) { return normal(generator); }));
    }
    return noise;
}

TEST(VisibleDifference, NoiseThatIsNewInEveryFrameFlickers) {
    const std::vector<Image<Rgb>> noise = noise_of_frames(3);
    const Shown fresh = show([&](int frame) { return noise[static_cast<std::size_t>(frame)]; }, still(flat));
    const Shown frozen = show([&](int) { return noise[0]; }, still(flat));
    EXPECT_LT(frozen.flicker, 1e-3);
    EXPECT_GT(fresh.flicker, 0.5 * fresh.lasting);
    EXPECT_LT(fresh.seen, 0.75 * frozen.seen) << "the eye averages over time";
    EXPECT_NEAR(fresh.lasting, frozen.lasting / std::sqrt(11.0), 0.1 * frozen.lasting) << "a mean of 11 frames";
}

/// The background has motion, too: that of the camera's rotation. What flickers in it is averaged, and what moves along
/// with it lasts.
TEST(VisibleDifference, BackgroundIsFollowedAsSurfacesAre) {
    const std::vector<Image<Rgb>> noise = noise_of_frames(7);
    const auto fresh = [&](int frame) { return noise[static_cast<std::size_t>(frame)]; };
    for (const float u : {0.0f, 2.0f}) {
        for (const Frames& pictures : {Frames(fresh), drifting(grating(2.0, 0.03), u)}) {
            const Shown surface = show(pictures, still(flat), u), background = show(pictures, still(flat), u, {}, 0.0f);
            EXPECT_EQ(background.seen, surface.seen);
            EXPECT_EQ(background.lasting, surface.lasting);
        }
    }
}

}  // namespace
}  // namespace aleph::visible_difference_test
