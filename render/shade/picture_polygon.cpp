#include "render/shade/picture_polygon.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace aleph {

namespace {

constexpr double nearest = 1e-6;  // depth that counts, of the distance to a triangle's farthest corner

double cross(const glm::dvec2& a, const glm::dvec2& b) {
    return a.x * b.y - a.y * b.x;
}

/// Area of the triangle of corners 0, i and i + 1.
double fan_area(const PicturePolygon& polygon, int i) {
    const auto& corners = polygon.corners;
    return 0.5 * std::abs(cross(corners[i] - corners[0], corners[i + 1] - corners[0]));
}

/// The corners before a plane, and where sides cross it: visit(a, b, t) for the place a + t (b - a).
/// @param height  of a corner over the plane
template <class Height, class Visit>
void clip(int count, const Height& height, const Visit& visit) {
    for (int i = 0; i < count; ++i) {
        const int next = (i + 1) % count;
        const double here = height(i), there = height(next);
        if (here >= 0.0) visit(i, i, 0.0);
        if ((here >= 0.0) != (there >= 0.0)) visit(i, next, here / (here - there));
    }
}

/// Normals of an outline's sides, in the order of its corners.
constexpr std::array<glm::dvec2, 8> outwards{
    {{1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}, {-1.0, 1.0}, {-1.0, 0.0}, {-1.0, -1.0}, {0.0, -1.0}, {1.0, -1.0}}};

}  // namespace

PicturePolygon project_triangle(const CameraView& view, const std::array<glm::dvec3, 3>& corners) {
    std::array<glm::dvec3, 3> seen;
    std::ranges::transform(corners, seen.begin(), [&](const glm::dvec3& corner) { return to_camera(view, corner); });
    double reach = 0.0;
    for (const glm::dvec3& corner : seen) reach = std::max(reach, glm::length(corner));
    PicturePolygon polygon;
    clip(
        3, [&](int i) { return -seen[i].z - nearest * reach; },
        [&](int a, int b, double t) { polygon.add(project_camera_point(view, seen[a] + t * (seen[b] - seen[a]))); });
    return polygon;
}

PicturePolygon project_directions(const CameraView& view, const std::array<glm::dvec3, 4>& directions) {
    PicturePolygon polygon;
    for (const glm::dvec3& direction : directions) {
        const glm::dvec3 seen = direction * view.axes;
        if (!(-seen.z > nearest * glm::length(seen))) return {};
        polygon.add(project_camera_point(view, seen));
    }
    return polygon;
}

void PictureOutline::add(const PicturePolygon& polygon) {
    for (int i = 0; i < polygon.count; ++i) {
        for (std::size_t k = 0; k < outwards.size(); ++k)
            reach_[k] = std::max(reach_[k], glm::dot(outwards[k], polygon.corners[i]));
    }
}

PicturePolygon PictureOutline::polygon() const {
    PicturePolygon polygon;
    if (reach_[0] == none) return polygon;
    for (std::size_t k = 0; k < outwards.size(); ++k) {
        const std::size_t next = (k + 1) % outwards.size();
        // Of the two sides that meet there, one lies along an axis.
        polygon.add((reach_[k] * glm::dvec2(outwards[next].y, -outwards[next].x) +
                     reach_[next] * glm::dvec2(-outwards[k].y, outwards[k].x)) /
                    cross(outwards[k], outwards[next]));
    }
    return polygon;
}

PicturePolygon clip_to_rectangle(const PicturePolygon& polygon, const glm::dvec2& low, const glm::dvec2& high) {
    PicturePolygon left = polygon;
    for (int axis = 0; axis < 2; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            const PicturePolygon before = left;
            const double limit = side < 0.0 ? -low[axis] : high[axis];
            left.count = 0;
            clip(
                before.count, [&](int i) { return limit - side * before.corners[i][axis]; },
                [&](int a, int b, double t) {
                    left.add(before.corners[a] + t * (before.corners[b] - before.corners[a]));
                });
        }
    }
    return left;
}

double area_of(const PicturePolygon& polygon) {
    double sum = 0.0;
    for (int i = 1; i + 1 < polygon.count; ++i) sum += fan_area(polygon, i);
    return sum;
}

glm::dvec2 sample_polygon(const PicturePolygon& polygon, const glm::dvec2& u) {
    double left = u.x * area_of(polygon);
    int chosen = 1;
    for (; chosen + 2 < polygon.count && left >= fan_area(polygon, chosen); ++chosen) left -= fan_area(polygon, chosen);
    const double area = fan_area(polygon, chosen), share = area > 0.0 ? std::clamp(left / area, 0.0, 1.0) : 0.0;
    const auto& corners = polygon.corners;
    return corners[0] +
           std::sqrt(share) * (corners[chosen] - corners[0] + u.y * (corners[chosen + 1] - corners[chosen]));
}

}  // namespace aleph
