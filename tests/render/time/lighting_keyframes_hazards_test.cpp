// Light at lighting keyframes: frames do not depend on their order, no light is stale, and nothing flickers.

#include "tests/support/frame_bytes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Root of the mean square of the relative difference in luminance.
double relative_rms(const Image<Rgb>& a, const Image<Rgb>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double x = luminance(a.pixels[i]), y = luminance(b.pixels[i]);
        if (x + y > 0.0) sum += std::pow(2.0 * (x - y) / (x + y), 2.0);
    }
    return std::sqrt(sum / static_cast<double>(a.size()));
}

Image<Rgb> render_alone(const Scene& scene, const RenderSettings& settings, int frame) {
    return Sequence(scene, settings).render(frame).shaded.color;
}

std::uint64_t count_records(const FrameStatistics& statistics) {
    std::uint64_t count = statistics.counts.records;
    for (const KeyframeStatistics& keyframe : statistics.keyframes) count += keyframe.counts.records;
    return count;
}

/// Records of frames 0 to 20 in a sequence.
std::uint64_t count_shot_records(const Scene& scene, int light_step) {
    Sequence sequence(scene, shot_settings(light_step));
    std::uint64_t count = 0;
    for (int frame = 0; frame < shot_frames; ++frame) count += count_records(sequence.render(frame).statistics);
    return count;
}

void expect_any_order(const Scene& scene) {
    RenderSettings settings = shot_settings(4);
    settings.perception.guide = Guide::full;
    settings.sampling.spp = 2;
    settings.cache.gather = 16;
    Sequence forward(scene, settings);
    std::vector<std::string> expected;
    for (int frame = 0; frame <= 9; ++frame) expected.push_back(frame_bytes(forward, scene, settings, frame));
    EXPECT_FALSE(expected[5] == expected[6]);
    Sequence jumping(scene, settings);
    for (const int frame : {9, 2, 6, 5}) {
        EXPECT_TRUE(frame_bytes(jumping, scene, settings, frame) == expected[frame]) << frame;
    }
    for (const int threads : {1, 3}) {
        EXPECT_TRUE(frame_bytes(threads, scene, settings, {6})[0] == expected[6]) << threads << " threads";
    }
}

TEST(LightingKeyframes, IC14_AFrameAloneInASequenceInAnyOrderOnAnyThreads) {
    expect_any_order(make_shot_with_mover());
    expect_any_order(make_shot_with_moving_camera());
}

/// Relative errors of frame 5, with a fill of its own and with lighting keyframes.
struct FrameErrors {
    double own, keyframes;
};

FrameErrors find_errors(const Scene& scene) {
    RenderSettings dense = shot_settings(0);
    dense.cache.accuracy = 0.0;
    dense.cache.gather = 1024;
    const Image<Rgb> truth = render_alone(scene, dense, 5);
    const auto error_of = [&](int light_step) {
        return relative_rms(render_alone(scene, shot_settings(light_step), 5), truth);
    };
    return {error_of(0), error_of(10)};
}

/// Light is computed in the frame where something moves fast or near: lighting keyframes err hardly more than a fill of
/// the frame's own.
TEST(LightingKeyframes, IC14_LightOfAnotherTimeIsNotUsed) {
    Scene scene = make_shot();
    const int board = add_mesh(scene, make_box({1.5, 1.5, 0.05}, 1));
    scene.nodes[board].transform.translation = move_between({-2.0, 0.8, -1.5}, {2.5, 0.8, 0.5});
    const auto [own, keyframes] = find_errors(scene);
    EXPECT_LT(keyframes, own + 0.01);
    EXPECT_LT(keyframes, 0.03);
}

TEST(LightingKeyframes, IC14_WhereNothingMovesOneMomentServesAllFrames) {
    const Scene scene = make_shot();
    EXPECT_EQ(count_shot_records(scene, 10), count_records(Sequence(scene, shot_settings(0)).render(0).statistics));
    EXPECT_TRUE(render_alone(scene, shot_settings(10), 13).pixels == render_alone(scene, shot_settings(10), 0).pixels);
}

