#include "render/irradiance_cache.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

namespace aleph {

namespace {

constexpr float smallest_error = 1e-3f;  // weight 1000 at and around the record (MODEL 6.1)
constexpr float infinite = std::numeric_limits<float>::infinity();
constexpr int deepest_level = 24;

/// A record goes into the cell whose half size is about its reach at a middling accuracy, so that cells hold records of
/// similar reach and a look-up visits few of them.
constexpr float reach_for_index = 0.3f;

glm::vec3 limit_gradient(const glm::vec3& gradient, float irradiance, float radius) {
    const float length = glm::length(gradient);
    if (!std::isfinite(length)) return glm::vec3(0.0f);
    return length * radius > irradiance ? gradient * (irradiance / (length * radius)) : gradient;
}

}  // namespace

IrradianceRecord make_record(const glm::vec3& position, const glm::vec3& normal, const IrradianceSample& sample,
                             const RadiusBounds& bounds) {
    IrradianceRecord record;
    record.position = position;
    record.normal = normal;
    record.irradiance = sample.irradiance;
    record.smallest_radius = bounds.smallest;
    record.radius =
        std::clamp(sample.harmonic_mean_distance, bounds.smallest, std::max(bounds.smallest, bounds.largest));
    record.tangent = make_basis(normal).tangent;
    record.clearance = sample.clearance;
    record.headroom = sample.headroom;
    for (std::size_t c = 0; c < 3; ++c) {
        const float irradiance = sample.irradiance[static_cast<int>(c)];
        record.translation_gradient[c] = limit_gradient(sample.translation_gradient[c], irradiance, record.radius);
        record.rotation_gradient[c] = limit_gradient(sample.rotation_gradient[c], irradiance, 1.0f);
    }
    return record;
}

float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal) {
    if (!(glm::dot(normal, record.normal) > 0.0f)) return infinite;
    const glm::vec3 offset = position - record.position;
    if (glm::dot(offset, normal + record.normal) * 0.5f < -0.05f * record.radius) return infinite;
    constexpr float rounding = 1e-3f;  // of the radius
    if (glm::dot(offset, record.normal) > record.headroom + rounding * record.radius) return infinite;
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
        const std::size_t channel = static_cast<std::size_t>(c);
        value[c] +=
            glm::dot(turn, record.rotation_gradient[channel]) + glm::dot(offset, record.translation_gradient[channel]);
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
    const bool inside = std::max({off.x, off.y, off.z}) <= cells_[0].half_size;  // else it stays in the root
    for (int level = 0; inside && level < deepest_level; ++level) {
        Cell& here = cells_[cell];
        here.largest_radius = std::max(here.largest_radius, radius);
        if (here.half_size * 0.5f < reach_for_index * radius) break;
        const std::size_t octant =
            static_cast<std::size_t>((position.x > here.center.x ? 1 : 0) | (position.y > here.center.y ? 2 : 0) |
                                     (position.z > here.center.z ? 4 : 0));
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
    found.largest_radius = std::max(found.largest_radius, radius);
    return cell;
}

/// Calls visit_record(index) for every record that may lie within reach_factor * its radius + extra_reach of the
/// position, until it returns false.
template <class VisitRecord, class VisitCell>
void IrradianceCache::visit(const glm::vec3& position, float reach_factor, float extra_reach,
                            const VisitRecord& visit_record, const VisitCell& visit_cell) const {
    int stack[deepest_level * 8 + 8];
    int top = 0;
    stack[top++] = 0;
    while (top > 0) {
        const Cell& cell = cells_[stack[--top]];
        visit_cell();
        for (int record = cell.first_record; record >= 0; record = next_[record]) {
            if (!visit_record(record)) return;
        }
        for (const int child : cell.children) {
            if (child < 0) continue;
            const Cell& below = cells_[child];
            const float reach = below.half_size + reach_factor * below.largest_radius + extra_reach;
            if (std::abs(position.x - below.center.x) <= reach && std::abs(position.y - below.center.y) <= reach &&
                std::abs(position.z - below.center.z) <= reach) {
                stack[top++] = child;
            }
        }
    }
}

template <class VisitRecord>
void IrradianceCache::visit(const glm::vec3& position, float reach_factor, float extra_reach,
                            const VisitRecord& visit_record) const {
    visit(position, reach_factor, extra_reach, visit_record, [] {});
}

std::size_t IrradianceCache::look_up_cost(const CacheQuery& query) const {
    std::size_t touched = 0;
    const auto count = [&] { ++touched; };
    visit(
        query.position, std::min(query.accuracy, 1.0f), 0.0f, [&](int) { return ++touched > 0; }, count);
    return touched;
}

float IrradianceCache::radius_bound(const glm::vec3& position, const glm::vec3& normal, float largest) const {
    float bound = largest;
    visit(position, 1.0f, largest, [&](int i) {
        const IrradianceRecord& other = records_[i];
        if (glm::dot(normal, other.normal) > 0.0f) {
            bound = std::min(bound, other.radius + glm::length(position - other.position));
        }
        return true;
    });
    return bound;
}

/// Two records' radii may differ by no more than their distance: whatever made the one short is that near to the
/// other (Krivanek et al. 2006, "Making Radiance and Irradiance Caching Practical", 4).
void IrradianceCache::clamp_to_neighbours(IrradianceRecord& record) {
    record.radius = radius_bound(record.position, record.normal, record.radius);
    record.radius = std::max(record.radius, record.smallest_radius);
    visit(record.position, 1.0f, 0.0f, [&](int i) {
        IrradianceRecord& other = records_[i];
        const float distance = glm::length(record.position - other.position);
        if (glm::dot(record.normal, other.normal) > 0.0f && other.radius > record.radius + distance) {
            other.radius = std::max(record.radius + distance, other.smallest_radius);
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
            const float weight = 1.0f / std::max(error, smallest_error);
            sum += extrapolate(record, query.position, query.normal) * weight;
            total += weight;
        }
        return true;
    });
    if (!(total > 0.0f)) return std::nullopt;
    return sum / total;
}

}  // namespace aleph
