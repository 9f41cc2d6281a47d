// A sequence of frames as C++ programs use it.

#include "render/frame/sequence.h"

#include <numeric>

#include "tests/support/scenes/moving_box.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

std::vector<Image<Rgb>> render_two(Sequence& sequence) {
    std::vector<Image<Rgb>> pictures;
    for (const int frame : {0, 15}) pictures.push_back(sequence.render(frame).shaded.color);
    return pictures;
}

TEST(Sequence, SeesWithAProgramsOwnModelOfVision) {
    const OnesVision own;
    RenderSettings settings = quick_settings(40, 30);
    settings.perception.vision = &own;
    const FrameOutput frame = Sequence(make_moving_scene(), settings).render(15);
    EXPECT_EQ(frame.perception.aleph, Image<float>(40, 30, 1.0f));
    EXPECT_EQ(frame.limits.alpha, Image<float>(40, 30, static_cast<float>(settings.cache.accuracy)));
}

double share_equal(const Image<Rgb>& a, const Image<Rgb>& b) {
    const auto equal =
        std::inner_product(a.pixels.begin(), a.pixels.end(), b.pixels.begin(), 0, std::plus<>(), std::equal_to<>());
    return static_cast<double>(equal) / static_cast<double>(a.size());
}

TEST(Sequence, NoiseOfAStillCameraIsNewInEachFrameWhereAnErrorIsAskedFor) {
    Scene scene = make_moving_scene();
    scene.nodes[1].transform.translation.values = {{-1.0, 0.5, 0.0}, {-0.999, 0.5, 0.0}};  // hardly moves
    const auto render_both = [&](double error) {
        RenderSettings settings = quick_settings(40, 30);
        settings.perception.guide = Guide::none;
        settings.light.bounces = 0;
        if (error > 0.0) {
            follow_error(settings, error);
            settings.light.bounces = 0;
        }
        Sequence sequence(scene, settings);
        const Image<Rgb> first = sequence.render(10).shaded.color;
        return share_equal(first, sequence.render(11).shaded.color);
    };
    EXPECT_GT(render_both(0.0), 0.5);
    EXPECT_LT(render_both(4.0), 0.9 * render_both(0.0));
}

TEST(Sequence, NoiseOfAHeldFrameIsSeenMore) {
    Scene scene = make_moving_scene();
    RenderSettings settings = quick_settings(40, 30);
    follow_error(settings, 4.0);
    const FrameRequest request{.maps = true, .progress = {}};
    const float moving = Sequence(scene, settings).render(10, request).limits.threshold_noise(1, 28);
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.5, 0.0);
    const float held = Sequence(scene, settings).render(10, request).limits.threshold_noise(1, 28);
    EXPECT_LT(held, 0.9f * moving);
    EXPECT_GT(held, 0.0f);
}

TEST(Sequence, OwnsItsScene) {
    const RenderSettings settings = quick_settings(40, 30);
    const Scene kept = make_moving_scene();
    Sequence of_kept(kept, settings);
    const std::vector<Image<Rgb>> expected = render_two(of_kept);
    EXPECT_FALSE(expected[0].pixels == expected[1].pixels) << "nothing moves";

    Sequence of_temporary(make_moving_scene(), settings);
    EXPECT_TRUE(render_two(of_temporary)[1].pixels == expected[1].pixels);
    EXPECT_TRUE(Sequence(make_moving_scene(), settings).render(15).shaded.color.pixels == expected[1].pixels);

    // The fate of the caller's scene has no influence: every part that a frame reads is changed.
    auto changed = std::make_unique<Scene>(make_moving_scene());
    Sequence of_changed(*changed, settings);
    for (Node& node : changed->nodes) node.transform.translation = glm::dvec3(1e6);
    for (Material& material : changed->materials) material.base_color = material.glow.color = glm::dvec3(0.0);
    for (Mesh& mesh : changed->meshes) std::ranges::fill(mesh.positions, glm::vec3(0.0f));
    changed->nodes.clear();
    changed->meshes.clear();
    changed.reset();
    const std::vector<Image<Rgb>> pictures = render_two(of_changed);
    EXPECT_TRUE(pictures[0].pixels == expected[0].pixels);
    EXPECT_TRUE(pictures[1].pixels == expected[1].pixels);
}

TEST(Sequence, MovesWithItsScene) {
    const RenderSettings settings = quick_settings(40, 30);
    Sequence first(make_moving_scene(), settings);
    const std::vector<Image<Rgb>> expected = render_two(first);
    Sequence second(std::move(first));
    EXPECT_TRUE(render_two(second)[1].pixels == expected[1].pixels);
    EXPECT_EQ(second.scene().nodes.size(), 4u);
}

