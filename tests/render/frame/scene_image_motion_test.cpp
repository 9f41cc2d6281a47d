// Motion of a scene's frames from their quick estimates (--motion image).

#include "engine/load/load_scene.h"
#include "motion/image_motion.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(SceneMotionFromImages, IsTheSearchBetweenTheQuickEstimates) {
    const Scene scene = load_scene(source_folder() / "scenes/pool/scene.json");
    RenderSettings settings;
    settings.picture.width = 80;
    settings.picture.height = 60;
    settings.guide.motion = MotionSource::image;
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
    EXPECT_EQ(last.motion.displacement,
              compute_image_motion(last.estimate, before.estimate, OtherFrame::previous).displacement);
    // Geometry's maps are there; nothing is marked hidden.
    EXPECT_FALSE(now.surface.depth.empty());
    settings.guide.motion = MotionSource::model;
    EXPECT_NE(Sequence(scene, settings).render(20, request).motion.displacement, truth.displacement);
}

TEST(SceneMotionFromImages, NoneAcrossACut) {
    Scene scene = load_scene(source_folder() / "scenes/cornell/scene.json");
    scene.film.cuts = {5};
    RenderSettings settings;
    settings.picture.width = 40;
    settings.picture.height = 30;
    settings.guide.motion = MotionSource::image;
    const FrameOutput output = Sequence(scene, settings).render(4, {.frame = false, .maps = true, .progress = {}});
    for (const glm::dvec2& d : output.motion.displacement.pixels) EXPECT_EQ(d, glm::dvec2(0.0));
    EXPECT_EQ(output.motion.validity.pixels.front(), MotionValidity::no_counterpart);
    EXPECT_EQ(output.statistics.counts.rays.total(), output.statistics.traced.all);
}

}  // namespace
}  // namespace aleph
