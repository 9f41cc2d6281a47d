// Frames in which nothing changes are rendered once.

#include "render/frame/static_spans.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int frames = 15;

template <class T, class ValueAt>
Track<T> make_keys(const Scene& scene, const ValueAt& value_at) {
    Track<T> track;
    track.sampling.period = scene.film.frame_rate.seconds_of(1);
    for (int frame = 0; frame < frames; ++frame) track.values.push_back(value_at(frame));
    return track;
}

/// At rest from frame 4 to frame 10.
double move_and_rest(int frame) {
    return 0.1 * (std::min(frame, 4) + std::max(frame - 10, 0));
}

/// A box before a camera, under a lamp. Its range is frames 0 to 14.
Scene make_scene() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_box(glm::dvec3(0.8), grey));
    add_mesh(scene, make_quad(6.0, 6.0, grey), {0.0, 0.0, -1.0});
    add_camera(scene, {0.0, 0.0, 3.0}, glm::dvec3(0.0));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {1.0, 1.0, 2.0});
    scene.lights[0].intensity = 20.0;
    scene.film.range = FrameRange{0, frames - 1};
    scene.film.exposure = 1.0;
    return scene;
}

Scene make_resting_scene() {
    Scene scene = make_scene();
    scene.nodes[0].transform.translation =
        make_keys<glm::dvec3>(scene, [](int frame) { return glm::dvec3(move_and_rest(frame), 0.0, 0.0); });
    return scene;
}

std::vector<std::int64_t> list_firsts(const Scene& scene, std::int64_t begin = 0, std::int64_t end = frames) {
    const std::vector<CameraShot> shots = list_camera_shots(scene, "");
    const PosePlan plan = make_pose_plan(scene);
    const auto shutter = [&](std::int64_t) { return scene.cameras[0].shutter; };
    StaticSpans kept(scene, plan, shots, shutter);
    std::vector<std::int64_t> firsts;
    for (std::int64_t frame = begin; frame < end; ++frame) {
        firsts.push_back(kept.find_first(frame));
        EXPECT_EQ(firsts.back(), StaticSpans(scene, plan, shots, shutter).find_first(frame))
            << "depends on other frames";
    }
    for (std::int64_t frame = end; frame-- > begin;) EXPECT_EQ(kept.find_first(frame), firsts[frame - begin]);
    return firsts;
}

using Firsts = std::vector<std::int64_t>;
const Firsts own{0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14};

TEST(StaticSpans, TheLastFrameAtRestHasMotionOfItsOwn) {
    EXPECT_EQ(list_firsts(make_resting_scene()), (Firsts{0, 1, 2, 3, 4, 4, 4, 4, 4, 4, 10, 11, 12, 13, 14}));
}

TEST(StaticSpans, EndAtTheRange) {
    Scene scene = make_resting_scene();
    scene.film.range = FrameRange{6, 9};
    // The last frame's motion is that from the frame before it.
    EXPECT_EQ(list_firsts(scene, 4, 12), (Firsts{4, 5, 6, 6, 6, 6, 10, 11}));
    scene.film.range = FrameRange{6, 6};
    EXPECT_EQ(list_firsts(scene, 4, 12), (Firsts{4, 5, 6, 7, 7, 7, 10, 11}));
    scene.film.range = FrameRange{0, 14};
    EXPECT_EQ(list_firsts(scene, 13, 18), (Firsts{13, 14, 15, 15, 15})) << "after its last key nothing changes";
}

TEST(StaticSpans, AStillSceneIsOne) {
    Scene scene = make_scene();
    EXPECT_EQ(list_firsts(scene, -2, 20), Firsts(22, 0));
    scene.nodes[0].transform.translation = make_keys<glm::dvec3>(scene, [](int) { return glm::dvec3(0.25); });
    EXPECT_EQ(list_firsts(scene, -2, 20), Firsts(22, 0)) << "keys that are equal";
}

TEST(StaticSpans, NoFrameIsCopiedAcrossACut) {
    Scene scene = make_resting_scene();
    scene.film.cuts = {7};
    EXPECT_EQ(list_firsts(scene), (Firsts{0, 1, 2, 3, 4, 4, 6, 7, 7, 7, 10, 11, 12, 13, 14}));
    scene = make_scene();
    scene.film.cuts = {7};
    EXPECT_EQ(list_firsts(scene), (Firsts{0, 0, 0, 0, 0, 0, 6, 7, 7, 7, 7, 7, 7, 7, 7}));
}

