#include "render/light/sky_openings.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <limits>
#include <numbers>

#include "render/light/lights.h"

namespace aleph {

bool is_inside(const SkyOpenings& box, const glm::vec3& p) {
    for (int axis = 0; axis < 3; ++axis)
        if (!(p[axis] > box.low[axis] && p[axis] < box.high[axis])) return false;
    return true;
}

BoxExit leave_box(const SkyOpenings& box, const glm::vec3& origin, const glm::vec3& direction) {
    BoxExit exit;
    float nearest = std::numeric_limits<float>::infinity();
    for (int axis = 0; axis < 3; ++axis) {
        if (direction[axis] == 0.0f) continue;
        const bool upper = direction[axis] > 0.0f;
        const float t = ((upper ? box.high : box.low)[axis] - origin[axis]) / direction[axis];
        if (!(t < nearest)) continue;
        nearest = t;
        exit.side = 2 * axis + (upper ? 1 : 0);
    }
    exit.distance = nearest;
    const glm::vec3 at = origin + direction * nearest;
    const auto [a, b] = other_axes(exit.side / 2);
    exit.at = {at[a], at[b]};
    return exit;
}

namespace {

/// sr, of each half: smaller ones are sampled by area, as sample_spherical_triangle would be too coarse.
constexpr float least_solid_angle = 2e-3f;
constexpr float least_cosine = 0.05f;  // of an opening that hardly faces the surface
constexpr float least_open_share = 1.0f / 128.0f;

/// Returns whether an opening is sampled by area.
bool is_small(const SeenOpenings& seen, std::size_t i) {
    return !(std::min(seen.angles[i][0], seen.angles[i][1]) > least_solid_angle);
}

/// @param margin  m, around the opening
bool is_within(const SkyOpening& opening, const BoxExit& exit, const glm::vec2& margin) {
    return opening.side == exit.side && glm::all(glm::greaterThanEqual(exit.at, opening.low - margin)) &&
           glm::all(glm::lessThanEqual(exit.at, opening.high + margin));
}

/// Per steradian, of the samples of one opening.
/// @param at  where the direction meets it, from the receiver
float find_opening_density(const SkyOpening& opening, const SeenOpenings& seen, std::size_t i, const glm::vec3& at) {
    if (!is_small(seen, i)) return 1.0f / seen.angle(i);
    const glm::vec2 size = opening.high - opening.low;
    const float distance = glm::length(at), across = std::abs(at[opening.side / 2]);
    return distance * distance * distance / (across * size.x * size.y);
}

}  // namespace

float estimate_open_share(const SkyOpenings& all, const Receiver& receiver, const glm::vec3& direction) {
    if (!is_inside(all, receiver.position)) return 1.0f;
    if (direction != glm::vec3(0.0f)) {
        const BoxExit exit = leave_box(all, receiver.position, direction);
        const bool is_open = std::ranges::any_of(
            all.openings, [&](const SkyOpening& opening) { return is_within(opening, exit, glm::vec2(0.0f)); });
        return is_open ? 1.0f : least_open_share;
    }
    const float share = least_open_share + see_openings(all, receiver).total / std::numbers::pi_v<float>;
    return std::min(share, 1.0f);
}

SeenOpenings see_openings(const SkyOpenings& all, const Receiver& receiver) {
    if (receiver.seen != nullptr) return *receiver.seen;
    SeenOpenings seen;
    if (!is_inside(all, receiver.position)) return seen;
    for (std::size_t i = 0; i < all.openings.size(); ++i) {
        std::array<glm::vec3, 4> to = all.openings[i].corners;
        float cosine = least_cosine;
        for (glm::vec3& corner : to) {
            corner -= receiver.position;
            const float own = glm::dot(receiver.normal, corner) / glm::length(corner);
            cosine = std::max(cosine, receiver.behind ? std::abs(own) : own);
        }
        seen.angles[i] = {solid_angle(to[0], to[1], to[2]), solid_angle(to[0], to[2], to[3])};
        seen.weights[i] = seen.angle(i) * cosine;
        seen.total += seen.weights[i];
    }
    return seen;
}

glm::vec3 sample_openings(const SkyOpenings& all, const SeenOpenings& seen, const glm::vec3& from, glm::vec2 u) {
    std::size_t chosen = 0;
    float left = u.x * seen.total;
    for (std::size_t i = 0; i < all.openings.size(); ++i) {
        if (!(seen.weights[i] > 0.0f)) continue;
        chosen = i;
        if (left < seen.weights[i]) break;
        left -= seen.weights[i];
    }
    const std::array<float, 2>& halves = seen.angles[chosen];
    float place = std::min(left / seen.weights[chosen], 1.0f) * seen.angle(chosen);
    const bool second = place >= halves[0];
    if (second) place -= halves[0];
    u.x = std::clamp(place / halves[second ? 1 : 0], 0.0f, 0x1.fffffep-1f);
    const auto& corners = all.openings[chosen].corners;
    if (is_small(seen, chosen)) {
        const glm::vec3 along = corners[1] - corners[0], up = corners[3] - corners[0];
        const float share = std::min(left / seen.weights[chosen], 1.0f);
        return glm::normalize(corners[0] + along * share + up * u.y - from);
    }
    return sample_spherical_triangle(corners[0] - from, corners[second ? 2 : 1] - from, corners[second ? 3 : 2] - from,
                                     halves[second ? 1 : 0], u);
}

float pdf_openings(const SkyOpenings& all, const SeenOpenings& seen, const glm::vec3& from,
                   const glm::vec3& direction) {
    const BoxExit exit = leave_box(all, from, direction);
    const glm::vec2 rounding(1e-5f * glm::length(all.high - all.low));
    float density = 0.0f;
    for (std::size_t i = 0; i < all.openings.size(); ++i) {
        const SkyOpening& opening = all.openings[i];
        if (seen.weights[i] > 0.0f && is_within(opening, exit, rounding))
            density += seen.weights[i] / seen.total * find_opening_density(opening, seen, i, exit.distance * direction);
    }
    return density;
}

}  // namespace aleph
