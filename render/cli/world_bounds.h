#pragma once
// Boxes around what stands in the world.

#include <limits>

#include "engine/pose.h"

namespace aleph {

/// m; empty until something is added.
struct WorldBounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(low.x <= high.x); }
    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
};

/// Adds the vertices of an instance, shown or not, as they stand at the frame's time.
inline void add_instance(WorldBounds& bounds, const Scene& scene, const SceneFrame& frame, const Instance& instance) {
    const glm::dmat4& world = frame.world[static_cast<std::size_t>(instance.node)];
    const auto add = [&](const glm::dvec3& point) { bounds.add(glm::dvec3(world * glm::dvec4(point, 1.0))); };
    const PosedMesh& posed = frame.meshes[static_cast<std::size_t>(instance.mesh)];
    if (!posed.positions.empty()) {
        for (const glm::dvec3& point : posed.positions) add(point);
    } else {
        for (const glm::vec3& point : scene.meshes[static_cast<std::size_t>(instance.mesh)].positions)
            add(glm::dvec3(point));
    }
}

}  // namespace aleph
