// A moving truck and a lit box, our own models (tests/assets/gltf/author_models.py) and, where they are there, those
// that other programs wrote: they move and render.
// Motion of a scene's frames from their quick estimates (--motion census, image, flow), and from rasterized maps.

#include "engine/load/load_scene.h"
#include "motion/picture_motion.h"
#include "motion/raster.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

RenderSettings small_settings() {
    RenderSettings settings = quick_settings(96, 72);
    settings.cache.accuracy = 0.3;
    return settings;
}

/// Its parameter: name in tests/assets/gltf or in the folder of other programs' files.
class AssetRender : public testing::TestWithParam<const char*> {
  protected:
    void SetUp() override {
        file_ = own_assets_folder() / "gltf" / GetParam();
        if (!std::filesystem::exists(file_)) file_ = assets_folder() / "gltf" / GetParam();
        if (!std::filesystem::exists(file_)) GTEST_SKIP() << missing_asset(file_);
    }
    std::filesystem::path file_;
};
class TruckRender : public AssetRender {};
class BoxRender : public AssetRender {};

const auto name_of = [](const auto& file) { return std::filesystem::path(file.param).stem().string(); };
INSTANTIATE_TEST_SUITE_P(All, TruckRender, testing::Values("truck.glb", "CesiumMilkTruck.glb"), name_of);
INSTANTIATE_TEST_SUITE_P(All, BoxRender, testing::Values("lamp_box.glb", "CornellBox.glb"), name_of);

TEST_P(TruckRender, RollsItsWheelsAndNothingElse) {
    const Scene scene = load_scene(file_);
    Sequence sequence(scene, small_settings());
    const FrameOutput output = sequence.render(3, {.maps = true, .progress = {}});
    const ScenePose frame = pose(scene, scene.film.frame_rate.seconds_of(3));
    int wheel_pixels = 0, body_pixels = 0;
    double fastest = 0.0;
    for (const auto [x, y] : all_pixels(output.view)) {
        const Hit& hit = output.hits(x, y);
        if (hit.instance == no_index) continue;
        const int node = frame.instances[hit.instance].node;
        const double moved = glm::length(output.motion.displacement(x, y));
        if (is_animated(scene.nodes[node].transform.rotation)) {
            ++wheel_pixels;
            fastest = std::max(fastest, moved);
        } else {
            ++body_pixels;
            EXPECT_EQ(moved, 0.0) << x << ", " << y;
        }
    }
    EXPECT_GT(wheel_pixels, 20);
    EXPECT_GT(body_pixels, 200);
    // A rim of at most .438 m turns by the animation's step per frame. In the picture, its chord is at most as long as
    // at the nearest distance.
    const double turn =
        glm::angle(glm::inverse(evaluate(scene.nodes.back().transform.rotation, scene.film.frame_rate.seconds_of(3))) *
                   evaluate(scene.nodes.back().transform.rotation, scene.film.frame_rate.seconds_of(4)));
    const double step = std::min(turn, 2.0 * 3.14159265358979 - turn);
    float nearest = 1e30f;
    for (const float z : output.surface.depth.pixels) nearest = std::min(nearest, z);
    EXPECT_GT(fastest, 0.2);
    EXPECT_LE(fastest, 2.0 * 0.4375 * std::sin(step / 2.0) * output.view.pixels_per_unit / nearest);

    const FrameStatistics& statistics = output.statistics;
    EXPECT_EQ(statistics.counts.invalid_samples, 0u);
    EXPECT_EQ(statistics.counts.rays.total(), statistics.traced.all);
    EXPECT_GT(statistics.counts.records, 0u);
    // The scene has no lights and gets a white environment, so the paint shows its texture's colour.
    double blueness = 0.0;
    for (std::size_t i = 0; i < output.shaded.color.size(); ++i) {
        const Rgb& c = output.shaded.color.pixels[i];
        if (output.hits.pixels[i].instance != no_index) blueness = std::max<double>(blueness, c.z - c.x);
        EXPECT_GE(luminance(c), 0.0f);
    }
    EXPECT_GT(blueness, 0.05);  // the sign on its side
}

