// Motion of a scene's frames from their quick estimates (--motion census, image, flow), and from rasterized maps.

#include "engine/load/load_scene.h"
#include "motion/picture_motion.h"
#include "motion/raster.h"
#include "render/frame/sequence.h"
#include "tests/support/numbers.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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
