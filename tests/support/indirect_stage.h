#pragma once

#include "render/cache/indirect_context.h"
#include "tests/support/render_scenes.h"

namespace aleph {

/// A scene that is ready for its indirect light to be computed: first hits of its picture and one accuracy everywhere.
struct IndirectStage {
    IndirectStage(Scene scene, int width, int height, double accuracy, int gather = 64)
        : stage(std::move(scene), width, height),
          lighting(stage.lighting()),
          settings(plain_settings(accuracy, gather)),
          alpha(width, height, static_cast<float>(accuracy)),
          centers(cast_centers(stage.rays, stage.view, nullptr)),
          context{.lighting = lighting,
                  .view = stage.view,
                  .settings = settings,
                  .accuracy = alpha,
                  .max_radius = scene_radius(stage.shading),
                  .progress = {}} {}

    Stage stage;
    LightingContext lighting;
    RenderSettings settings;
    Image<float> alpha;
    SampleHits centers;
    IndirectContext context;
};

}  // namespace aleph
