// Loops over lights that become vector instructions (CMakeLists.txt).

#include <algorithm>
#include <array>
#include <cmath>

#include "render/light/lights.h"

namespace aleph {

namespace {

constexpr float margin = 1e-3f;  // rounding must not exclude a light that brings a little

/// The cosine and sine of an angle from 0 to pi.
struct Angle {
    float cosine, sine;
};

inline float sine_of(float cosine) {
    const float square = 1.0f - cosine * cosine;
    return std::sqrt(square < 0.0f ? 0.0f : square);
}

/// a - b, and 0 where b is larger.
inline Angle subtract(const Angle& a, const Angle& b) {
    const float cosine = a.cosine * b.cosine + a.sine * b.sine, sine = a.sine * b.cosine - a.cosine * b.sine;
    const bool is_less = a.cosine >= b.cosine;
    return {is_less ? 1.0f : cosine, is_less ? 0.0f : sine};
}

inline float with_margin(float cosine) {
    const float enough = cosine < margin ? margin : cosine;
    const float most = enough > 1.0f ? 1.0f : enough;
    return cosine < -margin ? 0.0f : most;
}

/// bound_illuminances of one light. Without branches, so that a loop over lights becomes vector instructions.
inline float bound_illuminance(const LightBounds& lights, std::size_t i, const glm::vec3& position,
                               const glm::vec3& normal, float behind) {
    const float nearby = lights.nearby[i], radius = lights.radius[i], strength = lights.strength[i];
    const float inside = lights.inside[i], one_sided = lights.one_sided[i];
    const float x = lights.x[i] - nearby * position.x, y = lights.y[i] - nearby * position.y,
                z = lights.z[i] - nearby * position.z;
    const float distance2 = x * x + y * y + z * z;
    const float inverse = 1.0f / std::sqrt(distance2);
    // The cosine at the light's centre, and more by what its size may add.
    const auto widen = [radius, inverse](float along) {
        const float wide = (along + radius) * inverse;
        const float enough = wide < margin ? margin : wide;
        return enough > 1.0f ? 1.0f : enough;
    };
    const float facing = widen(x * normal.x + y * normal.y + z * normal.z);
    const float shining = widen(-(x * lights.axis_x[i] + y * lights.axis_y[i] + z * lights.axis_z[i]));
    const float share = (behind > 0.0f ? 1.0f : facing) * (one_sided > 0.0f ? shining : 1.0f);
    const float outside = strength * share * (inverse * inverse);
    return distance2 <= 1.01f * (radius * radius) ? inside : outside;
}

}  // namespace

void bound_illuminances(const LightBounds& lights, const Receiver& receiver, std::span<float> weights) {
    const glm::vec3 from = receiver.position, facing = receiver.normal;
    const float behind = receiver.behind ? 1.0f : 0.0f;  // as the values of the loop
    for (std::size_t first = 0; first < weights.size(); first += LightBounds::step) {
        // An array that nothing else overlaps: the loop becomes vector instructions.
        std::array<float, LightBounds::step> part;
        for (std::size_t i = 0; i < LightBounds::step; ++i) {
            part[i] = bound_illuminance(lights, first + i, from, facing, behind);
        }
        std::copy(part.begin(), part.end(), weights.begin() + static_cast<std::ptrdiff_t>(first));
    }
}

LightReaches reach_of(const LightGroup& group, const Receiver& receiver) {
    const glm::vec3 from = receiver.position, facing = receiver.normal;
    const float behind = receiver.behind ? 1.0f : 0.0f;
    LightReaches reaches;
    for (std::size_t i = 0; i < LightGroup::size; ++i) {
        const float near = group.nearby[i], radius = group.radius[i];
        const float x = group.center.x[i] - near * from.x, y = group.center.y[i] - near * from.y,
                    z = group.center.z[i] - near * from.z;
        const float distance2 = x * x + y * y + z * z, radius2 = radius * radius;
        const float distance = std::sqrt(distance2), inverse = 1.0f / distance;
        const float sine = radius * inverse > 1.0f ? 1.0f : radius * inverse;
        const Angle size{sine_of(sine), sine};  // of the sphere, as half an angle
        // The cosine at the surface, at the side of the sphere that faces it most.
        const float at_surface = (x * facing.x + y * facing.y + z * facing.z) * inverse;
        const float arriving = with_margin(subtract({at_surface, sine_of(at_surface)}, size).cosine);
        // And the cosine at the lights, of those that face the surface most.
        const float from_axis = -(x * group.axis.x[i] + y * group.axis.y[i] + z * group.axis.z[i]) * inverse;
        const Angle at_light = subtract({from_axis, sine_of(from_axis)}, size);
        const float outside = subtract(at_light, {group.cos_cone[i], group.sin_cone[i]}).cosine;
        const float falloff = group.by_cosine[i] > 0.0f ? with_margin(outside) : 1.0f;
        const float leaving = outside < group.cos_emission[i] - margin ? 0.0f : falloff;
        const float outside_share = (behind > 0.0f ? 1.0f : arriving) * (group.directed[i] > 0.0f ? leaving : 1.0f);
        const bool is_inside = distance2 <= 1.001f * radius2;
        const float share = is_inside ? 1.0f : outside_share;
        // A point light at the point has no direction to it.
        const float exists = distance2 + radius2 > 0.0f ? 1.0f : 1.0f - near;
        const float strength = group.strength[i] * share * exists;
        const float gap = distance > radius ? distance - radius : 0.0f;
        const float bound = strength / (gap * gap), most = group.most[i];
        const float near_bound = bound < most ? bound : most;
        const float near_estimate = strength / (distance2 > radius2 ? distance2 : radius2);
        const float any_bound = near > 0.0f ? near_bound : strength;
        const float any_estimate = near > 0.0f ? near_estimate : strength;
        reaches.bounds[i] = strength > 0.0f ? any_bound : 0.0f;
        reaches.estimates[i] = strength > 0.0f ? any_estimate : 0.0f;
    }
    return reaches;
}

}  // namespace aleph
