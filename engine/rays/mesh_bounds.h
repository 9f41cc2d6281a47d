#pragma once
// Bounds and area of a mesh in its own space, from which those of its instances follow without a look at every vertex.

#include <glm/vec3.hpp>
#include <limits>
#include <span>

namespace aleph {

/// m. If nothing was added, `low` is infinite.
struct BoundingBox {
    glm::vec3 low{std::numeric_limits<float>::infinity()}, high{-std::numeric_limits<float>::infinity()};

    void add(const glm::vec3& point);
    bool empty() const { return !(low.x <= high.x); }
    glm::vec3 center() const { return 0.5f * (low + high); }
    /// The k-th of eight.
    glm::vec3 corner(int k) const;
};

/// m.
struct BoundingSphere {
    glm::vec3 center{0.0f};
    float radius = 0.0f;
};

struct MeshBounds {
    BoundingBox box;
    BoundingSphere sphere;  ///< around the box's centre
    float area = 0.0f;      ///< m2, of all triangles
};

MeshBounds find_bounds(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles);

}  // namespace aleph
