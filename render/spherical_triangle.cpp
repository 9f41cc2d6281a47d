#include "render/spherical_triangle.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace aleph {

namespace {

/// Angle between two vectors of any length; accurate also if they are nearly parallel.
float angle_between(const glm::vec3& v, const glm::vec3& w) {
    return std::atan2(glm::length(glm::cross(v, w)), glm::dot(v, w));
}

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

glm::vec3 sample_spherical_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec2& u) {
    constexpr float pi = std::numbers::pi_v<float>;
    const glm::vec3 ua = glm::normalize(a), ub = glm::normalize(b), uc = glm::normalize(c);
    const glm::vec3 ab = glm::cross(ua, ub), bc = glm::cross(ub, uc), ca = glm::cross(uc, ua);
    const float alpha = angle_between(ab, -ca), beta = angle_between(bc, -ab), gamma = angle_between(ca, -bc);
    // Cuts off a part of the triangle with the share u.x of its area; the part's third corner is on the arc from a to
    // c.
    const float area = u.x * (alpha + beta + gamma - pi);
    const float sin_alpha = std::sin(alpha), cos_alpha = std::cos(alpha);
    const float s = std::sin(area - alpha), t = std::cos(area - alpha);
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