TEST_P(BoxRender, BleedsColour) {
    const Scene scene = load_scene(file_);
    RenderSettings settings = small_settings();
    settings.cache.gather = 256;
    const auto render = [&](int bounces) {
        RenderSettings s = settings;
        s.light.bounces = bounces;
        return Sequence(scene, s).render(0);
    };
    const FrameOutput direct = render(0), full = render(1);
    EXPECT_EQ(direct.statistics.counts.rays.gather, 0u);
    // The light that the bounce adds has the walls' colours: reddish on one side of the picture, greenish on the other.
    Rgb left(0.0f), right(0.0f);
    double more = 0.0, less = 0.0;  // reflections are sampled, so single pixels may get darker
    for (const auto [x, y] : all_pixels(96, 72)) {
        const Rgb added = full.shaded.color(x, y) - direct.shaded.color(x, y);
        (luminance(added) >= 0.0f ? more : less) += luminance(added);
        const auto& hit = full.hits(x, y);
        if (hit.instance == no_index) continue;
        (x < 48 ? left : right) += added;
    }
    EXPECT_LT(-less, 0.05 * more);
    const float left_tint = (left.x - left.y) / luminance(left), right_tint = (right.x - right.y) / luminance(right);
    EXPECT_GT(std::abs(left_tint - right_tint), 0.1f);
    EXPECT_LT(left_tint * right_tint, 0.0f) << left_tint << " " << right_tint;
    // Neither the scene nor the camera moves.
    const FrameOutput maps = Sequence(scene, settings).render(0, {.frame = false, .maps = true, .progress = {}});
    for (const glm::dvec2& d : maps.motion.displacement.pixels) EXPECT_EQ(d, glm::dvec2(0.0));
}

TEST(SceneMotionFromImages, IsTheSearchBetweenTheQuickEstimates) {
    const Scene scene = load_scene(source_folder() / "scenes/pool/scene.json");
    RenderSettings settings{.picture = {.width = 80, .height = 60}};
    settings.guide.motion = MotionSource::census;
    const FrameRequest request{.frame = false, .maps = true, .progress = {}};
    Sequence sequence(scene, settings);
    const FrameOutput now = sequence.render(20, request), next = sequence.render(21, request);
    const MotionField truth = compute_image_motion(now.estimate, next.estimate);
    EXPECT_EQ(now.motion.displacement, truth.displacement);
    EXPECT_EQ(now.motion.validity, truth.validity);
    EXPECT_EQ(now.statistics.counts.rays.total(), now.statistics.traced.all);
    // The last frame is compared with the previous one.
    const FrameRange range = sequence.range();
    const FrameOutput last = sequence.render(range.last, request), before = sequence.render(range.last - 1, request);
    MotionField back = compute_image_motion(last.estimate, before.estimate);
    turn_round(back);
    EXPECT_EQ(last.motion.displacement, back.displacement);
    // Geometry's maps are there; nothing is marked hidden.
    EXPECT_FALSE(now.surface.depth.empty());
    settings.guide.motion = MotionSource::model;
    EXPECT_NE(Sequence(scene, settings).render(20, request).motion.displacement, truth.displacement);
}

TEST(SceneMotionFromImages, NoneAcrossACut) {
    Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    scene.film.cuts = {5};
    RenderSettings settings{.picture = {.width = 40, .height = 30}};
    settings.guide.motion = MotionSource::census;
    const FrameOutput output = Sequence(scene, settings).render(4, {.frame = false, .maps = true, .progress = {}});
    for (const glm::dvec2& d : output.motion.displacement.pixels) EXPECT_EQ(d, glm::dvec2(0.0));
    EXPECT_EQ(output.motion.validity.pixels.front(), MotionValidity::no_counterpart);
    EXPECT_EQ(output.statistics.counts.rays.total(), output.statistics.traced.all);
}

/// Errors of the valid pixels on what moves, beside the error of no motion at all.
struct MoverErrors {
    double valid = 0.0;   ///< share of the pixels
    double median = 0.0;  ///< of the valid ones, pixels
    double none = 0.0;    ///< median of the motion
};

