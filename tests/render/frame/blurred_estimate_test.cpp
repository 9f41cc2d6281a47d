// Maps of a frame whose shutter or lens is open: motion at the shutter's centre, an estimate blurred as the picture is.
// Outlines of fast things before a wall at rest: samples there show both, so the wall's threshold holds.

#include "render/frame/frame_estimate.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 48, height = 32;
constexpr double pixels_per_metre = 8.0;  // the picture is 6 m by 4 m, parallel rays
constexpr double frames_per_second = 30.0;
const FrameRequest maps_only{.frame = false, .maps = true, .progress = {}};

/// A bright square of 1 m (node 0) whose middle is at these places in frames 0, 1, ..., before a dim wall.
Scene make_moving_square(const std::vector<double>& places, const glm::dvec2& shutter) {
    Scene scene;
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.8))));
    std::vector<double> times;
    std::vector<glm::dvec3> at;
    for (std::size_t i = 0; i < places.size(); ++i) {
        times.push_back(static_cast<double>(i) / frames_per_second);
        at.emplace_back(places[i], 0.0, 0.0);
    }
    scene.nodes[0].transform.translation = Track<glm::dvec3>(times, at);
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.1))), {0.0, 0.0, -1.0});
    add_flat_view(scene, 0.5 * height / pixels_per_metre, shutter);
    return scene;
}

FrameOutput look(Scene scene, std::int64_t frame = 0) {
    return Sequence(std::move(scene), quick_settings(width, height)).render(frame, maps_only);
}

TEST(ShutterCenter, MotionIsFromCenterToCenter) {
    // Faster in the second frame: from .5 to 1.5 it moves by half of each way.
    const FrameOutput out = look(make_moving_square({-1.5, -0.5, 1.5, 1.5}, {0.0, 1.0}));
    const int row = height / 2, middle = static_cast<int>(0.5 * width - 1.0 * pixels_per_metre);
    EXPECT_EQ(out.hits(middle, row).instance, 0);
    EXPECT_EQ(out.hits(middle - 5, row).instance, 1);
    EXPECT_EQ(out.hits(middle + 5, row).instance, 1);
    EXPECT_NEAR(out.motion.displacement(middle, row).x, 1.5 * pixels_per_metre, 1e-9);
    EXPECT_NEAR(out.motion.displacement(middle, row).y, 0.0, 1e-9);
}

TEST(ShutterCenter, OfAMomentBesideTheFrame) {
    const FrameOutput out = look(make_moving_square({-1.5, -0.5, 1.5, 1.5}, {1.0, 1.0}));
    const int row = height / 2, middle = static_cast<int>(0.5 * width - 0.5 * pixels_per_metre);
    EXPECT_EQ(out.hits(middle, row).instance, 0);
    EXPECT_NEAR(out.motion.displacement(middle, row).x, 2.0 * pixels_per_metre, 1e-9);
}

TEST(ShutterCenter, OfACentredShutterIsTheFrame) {
    const std::vector<double> places{-1.5, -0.5, 1.5, 1.5};
    const FrameOutput open = look(make_moving_square(places, {-0.3, 0.3}), 1),
                      closed = look(make_moving_square(places, {0.0, 0.0}), 1);
    EXPECT_EQ(open.motion.displacement, closed.motion.displacement);
    EXPECT_EQ(open.surface.depth, closed.surface.depth);
    EXPECT_EQ(open.velocity.pixels, closed.velocity.pixels);
}

