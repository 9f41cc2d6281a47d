#include "scenes/studies/radius_rules.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "render/settings/numbers.h"

namespace aleph {

namespace {

/// A point in the tangent plane's axes, normal along z, and the light that arrives from it.
struct SeenSample {
    glm::dvec3 place{0.0};
    double distance = 0.0, radiance = 0.0;
    bool known = false;  ///< a ray was cast
};

struct LitTriangle {
    glm::dvec3 corners[3];
    double radiance = 0.0;
};

std::vector<SeenSample> list_samples(const HemisphereStrata& strata, const glm::vec3& normal,
                                     const GatherScratch& scratch, double nearest, double farthest) {
    const Basis basis = make_basis(normal);
    std::vector<SeenSample> samples(static_cast<std::size_t>(strata.count()));
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const auto cell = static_cast<std::size_t>(scratch.places[i].cell);
        const double distance = std::clamp(static_cast<double>(scratch.distances[cell]), nearest, farthest);
        samples[cell] = {glm::normalize(glm::dvec3(basis.to_local(scratch.rays[i].direction))) * distance, distance,
                         luminance(scratch.radiance[cell]), true};
    }
    return samples;
}

void add_triangle(const SeenSample& a, const SeenSample& b, const SeenSample& c, std::vector<LitTriangle>& out) {
    if (!a.known || !b.known || !c.known) return;
    const SeenSample* farthest = &a;
    for (const SeenSample* other : {&b, &c}) {
        if (other->distance > farthest->distance) farthest = other;
    }
    if (farthest->radiance > 0.0) out.push_back({{a.place, b.place, c.place}, farthest->radiance});
}

/// Two triangles between four neighbouring cells, and a fan about the normal. Seen from the point they run clockwise.
std::vector<LitTriangle> join_samples(const HemisphereStrata& strata, const std::vector<SeenSample>& samples) {
    std::vector<LitTriangle> triangles;
    const auto at = [&](int row, int column) -> const SeenSample& {
        return samples[static_cast<std::size_t>(strata.cell(row, column % strata.columns))];
    };
    for (int k = 1; k + 1 < strata.columns; ++k) add_triangle(at(0, 0), at(0, k), at(0, k + 1), triangles);
    for (int j = 0; j + 1 < strata.rows; ++j) {
        for (int k = 0; k < strata.columns; ++k) {
            add_triangle(at(j, k), at(j + 1, k), at(j + 1, k + 1), triangles);
            add_triangle(at(j, k), at(j + 1, k + 1), at(j, k + 1), triangles);
        }
    }
    return triangles;
}

/// Lambert's formula for a polygon that lies above the horizon. From a place in the tangent plane.
double sum_irradiance(const std::vector<LitTriangle>& triangles, const glm::dvec2& place) {
    const glm::dvec3 from(place, 0.0);
    double sum = 0.0;
    for (const LitTriangle& triangle : triangles) {
        double turned = 0.0;
        for (int i = 0; i < 3; ++i) {
            const glm::dvec3 a = triangle.corners[i] - from, b = triangle.corners[(i + 1) % 3] - from;
            const glm::dvec3 across = glm::cross(a, b);
            const double length = glm::length(across);
            if (length > 0.0) turned += across.z / length * std::atan2(length, glm::dot(a, b));
        }
        sum += 0.5 * triangle.radiance * turned;
    }
    return sum;
}

/// Of the luminance, per m.
double steepness(const std::array<glm::vec3, 3>& gradient) {
    glm::vec3 slope;
    for (int axis = 0; axis < 3; ++axis) {
        slope[axis] = luminance({gradient[0][axis], gradient[1][axis], gradient[2][axis]});
    }
    return glm::length(slope);
}

bool is_finite(const std::array<glm::vec3, 3>& gradient) {
    return std::ranges::all_of(gradient, [](const glm::vec3& g) { return std::isfinite(g.x + g.y + g.z); });
}

/// R_i, m, over which the error grows to 1 (to alpha, for the rules that have it).
double rule_radius(const IrradianceSample& sample, const RuleInput& input) {
    switch (input.rule) {
        case RadiusRule::split_sphere:
            return input.accuracy * sample.harmonic_mean_distance;
        case RadiusRule::nearest_clamped:
            return input.accuracy * sample.nearest_distance;
        case RadiusRule::hessian:
            break;
    }
    return hessian_radius(input.hessian, luminance(sample.irradiance), input.accuracy * input.area);
}

}  // namespace

HessianEigenvalues find_hessian(const HemisphereStrata& strata, const glm::vec3& normal, const GatherScratch& scratch,
                                double nearest, double farthest) {
    const auto triangles = join_samples(strata, list_samples(strata, normal, scratch, nearest, farthest));
    constexpr double step_share = 1e-2;  // of the nearest distance: an error of about its square
    const double step = step_share * nearest;
    const auto at = [&](double x, double y) { return sum_irradiance(triangles, {x * step, y * step}); };
    const double middle = at(0, 0), scale = 1.0 / (step * step);
    const double xx = (at(1, 0) - 2.0 * middle + at(-1, 0)) * scale;
    const double yy = (at(0, 1) - 2.0 * middle + at(0, -1)) * scale;
    const double xy = 0.25 * (at(1, 1) - at(1, -1) - at(-1, 1) + at(-1, -1)) * scale;
    const double mean = 0.5 * (xx + yy), apart = std::hypot(0.5 * (xx - yy), xy);
    return {mean + apart, mean - apart};
}

double hessian_radius(const HessianEigenvalues& hessian, double irradiance, double bound) {
    return std::pow(4.0 * bound * irradiance / (std::numbers::pi * hessian.sum()), 0.25);
}

std::optional<RuledRecord> make_ruled_record(const glm::vec3& position, const glm::vec3& normal,
                                             const IrradianceSample& sample, const RuleInput& input) {
    if (!is_finite(sample.irradiance)) return std::nullopt;
    RuledRecord record;
    record.value.position = position;
    record.value.normal = normal;
    record.value.irradiance = sample.irradiance;
    if (is_finite(sample.translation_gradient)) record.value.translation_gradient = sample.translation_gradient;
    if (is_finite(sample.rotation_gradient)) record.value.rotation_gradient = sample.rotation_gradient;
    double reach = rule_radius(sample, input);
    const double slope = steepness(record.value.translation_gradient), value = luminance(sample.irradiance);
    if (slope * reach > value) reach = value / slope;
    if (std::isnan(reach)) reach = input.most;  // neither light nor its change
    record.least = input.least;
    record.reach = static_cast<float>(std::clamp<double>(reach, input.least, std::max(input.least, input.most)));
    record.turn = input.rule == RadiusRule::hessian ? hessian_turn : input.accuracy;
    return record;
}

float ruled_error(RadiusRule rule, const RuledRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 offset = position - record.value.position;
    const float distance = glm::length(offset), cosine = glm::dot(normal, record.value.normal);
    if (!(cosine > 0.0f)) return infinite;
    constexpr float rounding = 0.01f;  // of the reach
    if (glm::dot(offset, normal + record.value.normal) * 0.5f < -rounding * record.reach) return infinite;
    const float moved = distance / record.reach;
    const float turned = std::sqrt(std::max(0.0f, 1.0f - cosine)) / record.turn;
    return rule == RadiusRule::nearest_clamped ? std::max(moved, turned) : moved + turned;
}

}  // namespace aleph
