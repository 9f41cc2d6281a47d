#include "render/surface/texture_footprint.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace aleph {

RayFootprint make_pixel_footprint(const CameraView& view, const SurfacePoint& point, const glm::vec3& direction,
                                  float distance, float spacing) {
    const glm::vec3 right(view.axes[0]), up(view.axes[1]), back(view.axes[2]);
    // On the plane one unit in front of the camera, neighbours differ by 1 / pixels_per_unit along an axis; at this
    // depth, by that times the depth. Moving the difference along the ray brings it into the tangent plane.
    const float depth = view.orthographic ? 1.0f : -distance * glm::dot(direction, back);
    const float size = depth * spacing / static_cast<float>(view.pixels_per_unit);
    const float cosine = -glm::dot(point.geometric, direction);
    constexpr float min_cosine = 1e-4f;  // at smaller ones the texture is already blurred to the mean
    const glm::vec3 slide = direction / std::max(cosine, min_cosine);
    return {size * (right + slide * glm::dot(point.geometric, right)),
            -size * (up + slide * glm::dot(point.geometric, up)), 0.0f, spacing == 1.0f};
}

RayFootprint make_cone_footprint(const SurfacePoint& point, const glm::vec3& direction, float distance,
                                 float solid_angle) {
    const float cosine = -glm::dot(point.geometric, direction);
    return {{}, {}, std::sqrt(cone_footprint_area(cosine, distance, solid_angle))};
}

float cone_footprint_area(float cosine, float distance, float solid_angle) {
    constexpr float min_cosine = 0.05f;  // the texture of a cone need not be sharp
    return distance * distance * solid_angle / std::max(cosine, min_cosine);
}

UvFootprint make_uv_footprint(const SurfacePoint& point, const RayFootprint& footprint, int uv_set) {
    const glm::vec3 &e1 = point.edges[0], &e2 = point.edges[1];
    const glm::vec2 &uv1 = point.uv_edges[uv_set][0], &uv2 = point.uv_edges[uv_set][1];
    if (footprint.width > 0.0f) {
        const float area = glm::length(glm::cross(e1, e2));
        const float scale = footprint.width * std::sqrt(std::abs(uv1.x * uv2.y - uv1.y * uv2.x) / area);
        return {{scale, 0.0f}, {0.0f, scale}, true};
    }
    if (footprint.dx == glm::vec3(0.0f) && footprint.dy == glm::vec3(0.0f)) return {};
    // Coordinates along the edges, by the edges' dual vectors in the triangle's plane. The sign of point.geometric
    // cancels.
    const glm::vec3 across1 = glm::cross(e2, point.geometric), across2 = glm::cross(point.geometric, e1);
    const float scale1 = 1.0f / glm::dot(e1, across1), scale2 = 1.0f / glm::dot(e2, across2);
    const auto to_uv = [&](const glm::vec3& d) {
        return uv1 * (glm::dot(d, across1) * scale1) + uv2 * (glm::dot(d, across2) * scale2);
    };
    return {to_uv(footprint.dx), to_uv(footprint.dy), false};
}

}  // namespace aleph