TEST(StaticSpans, AnOpenShutterSeesWhatChangesAroundAFrame) {
    Scene scene = make_resting_scene();
    scene.cameras[0].shutter = {-0.5, 0.5};
    EXPECT_EQ(list_firsts(scene), (Firsts{0, 1, 2, 3, 4, 5, 5, 5, 5, 9, 10, 11, 12, 13, 14}));
    // A lamp that is off only while the shutter of frame 7 is open, at no frame's own time.
    const double period = scene.film.frame_rate.seconds_of(1);
    scene.lights[0].intensity =
        Track<double>({0.0, 7.2 * period, 7.3 * period}, {20.0, 0.0, 20.0}, Interpolation::step);
    EXPECT_EQ(list_firsts(scene), own);
}

/// The firsts of a resting scene after a change that lasts for frame 7 alone.
template <class Change>
Firsts list_firsts_with(const Change& change) {
    Scene scene = make_resting_scene();
    change(scene);
    return list_firsts(scene);
}

TEST(StaticSpans, EveryKindOfChangeEndsOne) {
    const auto number = [](const Scene& scene, Interpolation how = Interpolation::linear) {
        Track<double> track = make_keys<double>(scene, [](int frame) { return frame == 7 ? 0.0 : 1.0; });
        track.interpolation = how;
        return track;
    };
    const auto vector = [](const Scene& scene) {
        return make_keys<glm::dvec3>(scene, [](int frame) { return glm::dvec3(frame == 7 ? 0.5 : 1.0); });
    };
    // Frames 6 to 8 change. Frame 5 is at rest until frame 6.
    const Firsts expected{0, 1, 2, 3, 4, 4, 6, 7, 8, 8, 10, 11, 12, 13, 14};
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.nodes[0].visible = number(s, Interpolation::step); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.nodes[0].transform.scale = vector(s); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.meshes[1].present = number(s, Interpolation::step); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.materials[0].gloss.roughness = number(s); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.lights[0].intensity = number(s); }), expected) << "a lamp blinks";
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.environment.radiance = vector(s); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.cameras[0].fov = number(s); }), expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) { s.nodes[2].transform.scale = vector(s); }), expected)
        << "the camera's node";
    EXPECT_EQ(list_firsts_with([&](Scene& s) {
                  s.point_caches.emplace_back().sampling.period = s.film.frame_rate.seconds_of(1);
                  s.point_caches[0].positions.assign(frames, s.meshes[0].positions);
                  s.point_caches[0].positions[7][3].x += 0.1f;
                  s.meshes[0].deformation.points = 0;
              }),
              expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) {
                  s.nodes[1].transform.operations = OperationStack{{OperationStack::Kind::rotate_x}, {}, {}};
                  s.nodes[1].transform.operations->sampling.period = s.film.frame_rate.seconds_of(1);
                  s.nodes[1].transform.operations->channels.assign(frames, 0.0);
                  s.nodes[1].transform.operations->channels[7] = 1.0;
              }),
              expected);
    EXPECT_EQ(list_firsts_with([&](Scene& s) {
                  Track<double>& track = s.materials[0].gloss.roughness = number(s, Interpolation::cubic);
                  track.values.assign(3 * frames, 0.5);
                  for (int i = 0; i < 3 * frames; ++i) track.values[i] = i % 3 == 1 ? 0.5 : 0.0;
                  track.values[3 * 7] = track.values[3 * 7 + 2] = 1.0;  // equal keys, but a curve between them
              }),
              expected);
    EXPECT_NE(list_firsts_with([&](Scene& s) { s.lights.emplace_back().intensity = number(s); }), own)
        << "no node has this lamp";
    EXPECT_EQ(list_firsts_with([&](Scene& s) {
                  s.cameras.emplace_back().fov = number(s);
                  s.nodes.emplace_back().camera = 1;
              }),
              list_firsts(make_resting_scene()))
        << "another camera";
}