TEST(BlurredEstimate, AMovingSquareCoversItsShareOfTheTime) {
    // 2.9 m in the time that the shutter is open, about the middle of the picture.
    const FrameOutput out = look(make_moving_square({-2.9, 0.0, 2.9}, {-0.5, 0.5}), 1);
    const int row = height / 2;
    double sum = 0.0, sum_expected = 0.0;
    for (int x = 0; x < width; ++x) {
        const double place = (x + 0.5 - 0.5 * width) / pixels_per_metre;
        const double first = std::max(-1.45, place - 0.5), last = std::min(1.45, place + 0.5);
        const double expected = 0.1 + 0.7 * std::max(0.0, last - first) / 2.9;
        EXPECT_NEAR(out.estimate(x, row).x, expected, 0.7 / blur_looks + 1e-5) << x;
        sum += out.estimate(x, row).x;
        sum_expected += expected;
    }
    EXPECT_NEAR(sum, sum_expected, 0.01 * sum_expected);
    for (int x = 0; x < width; ++x) EXPECT_NEAR(out.estimate(x, 2).x, 0.1f, 1e-6f);
}

TEST(BlurredEstimate, WhatRestsKeepsItsValues) {
    // A lit floor with a lamp's shadow beside the square that moves: of emission alone, it casts none on it.
    const auto estimate = [](const glm::dvec2& shutter) {
        Scene scene = make_moving_square({-3.0, 0.0, 3.0}, shutter);
        scene.materials[1] = scene.materials[0];
        scene.materials[1].glow.color = glm::dvec3(0.0);
        scene.materials[1].base_color = glm::dvec3(0.7);
        add_mesh(scene, make_quad(0.8, 0.3, 1), {0.7, 1.4, 0.5});
        add_light(scene, Light::Kind::point, glm::dvec3(9.0), {-1.0, 3.0, 2.0});
        return look(std::move(scene), 1).estimate;
    };
    const Image<Rgb> open = estimate({-0.5, 0.5}), closed = estimate({0.0, 0.0});
    for (const auto [x, y] : all_pixels(width, 8)) {
        EXPECT_NEAR(open(x, y).x, closed(x, y).x, 1e-4f * closed(x, y).x) << x << " " << y;
    }
    EXPECT_GT(std::abs(open(width / 2 + 5, height / 2).x - closed(width / 2 + 5, height / 2).x), 0.05f);
}

/// A plate before a wall, and a lamp.
Scene make_lamp_scene(const Track<double>& intensity, const glm::dvec2& shutter) {
    Scene scene;
    scene.film.exposure = 1.0;
    const int grey = add_lambert(scene, glm::dvec3(0.6));
    add_mesh(scene, make_quad(20.0, 20.0, grey), {0.0, 0.0, -1.0});
    add_mesh(scene, make_quad(1.0, 1.0, grey), {0.5, 0.0, 0.0}, glm::angleAxis(1.0, glm::dvec3(0.0, 1.0, 0.0)));
    add_light(scene, Light::Kind::point, glm::dvec3(40.0), {-1.0, 1.0, 1.0});
    scene.lights[0].intensity = intensity;
    add_flat_view(scene, 0.5 * height / pixels_per_metre, shutter);
    return scene;
}

/// Dark up to the shutter's centre.
Scene make_late_lamp() {
    const double frame = 1.0 / frames_per_second;
    return make_lamp_scene(Track<double>({0.0, frame, 2.0 * frame}, {0.0, 0.0, 1.0}), {-0.5, 0.5});
}

/// With the threshold of darkness all pixels would take the most samples.
TEST(BlurredEstimate, ShowsALampThatComesAfterTheCenter) {
    RenderSettings settings = quick_settings(width, height);
    settings.light.bounces = 1;
    settings.cache.light_step = 0;
    const auto estimate = [&](Scene scene) {
        return Sequence(std::move(scene), settings).render(1, maps_only).estimate;
    };
    const Image<Rgb> open = estimate(make_late_lamp()),
                     mean = estimate(make_lamp_scene(Track<double>(0.125), {0.0, 0.0}));
    for (const auto [x, y] : all_pixels(width, height))
        EXPECT_NEAR(open(x, y).x, mean(x, y).x, 1e-4f * mean(x, y).x) << x << " " << y;
    EXPECT_GT(mean(width / 2, height / 2).x, 0.1f);
}

