#include "scenes/studies/raster_motion.h"

#include <cmath>

#include "motion/reprojection.h"

namespace aleph {

namespace {

/// Pixels, y down; of a point before the camera.
glm::dvec2 find_place(const Scene& scene, const PosedView& view, const Hit& hit) {
    const auto [node, mesh] = view.pose.instances[static_cast<std::size_t>(hit.instance)];
    const glm::dvec3 point = surface_point(scene.meshes[mesh], view.pose.meshes[mesh], hit);
    const glm::dvec3 world(view.pose.world[node] * glm::dvec4(point, 1.0));
    return project_camera_point(view.view, to_camera(view.view, world));
}

}  // namespace

float quantize_coordinate(float coordinate) {
    return std::round(coordinate * 255.0f) / 255.0f;
}

MotionField compute_raster_motion(const Scene& scene, const PosedView& other, const Image<Hit>& hits,
                                  const MotionField& exact) {
    MotionField motion = exact;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (exact.validity.pixels[i] != MotionValidity::valid) continue;
        Hit quantized = hits.pixels[i];
        quantized.u = quantize_coordinate(quantized.u);
        quantized.v = quantize_coordinate(quantized.v);
        motion.displacement.pixels[i] += find_place(scene, other, quantized) - find_place(scene, other, hits.pixels[i]);
    }
    return motion;
}

}  // namespace aleph
