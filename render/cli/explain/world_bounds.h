#pragma once
// Bounds of instances in the world.

#include "engine/base/bounds.h"
#include "engine/pose/pose.h"

namespace aleph {

/// Adds the vertices of an instance, shown or hidden, at the time of the pose.
inline void add_instance(Bounds& bounds, const Scene& scene, const ScenePose& posed_scene, const Instance& instance) {
    const glm::dmat4& world = posed_scene.world[instance.node];
    const auto add = [&](const glm::dvec3& point) { bounds.add(glm::dvec3(world * glm::dvec4(point, 1.0))); };
    const PosedMesh& posed = posed_scene.meshes[instance.mesh];
    if (!posed.positions.empty()) {
        for (const glm::dvec3& point : posed.positions) add(point);
    } else {
        for (const glm::vec3& point : scene.meshes[instance.mesh].positions) add(glm::dvec3(point));
    }
}

}  // namespace aleph