/// Nothing moves: between two times indirect light is as linear as the lamp.
TEST(ShutterKeys, LightThatRisesFromDarknessIsRead) {
    RenderSettings settings;
    set_size(settings, width / 2, height / 2);
    follow_error(settings, 1.0);
    const auto cache = Sequence(make_late_lamp(), settings).render(1).statistics.counts.cache;
    EXPECT_GT(cache.lookups, 1000);
    EXPECT_GT(static_cast<double>(cache.hits), 0.9 * static_cast<double>(cache.lookups));
}

TEST(BlurredEstimate, ALensBlursByTheCircleOfConfusion) {
    Scene scene = make_moving_square({0.0, 0.0}, {0.0, 0.0});
    scene.cameras[0].aperture = 1.0;
    scene.cameras[0].focus_distance = 2.5;  // the square is 5 m away: its point covers a disc of 1 m
    scene.nodes[0].transform.scale = glm::dvec3(0.5);
    const Image<Rgb> estimate = look(scene).estimate;
    double sum = 0.0, squares = 0.0;
    for (const auto [x, y] : all_pixels(width, height)) {
        const glm::dvec2 at = (glm::dvec2(x, y) + 0.5 - 0.5 * glm::dvec2(width, height)) / pixels_per_metre;
        sum += estimate(x, y).x - 0.1;
        squares += (estimate(x, y).x - 0.1) * glm::dot(at, at);
    }
    EXPECT_NEAR(sum, 0.7 * 0.25 * pixels_per_metre * pixels_per_metre, 0.5);
    // A disc of radius r has the second keyframe r^2 / 2, a square of side s s^2 / 6.
    EXPECT_NEAR(squares / sum, 0.5 + 0.25 / 6.0, 0.05);
}

/// A bright bar in 96x12 pixels of .1 m that moves from left to right while the shutter is open at frame 4.
struct PassingBar {
    double wide, speed;  ///< m, m per frame
};

Scene make_scene_of(const PassingBar& bar) {
    Scene scene;
    scene.film.exposure = 1.0;
    const int bright = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.5));
    const int node = add_mesh(scene, make_quad(bar.wide, 9.0, bright));
    const double far = 5.0 * bar.speed;
    scene.nodes[node].transform.translation =
        Track<glm::dvec3>({0.0, 10.0 / 30.0}, {{-far, 0.0, 0.0}, {far, 0.0, 0.0}});
    add_flat_view(scene, 0.6);
    scene.cameras.back().shutter = glm::dvec2(0.0, 1.0);
    return scene;
}

/// Share of the time and of a pixel, whose left side is given, that the bar covers.
double covered_by(const PassingBar& bar, double left) {
    constexpr int steps = 1000;
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double begin = bar.speed * (-1.0 + (i + 0.5) / steps) - 0.5 * bar.wide;
        sum += std::max(0.0, std::min(left + 0.1, begin + bar.wide) - std::max(left, begin));
    }
    return sum / 0.1 / steps;
}

/// All pixels of a column have the same times, so that they agree on what each of them misses. The narrow bar passes
/// most pixels between two of the times that the estimate looks at.
TEST(MovingOutline, MC27_ColumnsOfABarThatPassesAreWithinAThreshold) {
    RenderSettings settings;
    set_size(settings, 96, 12);
    settings.picture.filter = PixelFilter::box;
    settings.light.bounces = 0;
    follow_error(settings, 1.0);
    for (const PassingBar& bar : {PassingBar{1.0, 2.0}, PassingBar{0.2, 4.5}}) {
        const Scene scene = make_scene_of(bar);
        const double white = scene.film.viewing.display_white;
        int swept = 0;
        for (settings.seed = 0; settings.seed < 6; ++settings.seed) {
            const FrameOutput out = Sequence(scene, settings).render(4);
            for (int x = 0; x < 96; ++x) {
                const double covered = covered_by(bar, (x - 48) * 0.1);
                swept += covered > 0.0 ? 1 : 0;
                double mean = 0.0;
                for (int y = 1; y < 11; ++y) mean += luminance(out.shaded.color(x, y)) / 10.0;
                EXPECT_NEAR(mean, 0.5 * covered, out.limits.threshold(x, 6) / white)
                    << x << " seed " << settings.seed << " bar " << bar.wide;
            }
        }
        EXPECT_GT(swept, 6 * 25);
    }
}

