#pragma once
// Axis-parallel boxes around points.

#include <glm/common.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <limits>

namespace aleph {

/// False for NaN.
inline bool is_within(const glm::dvec3& p, double limit) {
    return glm::abs(p.x) < limit && glm::abs(p.y) < limit && glm::abs(p.z) < limit;
}

/// m; empty until something is added.
struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};

    bool empty() const { return !(low.x <= high.x); }
    void add(const glm::dvec3& point) {
        low = glm::min(low, point);
        high = glm::max(high, point);
    }
    glm::dvec3 corner(int i) const { return {i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z}; }
    void add_corners_to(Bounds& world_bounds, const glm::dmat4& world) const {
        for (int i = 0; i < 8; ++i) world_bounds.add(glm::dvec3(world * glm::dvec4(corner(i), 1.0)));
    }
};

}  // namespace aleph
