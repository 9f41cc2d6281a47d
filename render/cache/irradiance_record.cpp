#include "render/cache/irradiance_record.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/base/color.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

/// R_i over the distance to the nearest surface.
constexpr float radius_over_distance = 3.5f;

/// A record's gradient counts in full if its least radius is at most so many times the radius by distance.
constexpr float contact_radii = 4.0f;

/// The relative error of extrapolation that alpha allows, over alpha.
constexpr float allowed_error = 0.5f;

/// Standard deviations of both records' noise that a difference may have before it counts.
constexpr float ignored_noise = 2.0f;

glm::vec3 limit_gradient(const glm::vec3& gradient, float irradiance, float radius) {
    const float length = glm::length(gradient);
    if (!std::isfinite(length)) return glm::vec3(0.0f);
    return length * radius > irradiance ? gradient * (irradiance / (length * radius)) : gradient;
}

/// Length of the luminance's gradient, per m.
float steepness(const std::array<glm::vec3, 3>& gradient) {
    glm::vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        slope[axis] = luminance({gradient[0][axis], gradient[1][axis], gradient[2][axis]});
    }
    const float length = glm::length(slope);
    return std::isfinite(length) ? length : infinite;
}

}  // namespace

std::optional<IrradianceRecord> make_record(const glm::vec3& position, const glm::vec3& normal, float accuracy,
                                            const IrradianceSample& sample, const RadiusBounds& bounds) {
    if (!is_finite(sample.irradiance) || !is_finite(sample.rare)) return std::nullopt;
    IrradianceRecord record;
    record.position = position;
    record.normal = normal;
    record.irradiance = sample.irradiance;
    record.rare = sample.rare;
    record.accuracy = accuracy;
    record.min_radius = bounds.min;
    record.max_growth = 1.0f / (bounds.min_spread * bounds.min_spread);
    record.noise.error = std::min(sample.relative_error, 1.0f);  // infinite where there are too few rays to tell
    const float rare = luminance(sample.rare), all = luminance(sample.irradiance) + rare;
    const float rare_error = all > 0.0f ? rare / all : 0.0f;  // found by one ray, or by two or three
    record.noise.ray_variance =
        (record.noise.error * record.noise.error + rare_error * rare_error) * static_cast<float>(sample.rays);
    record.tangent = make_basis(normal).tangent;
    record.space = sample.space;
    float radius = radius_over_distance * sample.nearest_distance;
    const float value = luminance(sample.irradiance), slope = steepness(sample.gradients.translation);
    if (slope * radius * accuracy > value) radius = value / (slope * accuracy);
    record.radius = std::clamp(radius, bounds.min, std::max(bounds.min, bounds.max));
    // A surface much nearer than the least radius makes a gradient that says nothing of the light so far away.
    const float kept = std::min(1.0f, contact_radii * radius_over_distance * sample.nearest_distance / record.radius);
    for (int c = 0; c < 3; ++c) {
        record.gradients.translation[c] =
            kept * limit_gradient(sample.gradients.translation[c], record.irradiance[c], record.radius * accuracy);
        record.gradients.rotation[c] = limit_gradient(sample.gradients.rotation[c], record.irradiance[c], 1.0f);
    }
    return record;
}

float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    if (!(glm::dot(normal, record.normal) > 0.0f)) return infinite;
    const glm::vec3 offset = position - record.position;
    const float height = glm::dot(offset, normal + record.normal) * 0.5f;
    if (!(height >= -max_in_front * record.radius && height <= max_behind * record.radius)) return infinite;
    if (glm::dot(offset, record.normal) > most_headroom(record)) return infinite;
    const float distance2 = glm::dot(offset, offset);
    return std::max({std::sqrt(distance2) / record.radius, distance2 * record.growth,
                     glm::length(normal - record.normal) * inverse_root_two});
}

bool is_beyond_clearance(const IrradianceRecord& record, const glm::vec3& position) {
    const glm::vec3 offset = position - record.position;
    const float x = glm::dot(offset, record.tangent);
    const float y = glm::dot(offset, glm::cross(record.normal, record.tangent));
    const float clear = record.space.sectors[sector_of(x, y)];
    return x * x + y * y > clear * clear;
}

Rgb extrapolate(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 offset = position - record.position, turn = glm::cross(record.normal, normal);
    Rgb value = record.irradiance;
    for (int c = 0; c < 3; ++c) {
        value[c] += glm::dot(turn, record.gradients.rotation[c]) + glm::dot(offset, record.gradients.translation[c]);
        value[c] = std::clamp(value[c], 0.0f, 2.0f * record.irradiance[c]);
    }
    return value;
}

float measure_growth(const IrradianceRecord& a, const IrradianceRecord& b) {
    const glm::vec3 offset = b.position - a.position;
    const float distance2 = glm::dot(offset, offset);
    const float at_a = luminance(a.irradiance), at_b = luminance(b.irradiance), mean = 0.5f * (at_a + at_b);
    if (!(mean > 0.0f && distance2 > 0.0f)) return 0.0f;
    const float difference = std::max(std::abs(luminance(extrapolate(a, b.position, b.normal)) - at_b),
                                      std::abs(luminance(extrapolate(b, a.position, a.normal)) - at_a));
    const float found = difference / mean, noise = ignored_noise * combined_noise(a, b);
    return std::sqrt(std::max(0.0f, found * found - noise * noise)) / (allowed_error * distance2);
}

}  // namespace aleph