MoverErrors find_mover_errors(const MotionField& field, const MotionField& truth) {
    std::vector<double> errors, lengths;
    for (std::size_t i = 0; i < field.displacement.size(); ++i) {
        const double length = glm::length(truth.displacement.pixels[i]);
        if (truth.validity.pixels[i] != MotionValidity::valid || length < 1.0) continue;
        lengths.push_back(length);
        if (field.validity.pixels[i] == MotionValidity::valid)
            errors.push_back(glm::length(field.displacement.pixels[i] - truth.displacement.pixels[i]));
    }
    const auto median = [](std::vector<double>& values) {
        std::ranges::sort(values);
        return values.empty() ? infinity : values[values.size() / 2];
    };
    return {static_cast<double>(errors.size()) / static_cast<double>(lengths.size()), median(errors), median(lengths)};
}

TEST(SceneMotionFromImages, WhatIsValidOnTheBoomerangIsNearTheTruth) {
    const Scene scene = load_scene(source_folder() / "scenes/boomerang/scene.json");
    Sequence sequence(scene, RenderSettings());
    const FrameRequest request{.frame = false, .maps = true, .progress = {}};
    const FrameOutput now = sequence.render(24, request), next = sequence.render(25, request);
    const auto find_errors = [&](PictureSearch search) {
        const auto prepare = [&](const FrameOutput& frame) { return prepare_picture(frame.estimate, search); };
        return find_mover_errors(compute_picture_motion(prepare(now), prepare(next), search), now.motion);
    };
    const MoverErrors printed = find_errors(PictureSearch::census), checked = find_errors(PictureSearch::checked);
    EXPECT_EQ(printed.valid, 1.0);
    EXPECT_GT(printed.median, printed.none) << "worse than no motion";
    EXPECT_LT(checked.median, 0.3 * printed.median);
    EXPECT_GT(checked.valid, 0.1);
    EXPECT_LT(checked.valid, 0.3);
    if (!has_flow()) return;
    const MoverErrors flow = find_errors(PictureSearch::flow);
    EXPECT_GT(flow.valid, 0.85);
    EXPECT_LT(flow.median, 0.1 * flow.none);
}

TEST(SceneMotionFromMaps, IsRasterizedBothWaysAndMarksWhatIsHidden) {
    const Scene scene = load_scene(source_folder() / "scenes/pool/scene.json");
    RenderSettings settings{.picture = {.width = 80, .height = 60}};
    const FrameRequest request{.frame = false, .maps = true, .progress = {}};
    const FrameOutput exact = Sequence(scene, settings).render(20, request);
    settings.guide.motion = MotionSource::raster;
    Sequence sequence(scene, settings);
    const FrameOutput output = sequence.render(20, request);
    const int camera = CameraNames(scene).find("");
    const auto pose_frame = [&](int frame) {
        return make_posed_view(scene, scene.film.frame_rate.seconds_of(frame), camera, 80, 60);
    };
    const PosePlan plan = make_pose_plan(scene);
    ModelMotion model(scene, plan);
    const PosedView now = pose_frame(20), next = pose_frame(21), before = pose_frame(19);
    const Image<Hit> items = rasterize(scene, now);
    EXPECT_EQ(output.motion.displacement, compute_raster_motion(model, scene, now, next, items).displacement);
    MotionField back = compute_raster_motion(model, scene, now, before, items, OtherFrame::previous);
    turn_round(back);
    EXPECT_EQ(output.backward.displacement, back.displacement);
    EXPECT_NE(output.motion.displacement, exact.motion.displacement);
    std::size_t same = 0;
    for (std::size_t i = 0; i < output.motion.validity.size(); ++i)
        same += output.motion.validity.pixels[i] == exact.motion.validity.pixels[i];
    EXPECT_GT(same, output.motion.validity.size() * 98 / 100);
    EXPECT_EQ(std::ranges::count(exact.motion.validity.pixels, MotionValidity::hidden) > 0,
              std::ranges::count(output.motion.validity.pixels, MotionValidity::hidden) > 0);
}

}  // namespace
}  // namespace aleph
