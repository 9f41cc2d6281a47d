// Visible differences, against castleCSF and what must be so by construction: also of those that change from frame to
// frame, and that move: what flickers, what lasts, what the eye follows.

#include "perception/vision/display_hold.h"
#include "tests/support/visible_patterns.h"

namespace aleph::visible_difference_test {
namespace {

TEST(VisibleDifference, EqualPicturesDifferNowhere) {
    const Shown shown = show(still(grating(2.0, 0.5)), still(grating(2.0, 0.5)));
    EXPECT_EQ(shown.seen, 0.0);
    EXPECT_EQ(shown.flicker, 0.0);
    EXPECT_EQ(shown.lasting, 0.0);
}

TEST(VisibleDifference, GratingAtItsThresholdIsOneVisibleDifference) {
    for (const double frequency : {0.5, 0.9, 1.6, 2.5, 4.0, 6.0, 9.0, 12.0}) {
        const Shown shown = show(still(grating(frequency, threshold(frequency))), still(flat));
        EXPECT_NEAR(shown.seen, 1.0, 0.16) << frequency;
        EXPECT_NEAR(shown.lasting, shown.seen, 1e-3) << frequency;
        EXPECT_LT(shown.flicker, 1e-3) << frequency;
    }
}

TEST(VisibleDifference, GrowsInProportionWhereNothingMasks) {
    const double one = show(still(grating(3.0, 0.01)), still(flat)).seen;
    EXPECT_NEAR(show(still(grating(3.0, 0.04)), still(flat)).seen, 4.0 * one, 1e-3 * one);
}

TEST(VisibleDifference, NoiseOfTheReferenceIsTakenOff) {
    std::mt19937 generator(5);
    std::normal_distribution<double> normal(0.0, 0.03);
    const auto noise_picture = [&] { return picture_of([&](double, double) { return normal(generator); }); };
    const auto energy = [&](bool with_noise, double contrast) {
        VisibleDifference difference{{}};
        std::vector<VisibleMaps> maps;
        for (int frame = 0; frame < 11; ++frame) {
            // The reference is the mean of two renderings with noise; the picture is exact, or a grating.
            const Image<Rgb> one = noise_picture(), other = noise_picture();
            PicturePair pair{picture_of(grating(2.0, contrast)), one, one};
            for (std::size_t i = 0; i < one.size(); ++i) {
                pair.reference.pixels[i] = 0.5f * (one.pixels[i] + other.pixels[i]);
                pair.noise.pixels[i] = 0.5f * (one.pixels[i] - other.pixels[i]);
            }
            if (!with_noise) pair.noise = {};
            for (VisibleMaps& done : difference.add(frame, pair, uniform_motion(0.0f))) maps.push_back(std::move(done));
        }
        for (VisibleMaps& done : difference.finish()) maps.push_back(std::move(done));
        Image<float> squares = maps[5].seen;
        for (float& value : squares.pixels) value *= value;
        return middle(squares);
    };
    const double by_noise = energy(false, 0.0);
    EXPECT_LT(energy(true, 0.0), 0.35 * by_noise) << "what chance leaves above zero";
    const double exact = std::pow(show(still(grating(2.0, 0.02)), still(flat)).seen, 2.0);
    EXPECT_NEAR(energy(true, 0.02), exact, 0.1 * exact);
}

TEST(VisibleDifference, ContrastOfBothPicturesMasks) {
    const auto both = [](double contrast) {
        return [=](double x, double y) { return 0.6 * std::cos(0.8 * x) + contrast * std::cos(0.8 * y); };
    };
    const double masked = show(still(both(0.01)), still(both(0.0))).seen;
    const double alone = show(still([](double, double y) { return 0.01 * std::cos(0.8 * y); }), still(flat)).seen;
    EXPECT_LT(masked, 0.6 * alone);
    EXPECT_GT(masked, 0.15 * alone);
    // A pattern of one picture alone does not mask itself.
    const double lost = show(still(flat), still(both(0.0))).seen;
    EXPECT_NEAR(lost, show(still(both(0.0)), still(flat)).seen, 0.05 * lost);
}

TEST(VisibleDifference, ChangesOfHueAreSeenAtEqualLuminance) {
    Image<Rgb> redder = picture_of(flat);
    for (const auto [x, y] : all_pixels(width, height)) {
        const auto shift = static_cast<float>(0.05 * std::cos(2.0 * std::numbers::pi * x / pixels_per_degree));
        redder(x, y) += Rgb{shift, -0.2126f / 0.7152f * shift, 0.0f};
    }
    const double hue = show([&](int) { return redder; }, still(flat)).seen;
    const double brightness = show(still(grating(1.0, 0.05)), still(flat)).seen;
    EXPECT_GT(hue, 1.0);
    EXPECT_GT(brightness, 1.0);
    const VisualChannels grey_channels = compute_visual_channels(picture_of(flat), 100.0);
    EXPECT_NEAR(grey_channels[0](0, 0), 50.0, 3.0);
    EXPECT_NEAR(grey_channels[1](0, 0), 0.0, 0.6);
    EXPECT_NEAR(grey_channels[2](0, 0), 0.0, 0.6);
}

TEST(VisibleDifference, DisplayShowsNothingAboveWhite) {
    const auto bright = [](double factor) {
        return [=](int) { return Image<Rgb>(width, height, Rgb(static_cast<float>(factor))); };
    };
    EXPECT_EQ(show(bright(3.0), bright(40.0)).seen, 0.0);
}

/// A square on black, and a pixel of it that is darker.
TEST(VisibleDifference, NothingIsSeenInTheBlackFarFromAnError) {
    Image<Rgb> reference(width, height), picture;
    for (int y = 56; y < 72; ++y) {
        for (int x = 88; x < 104; ++x) reference(x, y) = Rgb(0.8f);
    }
    picture = reference;
    picture(90, 58) = Rgb(0.6f);
    VisibleDifference difference({});
    difference.add(0, {picture, reference}, uniform_motion(0.0f));
    const VisibleMaps maps = difference.finish().at(0);
    EXPECT_GT(maps.seen(90, 58), 1.0f);
    for (const auto& [x, y] : {std::pair{0, 0}, {191, 0}, {0, 127}, {191, 127}, {20, 64}}) {
        EXPECT_LT(maps.seen(x, y), 0.2f) << x << ' ' << y;
    }
}

/// A lamp comes on, or goes: both pictures are black in the frames on its other side.
TEST(VisibleDifference, NothingIsSeenInBlackFramesBesideAnError) {
    const int reach = filter_reach({});
    const Image<Rgb> black(width, height), exact = picture_of(flat), wrong = picture_of(grating(2.0, threshold(2.0)));
    for (const bool comes : {true, false}) {
        const auto switched = [&](const Image<Rgb>& lit) {
            return [&, comes](int frame) { return (comes ? frame > reach : frame < reach) ? lit : black; };
        };
        EXPECT_LT(show(switched(wrong), switched(exact)).seen, 1.0) << comes;
    }
}

TEST(VisibleDifference, ValuesThatAreNotFiniteAreSeen) {
    Image<Rgb> broken = picture_of(flat);
    broken(10, 20).y = float_nan;
    VisibleDifference difference{{}};
    difference.add(0, {broken, picture_of(flat)}, uniform_motion(0.0f));
    const auto maps = difference.finish();
    ASSERT_EQ(maps.size(), 1u);
    EXPECT_TRUE(std::isinf(maps[0].seen(10, 20)));
    EXPECT_TRUE(std::isfinite(maps[0].seen(11, 20)));
}

TEST(VisibleDifference, ShotsEndAtCutsAndGaps) {
    const Image<Rgb> dark = picture_of(grating(2.0, 0.2)), light = picture_of(grating(2.0, -0.2));
    const auto flicker = [&](std::int64_t second, bool cut) {
        VisibleDifference difference{{}};
        auto maps = difference.add(0, {dark, picture_of(flat)}, uniform_motion(0.0f));
        for (VisibleMaps& done : difference.add(second, {light, picture_of(flat)}, uniform_motion(0.0f), cut))
            maps.push_back(std::move(done));
        for (VisibleMaps& done : difference.finish()) maps.push_back(std::move(done));
        EXPECT_EQ(maps.size(), 2u);
        return middle(maps[0].flicker);
    };
    EXPECT_GT(flicker(1, false), 1.0);
    EXPECT_LT(flicker(1, true), 1e-3);
    EXPECT_LT(flicker(2, false), 1e-3);
}

TEST(VisibleDifference, RefusesPicturesOfOtherSizes) {
    VisibleDifference difference{{}};
    EXPECT_THROW(difference.add(0, {Image<Rgb>(4, 4), picture_of(flat)}, uniform_motion(0.0f)), InputError);
    difference.add(0, {picture_of(flat), picture_of(flat)}, uniform_motion(0.0f));
    const Image<Rgb> small(16, 16);
    const MotionMaps still{Image<float>(16, 16), Image<float>(16, 16), Image<float>(16, 16, 1.0f), {}};
    EXPECT_THROW(difference.add(1, {small, small}, still), InputError);
}

TEST(VisibleDifference, PicturesOfOnePixelHaveBands) {
    VisibleDifference difference{{}};
    const Image<Rgb> a(1, 1, Rgb(0.2f)), b(1, 1, Rgb(0.8f));
    difference.add(0, {a, b}, {Image<float>(1, 1), Image<float>(1, 1), Image<float>(1, 1, 1.0f), {}});
    EXPECT_TRUE(std::isfinite(difference.finish().at(0).seen(0, 0)));
}

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
    for (const Frames& pictures : {Frames(fresh), drifting(grating(2.0, 0.03), 2.0)}) {
        const Shown surface = show(pictures, still(flat), 2.0f),
                    background = show(pictures, still(flat), 2.0f, {}, 0.0f);
        EXPECT_EQ(background.seen, surface.seen);
        EXPECT_EQ(background.lasting, surface.lasting);
    }
}

}  // namespace
}  // namespace aleph::visible_difference_test