TEST(LightingKeyframes, IC20_WhatIsAtRestDoesNotFlicker) {
    const Scene scene = make_shot_with_mover();
    RenderSettings settings = shot_settings(10);
    settings.cache.gather = 256;
    Sequence sequence(scene, settings);
    double largest = 0.0;
    Image<Rgb> before;
    Image<float> threshold;
    for (int frame = 0; frame < 30; ++frame) {
        const FrameOutput out = sequence.render(frame, {.maps = frame == 0, .progress = {}});
        if (frame == 0) threshold = out.limits.threshold;
        const Image<Rgb>& now = out.shaded.color;
        for (int y = 0; frame > 0 && y < now.height; ++y) {
            for (int x = 0; x < now.width / 2; ++x) {  // the mover is in the right half
                const double change = std::abs(luminance(now(x, y)) - luminance(before(x, y)));
                largest = std::max(largest, change * scene.film.viewing.display_white / threshold(x, y));
            }
        }
        before = now;
    }
    EXPECT_LT(largest, 0.1);
}

TEST(LightingKeyframes, FX10_WhereOnlyTheCameraMovesLightIsCarriedOver) {
    const Scene scene = make_shot_with_moving_camera();
    const std::uint64_t own = count_shot_records(scene, 0), keyframes = count_shot_records(scene, 10);
    EXPECT_LT(10 * keyframes, own);
    EXPECT_LT(relative_rms(render_alone(scene, shot_settings(10), 5), render_alone(scene, shot_settings(0), 5)), 0.05);
}

TEST(LightingKeyframes, FX10_WhereOnlyTheCameraMovesFurtherBouncesAreCarriedOver) {
    const Scene scene = make_shot_with_moving_camera();
    RenderSettings own = shot_settings(0), keyframes = shot_settings(10);
    own.light.bounces = keyframes.light.bounces = 4;
    Sequence sequence(scene, keyframes);
    for (const int frame : {4, 6}) {
        const FrameOutput out = sequence.render(frame);
        EXPECT_EQ(out.statistics.counts.multi_bounce_rays, 0u) << frame;
        EXPECT_LT(relative_rms(out.shaded.color, render_alone(scene, own, frame)), 0.05) << frame;
    }
    const FrameOutput moving = Sequence(make_shot_with_mover(), keyframes).render(4);
    EXPECT_GT(moving.statistics.counts.multi_bounce_rays, 0u) << "what moves changes this light";
}

/// The camera crosses x = 8 m, where the origin of single-precision coordinates jumps by 16 m.
TEST(LightingKeyframes, FX10_LightIsCarriedOverWhereTheAnchorChanges) {
    Scene scene = make_shot_with_moving_camera();
    for (Node& node : scene.nodes) {
        for (glm::dvec3& place : node.transform.translation.values) place.x += 7.0;
    }
    EXPECT_LT(10 * count_shot_records(scene, 10), count_shot_records(scene, 0));
    EXPECT_LT(relative_rms(render_alone(scene, shot_settings(10), 20), render_alone(scene, shot_settings(0), 20)),
              0.05);
}

TEST(LightingKeyframes, FX10_ALampThatBlinksLightsNoFrameBeforeOrAfter) {
    Scene scene = make_shot();
    Track<glm::dvec3>& color = scene.lights[0].color;
    color.values = {glm::dvec3(8.0), glm::dvec3(2.0), glm::dvec3(8.0)};
    color.interpolation = Interpolation::step;
    color.sampling.period = 5.0 / 30.0;
    Sequence sequence(scene, shot_settings(20));
    for (const int frame : {4, 5, 9, 10}) {
        const FrameOutput out = sequence.render(frame);
        EXPECT_LT(relative_rms(out.shaded.color, render_alone(scene, shot_settings(0), frame)), 0.02) << frame;
        EXPECT_LT(out.statistics.counts.records, 10u) << frame;
    }
}

TEST(LightingKeyframes, FX10_AnObjectThatMovesLaterLeavesNoTraceBefore) {
    Scene scene = make_shot();
    const int board = add_mesh(scene, make_box({2.0, 2.0, 0.05}, 1));
    Track<glm::dvec3>& place = scene.nodes[board].transform.translation;
    place.values = {{0.0, 1.0, 8.0}, {0.0, 1.0, 8.0}, {0.0, 1.0, -2.0}};  // from behind the camera
    place.sampling.period = 9.0 / 30.0;
    RenderSettings settings = shot_settings(20);
    settings.cache.gather = 256;
    RenderSettings own = settings;
    own.cache.light_step = 0;
    EXPECT_LT(relative_rms(render_alone(scene, settings, 8), render_alone(scene, own, 8)), 0.06);
}

