#include "render/light/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace aleph {

namespace {

/// The part of v perpendicular to the unit vector n, unit.
glm::vec3 perpendicular(const glm::vec3& v, const glm::vec3& n) {
    const glm::vec3 p = v - n * glm::dot(v, n);
    const float length = glm::length(p);
    return length > 0.0f ? p / length : glm::vec3(0.0f);
}

}  // namespace

float solid_angle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const float la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    // The volume a (b x c), without cancellation for small triangles.
    const float numerator = std::abs(glm::dot(a, glm::cross(b - a, c - a)));
    if (!(numerator > 0.0f)) return 0.0f;
    const float denominator = la * lb * lc + glm::dot(a, b) * lc + glm::dot(a, c) * lb + glm::dot(b, c) * la;
    return 2.0f * std::atan2(numerator, denominator);
}

glm::vec3 sample_spherical_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, float solid_angle,
                                    const glm::vec2& u) {
    const glm::vec3 ua = glm::normalize(a), ub = glm::normalize(b), uc = glm::normalize(c);
    // The angle at a, between the planes of the arcs to b and to c.
    const glm::vec3 ab = glm::cross(ua, ub), ac = glm::cross(ua, uc);
    const float lengths = std::sqrt(glm::dot(ab, ab) * glm::dot(ac, ac));
    if (!(lengths > 0.0f)) return ub;
    const float cos_alpha = glm::dot(ab, ac) / lengths;
    const float sin_alpha = std::abs(glm::dot(ua, glm::cross(ub - ua, uc - ua))) / lengths;
    // Cuts off a part of the triangle with the share u.x of its area; the part's third corner is on the arc from a to
    // c.
    const float area = u.x * solid_angle;
    const float sin_area = std::sin(area), cos_area = std::cos(area);
    const float s = sin_area * cos_alpha - cos_area * sin_alpha, t = cos_area * cos_alpha + sin_area * sin_alpha;
    const float k1 = t - cos_alpha;
    const float k2 = s + sin_alpha * glm::dot(ua, ub);
    const float below = (k2 * s + k1 * t) * sin_alpha;
    const float q =
        below != 0.0f ? std::clamp(((k2 * t - k1 * s) * cos_alpha - k2) / below, -1.0f, 1.0f) : glm::dot(ua, uc);
    const glm::vec3 corner = ua * q + perpendicular(uc, ua) * std::sqrt(std::max(0.0f, 1.0f - q * q));
    const float z = 1.0f - u.y * (1.0f - glm::dot(corner, ub));
    return ub * z + perpendicular(corner, ub) * std::sqrt(std::max(0.0f, 1.0f - z * z));
}

}  // namespace aleph
