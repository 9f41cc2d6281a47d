// A cache whose radii follow a published rule: more values, and less error, where more is asked.

#include "scenes/studies/ruled_light.h"

#include <gtest/gtest.h>

#include "engine/load/load_scene.h"
#include "scenes/studies/reference_light.h"
#include "scenes/studies/study_options.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

struct Asked {
    const char* name;
    RadiusRule rule;
    double loose, tight;
};

TEST(RuledLight, ErrorFallsAsMoreIsAsked) {
    const std::string file = (source_folder() / "scenes" / "cornell" / "scene.json").string();
    const Scene scene = load_scene(file);
    RenderSettings settings = scene_settings(scene, file, "64x48", {"gather=256"});
    settings.perception.guide = Guide::none;
    const Sequence sequence(scene, settings);
    const StudyFrame frame(sequence, settings, 0);
    const PixelGrid grid{2};
    const ReferenceLight reference = gather_reference(frame, settings, grid, 1024, {});
    const Image<float> threshold(settings.width, settings.height, 1.0f);
    for (const Asked& asked :
         {Asked{"split sphere", RadiusRule::split_sphere, 0.8, 0.1},
          Asked{"nearest", RadiusRule::nearest_clamped, 4.0, 0.5}, Asked{"Hessian", RadiusRule::hessian, 1e-2, 1e-5}}) {
        const CachedLight loose = compute_ruled_light(frame, settings, asked.rule, asked.loose);
        const CachedLight tight = compute_ruled_light(frame, settings, asked.rule, asked.tight);
        EXPECT_GT(tight.record_count, loose.record_count) << asked.name;
        EXPECT_LT(measure_light(tight.light, reference, grid, threshold).relative_mse,
                  0.5 * measure_light(loose.light, reference, grid, threshold).relative_mse)
            << asked.name;
    }
}

}  // namespace
}  // namespace aleph