/// The camera moves too, so that the noise of frames differs.
Scene make_seen_scene() {
    Scene scene = make_resting_scene();
    scene.nodes[2].transform.translation =
        make_keys<glm::dvec3>(scene, [](int frame) { return glm::dvec3(move_and_rest(frame), 0.2, 3.0); });
    return scene;
}

void expect_equal(const FrameOutput& a, const FrameOutput& b) {
    EXPECT_TRUE(a.shaded.color.pixels == b.shaded.color.pixels);
    EXPECT_TRUE(a.limits.alpha.pixels == b.limits.alpha.pixels);
    EXPECT_TRUE(a.motion.displacement.pixels == b.motion.displacement.pixels);
    EXPECT_TRUE(a.surface.depth.pixels == b.surface.depth.pixels);
    EXPECT_EQ(a.statistics.frame, b.statistics.frame);
    EXPECT_EQ(a.statistics.copy_of, b.statistics.copy_of);
}

class HeldFrames : public testing::TestWithParam<int> {};

TEST_P(HeldFrames, HaveTheSameBytesInAnyOrder) {
    RenderSettings settings = quick_settings(24, 16);
    settings.cache.light_step = GetParam();
    settings.sampling.spp = 2;
    const Scene scene = make_seen_scene();
    Sequence forward(scene, settings), backward(scene, settings);
    std::map<std::int64_t, FrameOutput> outputs;
    for (std::int64_t frame = 3; frame <= 11; ++frame) {
        outputs[frame] = forward.render(frame);
        const FrameStatistics& statistics = outputs[frame].statistics;
        const bool is_copy = frame > 4 && frame < 10;
        EXPECT_EQ(statistics.copy_of.value_or(-1), is_copy ? 4 : -1) << frame;
        EXPECT_EQ(statistics.traced.all == 0, is_copy) << frame;
        EXPECT_EQ(statistics.counts.rays.total() == 0, is_copy) << frame;
        EXPECT_EQ(statistics.counts.samples == 0, is_copy) << frame;
    }
    EXPECT_TRUE(outputs[4].shaded.color.pixels == outputs[9].shaded.color.pixels);
    EXPECT_FALSE(outputs[9].shaded.color.pixels == outputs[10].shaded.color.pixels) << "noise of its own";
    for (std::int64_t frame = 11; frame >= 3; --frame) expect_equal(backward.render(frame), outputs[frame]);
    for (const std::int64_t frame : {4, 7, 10}) expect_equal(Sequence(scene, settings).render(frame), outputs[frame]);
}
INSTANTIATE_TEST_SUITE_P(LightSteps, HeldFrames, testing::Values(0, 6));

TEST(StaticFrame, IsNotACopyWithOtherContents) {
    const RenderSettings settings = quick_settings(24, 16);
    Sequence sequence(make_seen_scene(), settings), other(make_seen_scene(), settings);
    sequence.render(5);
    const FrameRequest maps{.maps = true, .progress = {}};
    const FrameOutput with_maps = sequence.render(6, maps);
    EXPECT_FALSE(with_maps.surface.depth.empty());
    EXPECT_GT(with_maps.statistics.traced.all, 0u);
    expect_equal(with_maps, other.render(6, maps));
    const FrameOutput again = sequence.render(7, maps);
    EXPECT_FALSE(again.surface.depth.empty());
    EXPECT_EQ(again.statistics.traced.all, 0u);
    EXPECT_TRUE(sequence.render(7).surface.depth.empty());
}

TEST(StaticFrame, EndsWithAnEdit) {
    const RenderSettings settings = quick_settings(24, 16);
    Sequence sequence(make_seen_scene(), settings);
    const FrameOutput before = sequence.render(5);
    sequence.edit([](Scene& scene) { scene.nodes[0].transform.scale = glm::dvec3(1.5); });
    const FrameOutput edited = sequence.render(6);
    EXPECT_FALSE(edited.shaded.color.pixels == before.shaded.color.pixels);
    EXPECT_FALSE(edited.statistics.copy_of) << "its motion is that of the edit";
    const FrameOutput after = sequence.render(7);
    EXPECT_EQ(after.statistics.copy_of.value_or(-1), 4);
    EXPECT_GT(after.statistics.traced.all, 0u) << "the frame after an edit is no copy's source";
    EXPECT_EQ(sequence.render(8).statistics.traced.all, 0u);
}

}  // namespace
}  // namespace aleph
