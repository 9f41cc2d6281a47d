#include "render/surface/carried_point.h"

#include <cmath>

namespace aleph {

namespace {

/// A direction that keeps its place relative to a triangle which moves from `from` to `to`. Not finite if the triangle
/// has no area.
glm::vec3 turn_with(const SurfacePoint& from, const SurfacePoint& to, const glm::vec3& direction) {
    const glm::mat3 own(from.edges[0], from.edges[1], from.geometric), moved(to.edges[0], to.edges[1], to.geometric);
    const glm::vec3 turned = moved * (glm::inverse(own) * direction);
    return turned / glm::length(turned);
}

}  // namespace

std::optional<SurfacePoint> carry_point(const ShadingScene& to, const Hit& hit, const SurfacePoint& from) {
    if (!to.instances[hit.instance].visible) return std::nullopt;
    SurfacePoint point = make_surface_point(to, hit, from.front);
    const bool turned = point.edges[0] != from.edges[0] || point.edges[1] != from.edges[1];
    const glm::vec3 normal = turned ? turn_with(from, point, from.normal) : from.normal;
    if (glm::dot(normal, point.geometric) > 0.0f) point.normal = normal;  // false for NaN
    return point;
}

}  // namespace aleph
