#include "engine/scene/transforms.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace aleph {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double smallest = std::numeric_limits<double>::min();  // below it precision is lost, or flushed to zero
constexpr double parallel_sine = 1e-9;                           // directions closer than this do not span a plane

bool all_finite(const glm::dvec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
bool all_finite(const glm::dmat3& m) {
    return all_finite(m[0]) && all_finite(m[1]) && all_finite(m[2]);
}

bool usable(double largest) {
    return largest >= smallest && std::isfinite(largest);
}

/// Divided by its largest element. A division each: the reciprocal of a tiny number would overflow.
glm::dmat3 scaled_to_one(const glm::dmat3& m, double largest) {
    return {m[0] / largest, m[1] / largest, m[2] / largest};
}

/// up x back at length 1; zero where they are parallel.
glm::dvec3 right_of(const glm::dvec3& up, const glm::dvec3& back) {
    const glm::dvec3 product = glm::cross(safe_normalize(up), back);
    if (!(glm::length(product) > parallel_sine)) return glm::dvec3(0.0);
    const glm::dvec3 right = safe_normalize(product);
    return safe_normalize(right - back * glm::dot(right, back));  // a short product leans a little
}

glm::dvec3 axis_least_along(const glm::dvec3& direction) {
    const glm::dvec3 size = glm::abs(direction);
    if (size.y <= size.x && size.y <= size.z) return {0.0, 1.0, 0.0};
    return size.z <= size.x ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(1.0, 0.0, 0.0);
}

}  // namespace

glm::dvec3 safe_normalize(const glm::dvec3& v) {
    if (!all_finite(v)) return glm::dvec3(0.0);
    const double largest = largest_element(v);
    if (!usable(largest)) return glm::dvec3(0.0);
    const glm::dvec3 scaled = v / largest;
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

glm::dquat safe_normalize(const glm::dquat& q) {
    if (std::abs(glm::dot(q, q) - 1.0) <= 4.0 * epsilon) return q;
    const double largest = std::max({std::abs(q.x), std::abs(q.y), std::abs(q.z), std::abs(q.w)});
    const bool finite = std::isfinite(q.x) && std::isfinite(q.y) && std::isfinite(q.z) && std::isfinite(q.w);
    if (!finite || !usable(largest)) return glm::dquat(1.0, 0.0, 0.0, 0.0);
    const glm::dquat scaled = q / largest;
    return scaled / std::sqrt(glm::dot(scaled, scaled));
}

double turn_between(const glm::dquat& a, const glm::dquat& b) {
    const glm::dquat nearer = glm::dot(a, b) < 0.0 ? -b : b;
    return 4.0 * std::atan2(glm::length(a - nearer), glm::length(a + nearer));
}

double orientation_sign(const glm::dmat4& world) {
    // Columns of length 1: the sign stays, and tiny or uneven scales cannot underflow.
    const glm::dvec3 x = safe_normalize(glm::dvec3(world[0]));
    const glm::dvec3 y = safe_normalize(glm::dvec3(world[1]));
    const glm::dvec3 z = safe_normalize(glm::dvec3(world[2]));
    return glm::dot(glm::cross(x, y), z) < 0.0 ? -1.0 : 1.0;
}

glm::dmat3 normal_matrix(const glm::dmat4& world) {
    const glm::dmat3 linear(world);
    const double largest = largest_element(linear);
    if (!all_finite(linear) || !usable(largest)) return glm::dmat3(0.0);
    const glm::dmat3 m = scaled_to_one(linear, largest);
    const glm::dmat3 cofactor(glm::cross(m[1], m[2]), glm::cross(m[2], m[0]), glm::cross(m[0], m[1]));
    const double scale = largest_element(cofactor);
    if (!usable(scale)) return glm::dmat3(0.0);
    return scaled_to_one(cofactor, scale) * orientation_sign(world);
}

SingularValues decompose_singular(const glm::dmat3& m) {
    SingularValues result;
    const double largest = largest_element(m);
    if (!usable(largest)) {
        result.u = glm::dmat3(0.0);
        result.sigma = glm::dvec3(0.0);
        return result;
    }

    // Columns are turned in pairs until all are at right angles; V accumulates the rotations. Three columns need few
    // sweeps.
    glm::dmat3 columns = scaled_to_one(m, largest);
    glm::dmat3& v = result.v;
    constexpr int pairs[3][2] = {{0, 1}, {0, 2}, {1, 2}};
    bool turned = true;
    for (int sweep = 0; turned && sweep < 60; ++sweep) {
        turned = false;
        for (const auto& [p, q] : pairs) {
            const double pp = glm::dot(columns[p], columns[p]);
            const double qq = glm::dot(columns[q], columns[q]);
            const double pq = glm::dot(columns[p], columns[q]);
            if (!(std::abs(pq) > 4.0 * epsilon * std::sqrt(pp) * std::sqrt(qq))) continue;
            const double zeta = (qq - pp) / (2.0 * pq);
            const double tangent = std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
            if (tangent == 0.0) continue;
            const double cosine = 1.0 / std::sqrt(1.0 + tangent * tangent);
            const double sine = cosine * tangent;
            for (glm::dmat3* target : {&columns, &v}) {
                const glm::dvec3 left = (*target)[p], right = (*target)[q];
                (*target)[p] = cosine * left - sine * right;
                (*target)[q] = sine * left + cosine * right;
            }
            turned = true;
        }
    }
    for (int i = 0; i < 3; ++i) {
        result.u[i] = safe_normalize(columns[i]);
        result.sigma[i] = glm::dot(result.u[i], columns[i]) * largest;
    }
    return result;
}

bool has_full_rank(const glm::dmat4& world) {
    const glm::dmat3 linear(world);
    if (!all_finite(linear)) return false;
    const glm::dvec3 sigma = decompose_singular(linear).sigma;
    return std::min({sigma.x, sigma.y, sigma.z}) > 1e-6 * largest_element(sigma);
}

glm::dmat3 orthonormal_axes(const glm::dmat4& world) {
    const glm::dmat3 m(world);
    if (!all_finite(m)) return glm::dmat3(1.0);
    glm::dvec3 back = safe_normalize(m[2]);
    if (back == glm::dvec3(0.0)) back = right_of(m[0], safe_normalize(m[1]));  // flattened along z: x cross y
    glm::dvec3 right = right_of(m[1], back);
    if (right == glm::dvec3(0.0)) right = right_of(glm::cross(back, safe_normalize(m[0])), back);
    if (right == glm::dvec3(0.0)) return glm::dmat3(1.0);
    return {right, safe_normalize(glm::cross(back, right)), back};
}

glm::dmat4 look_at(const glm::dvec3& eye, const glm::dvec3& target, const glm::dvec3& up) {
    glm::dvec3 back = safe_normalize(eye - target);
    if (back == glm::dvec3(0.0)) back = {0.0, 0.0, 1.0};
    glm::dvec3 right = right_of(up, back);
    if (right == glm::dvec3(0.0)) right = right_of(axis_least_along(back), back);
    glm::dmat4 world(1.0);
    world[0] = glm::dvec4(right, 0.0);
    world[1] = glm::dvec4(safe_normalize(glm::cross(back, right)), 0.0);
    world[2] = glm::dvec4(back, 0.0);
    world[3] = glm::dvec4(eye, 1.0);
    return world;
}

}  // namespace aleph
