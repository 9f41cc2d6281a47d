// Points of surfaces, from hits of rays.

#include <algorithm>
#include <cmath>

#include "render/surface/shading_scene.h"

namespace aleph {

namespace {

/// In units of rounding_bound: 16 half-ulps. Random triangles meet themselves with offsets of 2 half-ulps, and none of
/// them with 4.
constexpr float offset_scale = 0x1p-20f;

/// By how much rounding moves a point of a triangle along its normal, there and in the object's space or that of the
/// flat tree, where Embree tests the triangle, in units of the relative rounding: the sum of the terms' sizes,
/// component by component (as in Pharr, Jakob and Humphreys 2023, "Physically Based Rendering", 6.8). What lies in the
/// plane of the triangle hardly counts, so that a wide floor has an offset about as small as a narrow one's. It counts
/// a little, because a plane through the origin has no rounding, and yet a ray that starts in it would meet it.
/// @param p0, e1, e2  object space: a corner and the edges from it
float rounding_bound(const PosedInstance& instance, const glm::vec3& p0, const glm::vec3& e1, const glm::vec3& e2,
                     const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 own = abs_of(instance.linear) * glm::max(glm::abs(p0), glm::max(glm::abs(e1), glm::abs(e2)));
    glm::vec3 place = glm::max(glm::abs(instance.translation), glm::abs(position));
    if (instance.flat) place = glm::max(place, glm::abs(position - instance.flat_origin));
    const glm::vec3 placed = instance.rounding * place;
    return glm::dot(glm::abs(normal), own + placed) + 0x1p-8f * std::max({own.x, own.y, own.z});
}

template <class T>
T interpolate(const std::vector<T>& values, const glm::uvec3& t, float u, float v) {
    return values[t.x] * (1.0f - u - v) + values[t.y] * u + values[t.z] * v;
}

/// The triangle that a hit is on.
struct HitTriangle {
    const PosedInstance& instance;
    glm::uvec3 t;  ///< its vertices
    /// Barycentrics, within the triangle: rounding can place a hit slightly outside.
    float u, v;
    glm::vec3 p0, e1, e2;  ///< object space, m: a corner and the edges from it
};

HitTriangle find_triangle(const ShadingScene& shading, const Hit& hit) {
    const PosedInstance& instance = shading.instances[hit.instance];
    const glm::uvec3 t = instance.mesh->triangles[hit.primitive];
    float u = std::max(hit.u, 0.0f), v = std::max(hit.v, 0.0f);
    if (const float sum = u + v; sum > 1.0f) {
        u /= sum;
        v /= sum;
    }
    const glm::vec3 p0 = instance.corner(t.x);
    return {instance, t, u, v, p0, instance.corner(t.y) - p0, instance.corner(t.z) - p0};
}

constexpr float near_edge = 1e-3f;  // barycentric: only points this close to an edge are looked at

/// Moves a point off the edges of its triangle, by more than rounding. Where two walls meet in an edge, a point exactly
/// on it would lie in both, and see nothing but the other wall at distance 0.
void move_off_edges(const HitTriangle& triangle, SurfacePlace& place) {
    if (std::min({triangle.u, triangle.v, 1.0f - triangle.u - triangle.v}) >= near_edge) return;
    constexpr float most = 0.125f;  // of a triangle too thin to have points so far from its edges
    const PosedInstance& instance = triangle.instance;
    const glm::vec3 e1 = instance.linear * triangle.e1, e2 = instance.linear * triangle.e2;
    const float area2 = glm::length(glm::cross(e1, e2));
    if (!(area2 > 0.0f)) return;
    const glm::vec3 coordinates = glm::abs(place.position);
    const float distance = place.offset + offset_scale * std::max({coordinates.x, coordinates.y, coordinates.z});
    const glm::vec3 sides(glm::length(e2 - e1), glm::length(e2), glm::length(e1));
    const glm::vec3 weights(1.0f - triangle.u - triangle.v, triangle.u, triangle.v);
    glm::vec3 moved = glm::max(weights, glm::min(sides * (distance / area2), most));
    if (moved == weights) return;
    moved /= moved.x + moved.y + moved.z;
    place.position =
        instance.linear * (triangle.p0 + triangle.e1 * moved.y + triangle.e2 * moved.z) + instance.translation;
}

/// The side of a surface that is seen: the one that a ray meets, or one that is known.
struct SeenSide {
    const glm::vec3* direction = nullptr;  ///< of the ray; null: none
    bool front = true;                     ///< without a ray