/// A mover at one place at frames 0 and 10, and at another half way; alone lighting keyframes cannot tell.
/// Frame 5 of make_shot with a blue box that goes and returns: its error, and that of a fill of the frame's own.
TEST(LightingKeyframes, IC14_AnObjectThatTouchesOrLeavesTheFloorOrCrossesBetweenMoments) {
    for (const auto& [ends, middle] : {std::pair(glm::dvec3(0.0, 2.4, -2.0), glm::dvec3(0.0, 0.45, -2.0)),
                                       std::pair(glm::dvec3(0.0, 0.45, -2.0), glm::dvec3(0.0, 2.4, -2.0)),
                                       std::pair(glm::dvec3(-9.0, 0.45, -2.0), glm::dvec3(-1.0, 0.45, -2.0))}) {
        Scene scene = make_shot();
        const int box = add_mesh(scene, make_box(glm::dvec3(0.9), add_lambert(scene, {0.2, 0.3, 0.7})));
        scene.nodes[box].transform.translation.values = {ends, middle, ends};
        scene.nodes[box].transform.translation.sampling.period = 5.0 / 30.0;
        const auto [own, keyframes] = find_errors(scene);
        EXPECT_LT(keyframes, 1.3 * own) << middle.x << ' ' << middle.y;
        EXPECT_LT(keyframes, 0.03) << middle.x << ' ' << middle.y;
    }
}

/// Filters of the outermost pixels reach beyond the picture.
TEST(LightingKeyframes, IC14_ALampThatGoesAndReturnsLightsNoBorder) {
    Scene scene = make_shot();
    const auto lamp = std::ranges::find_if(scene.nodes, [](const Node& node) { return node.light != no_index; });
    const glm::dvec3 here = lamp->transform.translation.values.front();
    lamp->transform.translation.values = {here, here + glm::dvec3(0.0, 20.0, 0.0), here};
    lamp->transform.translation.sampling.period = 5.0 / 30.0;
    RenderSettings settings = shot_settings(10), own = shot_settings(0);
    settings.picture.filter = own.picture.filter = PixelFilter::blackman_harris;
    settings.sampling.spp = own.sampling.spp = 16;
    const Image<Rgb> found = render_alone(scene, settings, 5), expected = render_alone(scene, own, 5);
    for (int y = 0; y < found.height; ++y) {
        for (const int x : {0, found.width - 1})
            EXPECT_LE(luminance(found(x, y)), 1.5 * luminance(expected(x, y))) << x << ' ' << y;
    }
}

/// Everything turns together, so no light changes: all of it rides with the surfaces. What the frame computes are
/// probes.
TEST(LightingKeyframes, RecordsRideWithTheirSurfaces) {
    Scene scene = make_shot();
    Node turntable;
    turntable.transform.rotation.values = {no_turn, turn_about_y(1.5)};
    scene.nodes.insert(scene.nodes.begin(), turntable);
    for (std::size_t n = 1; n + 1 < scene.nodes.size(); ++n) scene.nodes[n].parent = 0;
    scene.nodes.back().transform.translation = glm::dvec3(0.0, 9.0, 0.01);
    scene.nodes.back().transform.rotation = glm::quatLookAt(glm::dvec3(0, -1, 0), glm::dvec3(0, 0, -1));
    Sequence sequence(scene, shot_settings(10));
    const FrameOutput first = sequence.render(0);
    const FrameOutput middle = sequence.render(5);
    ASSERT_EQ(first.statistics.keyframes.size(), 1u);
    EXPECT_LT(4 * middle.statistics.counts.records, first.statistics.keyframes[0].counts.records);
    EXPECT_LT(relative_rms(middle.shaded.color, render_alone(scene, shot_settings(0), 5)), 0.05);
}

}  // namespace
}  // namespace aleph