TEST(SequenceCameras, EachLooksFromItsFrameOn) {
    RenderSettings settings = quick_settings(40, 30);
    Scene scene = make_scene_with_two_cameras();
    scene.film.exposure = 1.0;
    Sequence both(scene, settings), eye(scene, settings, "eye"), close(scene, settings, "close");
    for (const int frame : {-3, 0, 9, 10, 25}) {
        const FrameOutput out = both.render(frame, {.maps = true, .progress = {}});
        const FrameOutput expected = (frame < 10 ? eye : close).render(frame, {.maps = true, .progress = {}});
        EXPECT_TRUE(out.surface.depth.pixels == expected.surface.depth.pixels) << frame;
        const bool is_last_of_shot = frame == 9;
        EXPECT_EQ(std::ranges::count(out.motion.validity.pixels, MotionValidity::valid) == 0, is_last_of_shot);
        EXPECT_GT(std::ranges::count(expected.motion.validity.pixels, MotionValidity::valid), 0) << "not a cut";
    }
    EXPECT_FALSE(both.render(9).shaded.color.pixels == both.render(10).shaded.color.pixels);
    EXPECT_EQ(both.scene().film.cuts, std::vector<std::int64_t>{10}) << "frame 4 changes nothing";
    EXPECT_TRUE(close.scene().film.cuts.empty());
}

TEST(SequenceCameras, FramesDoNotDependOnTheirOrder) {
    const RenderSettings settings = quick_settings(40, 30);
    Scene scene = make_scene_with_two_cameras();
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.5, 0.0);  // only cameras differ
    Sequence forward(scene, settings);
    const Image<Rgb> before = forward.render(8).shaded.color, after = forward.render(12).shaded.color;
    Sequence backward(scene, settings);
    EXPECT_TRUE(backward.render(12).shaded.color.pixels == after.pixels);
    EXPECT_TRUE(backward.render(8).shaded.color.pixels == before.pixels);
}

TEST(SequenceCameras, KeysAscendAndNameCameras) {
    const auto refuse = [](std::vector<CameraKey> keys) {
        Scene scene = make_scene_with_two_cameras();
        scene.film.camera_keys = std::move(keys);
        EXPECT_THROW(Sequence(scene, quick_settings(8, 6)), InputError);
    };
    refuse({{0, "eye"}, {0, "close"}});
    refuse({{0, "eye"}, {3, "floor"}});
}

/// Without a bound the tallest one takes more memory than most machines have.
TEST(Sequence, TheExposureOfATallPictureIsMeasuredFromFewPixels) {
    const double usual = Sequence(make_moving_scene(), quick_settings(8, 6)).exposure();
    for (const int height : {1024, 65536}) {
        const double tall = Sequence(make_moving_scene(), quick_settings(1, height)).exposure();
        EXPECT_GT(tall, 0.1 * usual) << height;
        EXPECT_LT(tall, 10.0 * usual) << height;
    }
}

TEST(Sequence, TheExposureOfAShotThatFadesInIsThatOfALaterFrame) {
    Scene scene = make_moving_scene();
    const double lit = Sequence(scene, quick_settings(8, 6)).exposure();
    for (Material& material : scene.materials) {
        Track<glm::dvec3>& light = material.glow.color;
        light = Track<glm::dvec3>({0.0, scene.film.frame_rate.seconds_of(1)}, {glm::dvec3(0.0), light.values.front()});
        light.interpolation = Interpolation::step;
    }
    const double faded = Sequence(scene, quick_settings(8, 6)).exposure();
    EXPECT_GT(faded, 0.3 * lit);
    EXPECT_LT(faded, 3.0 * lit);
    EXPECT_NE(faded, 1.0);
}

TEST(Sequence, RefusesAScenesFaults) {
    Scene scene = make_moving_scene();
    scene.nodes[1].meshes = {999};
    EXPECT_THROW(Sequence(scene, quick_settings(8, 6)), InputError);
}

TEST(Sequence, MovedFromIsAnErrorAndNoCrash) {
    Sequence first(make_moving_scene(), quick_settings(8, 6));
    Sequence second = std::move(first);
    EXPECT_NO_THROW(second.render(0));
    EXPECT_THROW(first.render(0), InputError);
    EXPECT_THROW(first.scene(), InputError);
    EXPECT_THROW(first.edit([](Scene&) {}), InputError);
}

}  // namespace
}  // namespace aleph
