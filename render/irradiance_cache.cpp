#include "render/irradiance_cache.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace aleph {

namespace {

constexpr float min_error = 1e-3f;  // keeps the weight finite at the record itself: at most 1000
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr int max_level = 24;  // of the octree

/// A record reaches alpha R_i. It goes into the cell whose half size is about its reach at alpha = 0.3, so that a cell
/// holds records of similar reach and a look-up visits few cells.
constexpr float reach_for_index = 0.3f;

/// Ward (1988) rejects every record in front of the point's tangent plane. This share of R_i is tolerated, so that
/// rounding, and shading normals that differ from the facets they lie on, do not reject a record's own surface.
constexpr float max_in_front = 0.05f;

/// Tolerance of the headroom, as a share of R_i, for rounding.
constexpr float headroom_tolerance = 1e-3f;

glm::vec3 limit_gradient(const glm::vec3& gradient, float irradiance, float radius) {
    const float length = glm::length(gradient);
    if (!std::isfinite(length)) return glm::vec3(0.0f);
    return length * radius > irradiance ? gradient * (irradiance / (length * radius)) : gradient;
}

}  // namespace

std::optional<IrradianceRecord> make_record(const glm::vec3& position, const glm::vec3& normal,
                                            const IrradianceSample& sample, const RadiusBounds& bounds) {
    if (!is_finite(sample.irradiance)) return std::nullopt;
    IrradianceRecord record;
    record.position = position;
    record.normal = normal;
    record.irradiance = sample.irradiance;
    record.min_radius = bounds.min;
    record.radius = std::clamp(sample.harmonic_mean_distance, bounds.min, std::max(bounds.min, bounds.max));
    record.tangent = make_basis(normal).tangent;
    record.clearance = sample.clearance;
    record.headroom = sample.headroom;
    for (int c = 0; c < 3; ++c) {
        const float irradiance = sample.irradiance[c];
        record.translation_gradient[c] = limit_gradient(sample.translation_gradient[c], irradiance, record.radius);
        record.rotation_gradient[c] = limit_gradient(sample.rotation_gradient[c], irradiance, 1.0f);
    }
    return record;
}

float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    if (!(glm::dot(normal, record.normal) > 0.0f)) return infinite;
    const glm::vec3 offset = position - record.position;
    if (glm::dot(offset, normal + record.normal) * 0.5f < -max_in_front * record.radius) return infinite;
    if (glm::dot(offset, record.normal) > record.headroom + headroom_tolerance * record.radius) return infinite;
    const float x = glm::dot(offset, record.tangent);
    const float y = glm::dot(offset, glm::cross(record.normal, record.tangent));
    const float clear = record.clearance[sector_of(x, y)];
    if (x * x + y * y > clear * clear) return infinite;
    constexpr float inverse_root_two = 0.70710678f;
    return glm::length(offset) / record.radius + glm::length(normal - record.normal) * inverse_root_two;
}

Rgb extrapolate(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    const glm::vec3 offset = position - record.position, turn = glm::cross(record.normal, normal);
    Rgb value = record.irradiance;
    for (int c = 0; c < 3; ++c) {
        value[c] += glm::dot(turn, record.rotation_gradient[c]) + glm::dot(offset, record.translation_gradient[c]);
        value[c] = std::clamp(value[c], 0.0f, 2.0f * record.irradiance[c]);
    }
    return value;
}

IrradianceCache::IrradianceCache(const glm::vec3& bounds_low, const glm::vec3& bounds_high) {
    const glm::vec3 size = bounds_high - bounds_low;
    Cell root;
    root.center = 0.5f * (bounds_low + bounds_high);
    root.half_size = std::max({0.5f * size.x, 0.5f * size.y, 0.5f * size.z, 1e-6f});
    root.children.fill(-1);
    cells_.push_back(root);
}