    bool is_front(const glm::vec3& normal) const { return direction ? glm::dot(normal, *direction) < 0.0f : front; }
    /// Unit normal of a triangle without area.
    glm::vec3 fallback() const {
        return direction ? -*direction / glm::length(*direction) : glm::vec3(0.0f, 1.0f, 0.0f);
    }
};

void set_place(const HitTriangle& triangle, const SeenSide& side, SurfacePlace& place) {
    const auto& [instance, t, u, v, p0, e1, e2] = triangle;
    place.position = instance.linear * (p0 + e1 * u + e2 * v) + instance.translation;
    // normal_matrix keeps outward normals outward, under reflections too.
    glm::vec3 geometric = instance.normals * glm::cross(e1, e2);
    const float length = glm::length(geometric);
    geometric = length > 0.0f ? geometric / length : side.fallback();
    place.front = side.is_front(geometric);
    place.geometric = place.front ? geometric : -geometric;
    place.offset = offset_scale * rounding_bound(instance, p0, e1, e2, place.position, geometric);
    place.normal = place.geometric;
    const std::vector<glm::vec3>& normals = instance.vertex_normals();
    if (normals.empty()) return;
    const glm::vec3 n = instance.normals * interpolate(normals, t, u, v);
    const float n_length = glm::length(n);
    if (!(n_length > 0.0f && std::isfinite(n_length))) return;
    const glm::vec3 shading_normal = (place.front ? n : -n) / n_length;
    // With an interpolated normal on the other side of the surface, light would leak through it.
    if (glm::dot(shading_normal, place.geometric) > 0.0f) place.normal = shading_normal;
}

void add_texture_coordinates(const HitTriangle& triangle, SurfacePoint& point) {
    const auto& [instance, t, u, v, p0, e1, e2] = triangle;
    point.edges[0] = instance.linear * e1;
    point.edges[1] = instance.linear * e2;
    for (int k = 0; k < 2; ++k) {
        const std::vector<glm::vec2>& uv = instance.mesh->uv[k];
        if (uv.empty()) continue;
        point.uv[k] = interpolate(uv, t, u, v);
        point.uv_edges[k][0] = uv[t.y] - uv[t.x];
        point.uv_edges[k][1] = uv[t.z] - uv[t.x];
    }
}

SurfacePoint make_point(const ShadingScene& shading, const Hit& hit, const SeenSide& side) {
    const HitTriangle triangle = find_triangle(shading, hit);
    const PosedInstance& instance = triangle.instance;
    SurfacePoint point;
    point.material = instance.material;
    set_place(triangle, side, point);
    move_off_edges(triangle, point);
    add_texture_coordinates(triangle, point);
    if (!instance.mesh->colors.empty()) {
        point.color = interpolate(instance.mesh->colors, triangle.t, triangle.u, triangle.v);
    }
    return point;
}

/// A direction that keeps its place relative to a triangle which moves from `from` to `to`. Not finite if the triangle
/// has no area.
glm::vec3 turn_with(const SurfacePoint& from, const SurfacePoint& to, const glm::vec3& direction) {
    const glm::mat3 own(from.edges[0], from.edges[1], from.geometric), moved(to.edges[0], to.edges[1], to.geometric);
    const glm::vec3 turned = moved * (glm::inverse(own) * direction);
    return turned / glm::length(turned);
}

}  // namespace

SurfacePoint make_surface_point(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    return make_point(shading, hit, {&direction});
}

SurfacePlace make_surface_place(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction) {
    SurfacePlace place;
    set_place(find_triangle(shading, hit), {&direction}, place);
    return place;
}

std::optional<SurfacePoint> carry_point(const ShadingScene& to, const Hit& hit, const SurfacePoint& from) {
    if (!to.instances[hit.instance].visible) return std::nullopt;
    SurfacePoint point = make_point(to, hit, {nullptr, from.front});
    const bool turned = point.edges[0] != from.edges[0] || point.edges[1] != from.edges[1];
    const glm::vec3 normal = turned ? turn_with(from, point, from.normal) : from.normal;
    if (glm::dot(normal, point.geometric) > 0.0f) point.normal = normal;  // false for NaN
    return point;
}

}  // namespace aleph
