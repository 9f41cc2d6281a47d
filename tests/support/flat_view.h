#pragma once

#include "tests/support/render_scenes.h"

namespace aleph {

/// Adds a camera at z = 5 m that looks along -z, by parallel rays; and exposure and range are those of a simple shot.
inline void add_flat_view(Scene& scene, double half_height, const glm::dvec2& shutter = glm::dvec2(0.0)) {
    scene.exposure = 1.0;
    scene.range = FrameRange{0, 100};
    add_camera(scene, {0.0, 0.0, 5.0}, glm::dvec3(0.0));
    Camera& camera = scene.cameras.back();
    camera.orthographic = true;
    camera.half_height = half_height;
    camera.shutter = shutter;
}

}  // namespace aleph