int IrradianceCache::find_or_add_cell(const glm::vec3& position, float radius) {
    int cell = 0;
    const glm::vec3 off = glm::abs(position - cells_[0].center);
    const bool inside = std::max({off.x, off.y, off.z}) <= cells_[0].half_size;  // otherwise it stays in the root
    for (int level = 0; inside && level < max_level; ++level) {
        Cell& here = cells_[cell];
        here.max_radius = std::max(here.max_radius, radius);
        if (here.half_size * 0.5f < reach_for_index * radius) break;
        const int octant = (position.x > here.center.x ? 1 : 0) | (position.y > here.center.y ? 2 : 0) |
                           (position.z > here.center.z ? 4 : 0);
        int child = here.children[octant];
        if (child < 0) {
            Cell added;
            added.half_size = 0.5f * here.half_size;
            added.center = here.center +
                           added.half_size * glm::vec3(octant & 1 ? 1 : -1, octant & 2 ? 1 : -1, octant & 4 ? 1 : -1);
            added.children.fill(-1);
            child = static_cast<int>(cells_.size());
            here.children[octant] = child;
            cells_.push_back(added);
        }
        cell = child;
    }
    Cell& found = cells_[cell];
    found.max_radius = std::max(found.max_radius, radius);
    return cell;
}

/// Calls visit_record(index) for every record that may lie within reach_factor * its radius + extra_reach of the
/// position, until it returns false.
template <class VisitRecord>
void IrradianceCache::visit(const glm::vec3& position, float reach_factor, float extra_reach,
                            const VisitRecord& visit_record) const {
    int stack[max_level * 8 + 8];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Cell& cell = cells_[stack[--top]];
        for (int record = cell.first_record; record >= 0; record = next_[record]) {
            if (!visit_record(record)) return;
        }
        for (const int child : cell.children) {
            if (child < 0) continue;
            const Cell& below = cells_[child];
            const float reach = below.half_size + reach_factor * below.max_radius + extra_reach;
            if (std::abs(position.x - below.center.x) <= reach && std::abs(position.y - below.center.y) <= reach &&
                std::abs(position.z - below.center.z) <= reach) {
                stack[top++] = child;
            }
        }
    }
}

float IrradianceCache::radius_bound(const glm::vec3& position, const glm::vec3& normal, float max_radius) const {
    float bound = max_radius;
    visit(position, 1.0f, max_radius, [&](int i) {
        const IrradianceRecord& other = records_[i];
        if (glm::dot(normal, other.normal) > 0.0f) {
            bound = std::min(bound, other.radius + glm::length(position - other.position));
        }
        return true;
    });
    return bound;
}

/// Krivanek et al. 2006, section 4: the radii of two records differ by no more than their distance.
void IrradianceCache::clamp_to_neighbours(IrradianceRecord& record) {
    record.radius = radius_bound(record.position, record.normal, record.radius);
    record.radius = std::max(record.radius, record.min_radius);
    visit(record.position, 1.0f, 0.0f, [&](int i) {
        IrradianceRecord& other = records_[i];
        const float distance = glm::length(record.position - other.position);
        if (glm::dot(record.normal, other.normal) > 0.0f && other.radius > record.radius + distance) {
            other.radius = std::max(record.radius + distance, other.min_radius);
        }
        return true;
    });
}

void IrradianceCache::insert(IrradianceRecord record) {
    clamp_to_neighbours(record);
    const int cell = find_or_add_cell(record.position, record.radius);
    next_.push_back(cells_[cell].first_record);
    cells_[cell].first_record = static_cast<int>(records_.size());
    records_.push_back(record);
}

bool IrradianceCache::covers(const CacheQuery& query) const {
    const float accuracy = std::min(query.accuracy, 1.0f);
    bool found = false;
    visit(query.position, accuracy, 0.0f, [&](int i) {
        found = interpolation_error(records_[i], query.position, query.normal) < accuracy;
        return !found;
    });
    return found;
}

std::optional<Rgb> IrradianceCache::interpolate(const CacheQuery& query) const {
    const float accuracy = std::min(query.accuracy, 1.0f);
    Rgb sum(0.0f);
    float total = 0.0f;
    visit(query.position, accuracy, 0.0f, [&](int i) {
        const IrradianceRecord& record = records_[i];
        const float error = interpolation_error(record, query.position, query.normal);
        if (error < accuracy) {
            const float weight = 1.0f / std::max(error, min_error);
            sum += extrapolate(record, query.position, query.normal) * weight;
            total += weight;
        }
        return true;
    });
    if (!(total > 0.0f)) return std::nullopt;
    return sum / total;
}

}  // namespace aleph