constexpr int outline_width = 36, outline_height = 24;
constexpr double outline_pixel = 0.125;  // m

/// Bars of a few pixels that shine, and a plate 1.5 m wide before them that moves by 12 pixels a frame.
Scene make_wall(bool plate) {
    Scene scene;
    const int bright = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.30)),
              dark = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.22)),
              moving = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.38));
    for (int i = 0; i < 24; ++i) {
        add_mesh(scene, make_quad(0.3, 8.0, i % 2 == 0 ? bright : dark), {0.3 * i - 3.45, 0.0, 0.0});
    }
    if (plate) {
        const int node = add_mesh(scene, make_quad(1.5, 2.2, moving));
        scene.nodes[node].transform.translation =
            Track<glm::dvec3>({0.0, 10.0 / 30.0}, {{-1.2, 0.1, 1.0}, {13.8, 0.1, 1.0}});
    }
    add_flat_view(scene, 0.5 * outline_height * outline_pixel);
    return scene;
}

RenderSettings outline_settings(PixelFilter filter) {
    RenderSettings settings;
    set_size(settings, outline_width, outline_height);
    settings.picture.filter = filter;
    settings.cache.light_step = 0;
    settings.light.bounces = 0;
    return settings;
}

struct MovingOutline : testing::TestWithParam<PixelFilter> {};
INSTANTIATE_TEST_SUITE_P(Filters, MovingOutline, testing::Values(PixelFilter::box, PixelFilter::blackman_harris));

TEST_P(MovingOutline, MC27_IsWithinTheThresholdOfTheWall) {
    constexpr std::int64_t frame = 1;
    RenderSettings settings = outline_settings(GetParam());
    settings.sampling.spp = 256;
    settings.perception.guide = Guide::none;
    const Image<Rgb> reference = Sequence(make_wall(true), settings).render(frame).shaded.color;
    int beyond = 0, outline = 0;
    float least = 1e30f, most = 0.0f;
    for (std::uint32_t seed = 0; seed < 2; ++seed) {
        settings = outline_settings(GetParam());
        follow_error(settings, 1.0);
        settings.seed = seed;
        const FrameOutput wall =
            Sequence(make_wall(false), settings).render(frame, {.frame = false, .maps = true, .progress = {}});
        const FrameOutput out = Sequence(make_wall(true), settings).render(frame);
        for (int y = 1; y < outline_height - 1; ++y) {
            for (int x = 1; x < outline_width - 1; ++x) {
                const auto moves = [&](int i, int j) { return out.hits(i, j).instance == 24; };
                const int near = moves(x - 1, y) + moves(x + 1, y) + moves(x, y - 1) + moves(x, y + 1) + moves(x, y);
                if (near == 0 || near == 5) continue;
                ++outline;
                const float error = std::abs(luminance(out.shaded.color(x, y)) - luminance(reference(x, y))) *
                                    static_cast<float>(make_wall(true).film.viewing.display_white);
                if (error > wall.limits.threshold(x, y)) ++beyond;
                const float ratio = out.limits.threshold(x, y) / wall.limits.threshold(x, y);
                least = std::min(least, ratio);
                most = std::max(most, ratio);
            }
        }
    }
    ASSERT_GT(outline, 130);
    EXPECT_GT(most, 2.0f * least);  // the plate's own threshold is far looser
    EXPECT_LE(beyond, outline / 200) << outline;
}

}  // namespace
}  // namespace aleph
