#include "render/light_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>

namespace aleph {

namespace {

/// The cosine and sine of an angle from 0 to pi.
struct Angle {
    float cosine = 1.0f, sine = 0.0f;
};

Angle angle_of(float cosine) {
    const float c = std::clamp(cosine, -1.0f, 1.0f);
    return {c, std::sqrt(1.0f - c * c)};
}

/// a - b, and 0 where b is larger.
Angle subtract(const Angle& a, const Angle& b) {
    if (a.cosine >= b.cosine) return {};
    return {a.cosine * b.cosine + a.sine * b.sine, a.sine * b.cosine - a.cosine * b.sine};
}

/// Rounding must not exclude a light that brings a little.
float with_margin(float cosine) {
    constexpr float margin = 1e-3f;
    return cosine < -margin ? 0.0f : std::clamp(cosine, margin, 1.0f);
}

/// The largest share of its light along the axes that a node sends to a point.
float shining_towards(const LightNode& node, const Angle& from_axis, const Angle& size) {
    const Angle outside = subtract(subtract(from_axis, size), angle_of(node.cos_cone));
    if (outside.cosine < node.cos_emission - 1e-3f) return 0.0f;
    return node.by_cosine ? with_margin(outside.cosine) : 1.0f;
}

/// A cone around two; without an axis: all directions.
void join_cones(LightNode& joined, const LightNode& a, const LightNode& b) {
    if (!a.directed || !b.directed) return;
    constexpr float widest = 3.1f, margin = 1e-3f;
    const float between = std::acos(std::clamp(glm::dot(a.axis, b.axis), -1.0f, 1.0f));
    const LightNode& wide = a.cos_cone <= b.cos_cone ? a : b;
    const float cone_a = std::acos(a.cos_cone), cone_b = std::acos(b.cos_cone);
    float cone = std::max(cone_a, cone_b);
    joined.axis = wide.axis;
    if (between + std::min(cone_a, cone_b) > cone) {
        const glm::vec3 middle = a.axis + b.axis;
        const float length = glm::length(middle);
        cone += 0.5f * between;
        if (!(length > 0.0f) || cone > widest) return;
        joined.axis = middle / length;
    }
    joined.directed = true;
    joined.cos_cone = std::cos(cone + margin);
}

LightNode join(const LightNode& a, const LightNode& b) {
    LightNode joined;
    const glm::vec3 between = b.center - a.center;
    const float distance = glm::length(between);
    if (distance + b.radius <= a.radius) {
        joined.center = a.center;
        joined.radius = a.radius;
    } else if (distance + a.radius <= b.radius) {
        joined.center = b.center;
        joined.radius = b.radius;
    } else {
        joined.radius = 0.5f * (distance + a.radius + b.radius);
        joined.center = a.center + between * ((joined.radius - a.radius) / distance);
    }
    joined.radius *= 1.0f + 1e-6f;
    joined.nearby = a.nearby;
    join_cones(joined, a, b);
    joined.cos_emission = std::min(a.cos_emission, b.cos_emission);
    joined.by_cosine = a.by_cosine && b.by_cosine;
    joined.strength = a.strength + b.strength;
    joined.most = a.most + b.most;
    return joined;
}

/// Adds the groups above these lights. @return the highest
int add_groups(LightTree& tree, std::span<int> lights) {
    if (lights.size() == 1) return lights.front();
    glm::vec3 low = tree.nodes[lights.front()].center, high = low;
    for (const int i : lights) {
        low = glm::min(low, tree.nodes[i].center);
        high = glm::max(high, tree.nodes[i].center);
    }
    const glm::vec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const std::size_t half = lights.size() / 2;
    std::nth_element(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(half), lights.end(),
                     [&](int a, int b) {
                         const float x = tree.nodes[a].center[axis], y = tree.nodes[b].center[axis];
                         return x < y || (x == y && a < b);
                     });
    const int first = add_groups(tree, lights.first(half)), second = add_groups(tree, lights.subspan(half));
    LightNode joined = join(tree.nodes[first], tree.nodes[second]);
    joined.first = first;
    joined.second = second;
    tree.nodes.push_back(joined);
    return static_cast<int>(tree.nodes.size()) - 1;
}

}  // namespace

LightReach reach_of(const LightNode& node, const glm::vec3& position, const glm::vec3& normal, float behind) {
    const glm::vec3 away = node.nearby ? node.center - position : node.center;
    const float distance2 = glm::dot(away, away), radius2 = node.radius * node.radius;
    if (node.nearby && !(distance2 + radius2 > 0.0f)) return {};  // a point light at the point has no direction to it
    float share = 1.0f;
    if (distance2 > 1.001f * radius2) {
        const float inverse = 1.0f / std::sqrt(distance2);
        const float sine = node.nearby ? node.radius * inverse : 0.0f;
        const Angle size{std::sqrt(1.0f - sine * sine), sine};
        if (!(behind > 0.0f)) {
            share = node.nearby ? with_margin(subtract(angle_of(glm::dot(away, normal) * inverse), size).cosine)
                                : with_margin(std::min(1.0f, glm::dot(away, normal) + node.radius));
        }
        if (node.directed) share *= shining_towards(node, angle_of(-glm::dot(away, node.axis) * inverse), size);
    }
    if (!(share > 0.0f)) return {};
    if (!node.nearby) return {node.strength * share, node.strength * share};
    const float nearest = std::max(0.0f, std::sqrt(distance2) - node.radius);
    return {std::min(node.strength / (nearest * nearest) * share, node.most),
            node.strength / std::max(distance2, radius2) * share};
}

LightTree make_light_tree(std::vector<LightNode> lights) {
    LightTree tree;
    tree.lights = static_cast<int>(lights.size());
    tree.nodes = std::move(lights);
    tree.nodes.reserve(2 * tree.nodes.size());
    std::vector<int> order(static_cast<std::size_t>(tree.lights));
    std::iota(order.begin(), order.end(), 0);
    const auto far = std::stable_partition(order.begin(), order.end(), [&](int i) { return tree.nodes[i].nearby; });
    // The environment comes from all around.
    const auto around = std::stable_partition(far, order.end(), [&](int i) { return tree.nodes[i].radius == 0.0f; });
    const std::span all(order);
    const auto near_count = static_cast<std::size_t>(far - order.begin());
    const auto far_count = static_cast<std::size_t>(around - far);
    if (near_count > 0) tree.roots.push_back(add_groups(tree, all.first(near_count)));
    if (far_count > 0) tree.roots.push_back(add_groups(tree, all.subspan(near_count, far_count)));
    tree.roots.insert(tree.roots.end(), around, order.end());
    return tree;
}

}  // namespace aleph
