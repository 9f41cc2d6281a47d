#include "engine/rays/mesh_bounds.h"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace aleph {

void BoundingBox::add(const glm::vec3& point) {
    low = glm::min(low, point);
    high = glm::max(high, point);
}

glm::vec3 BoundingBox::corner(int k) const {
    return {(k & 1) != 0 ? high.x : low.x, (k & 2) != 0 ? high.y : low.y, (k & 4) != 0 ? high.z : low.z};
}

MeshBounds find_bounds(std::span<const glm::vec3> points, std::span<const glm::uvec3> triangles) {
    MeshBounds bounds;
    double area = 0.0;
    for (const glm::uvec3& t : triangles)
        area += 0.5 * glm::length(glm::dvec3(glm::cross(points[t.y] - points[t.x], points[t.z] - points[t.x])));
    bounds.area = static_cast<float>(area);
    for (const glm::vec3& point : points) bounds.box.add(point);
    if (bounds.box.empty()) return bounds;
    bounds.sphere.center = bounds.box.center();
    for (const glm::vec3& point : points)
        bounds.sphere.radius = std::max(bounds.sphere.radius, glm::distance(point, bounds.sphere.center));
    return bounds;
}

}  // namespace aleph
