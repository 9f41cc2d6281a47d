#pragma once
// Boxes around what stands in the world.

#include "engine/base/bounds.h"
#include "engine/pose/pose.h"

namespace aleph {

/// Adds the vertices of an instance, shown or not, as they stand at the frame's time.
inline void add_instance(Bounds& bounds, const Scene& scene, const ScenePose& frame, const Instance& instance) {
    const glm::dmat4& world = frame.world[instance.node];
    const auto add = [&](const glm::dvec3& point) { bounds.add(glm::dvec3(world * glm::dvec4(point, 1.0))); };
    const PosedMesh& posed = frame.meshes[instance.mesh];
    if (!posed.positions.empty()) {
        for (const glm::dvec3& point : posed.positions) add(point);
    } else {
        for (const glm::vec3& point : scene.meshes[instance.mesh].positions) add(glm::dvec3(point));
    }
}

}  // namespace aleph
