#include "render/light/light_tree.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <span>

namespace aleph {

namespace {

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

/// A binary tree, from which groups are made.
struct PairTree {
    struct Pair {
        LightNode node;
        int light = -1;               ///< -1: a pair
        int first = -1, second = -1;  ///< of pairs
        int lights = 1;
    };
    std::vector<Pair> pairs;

    /// Adds all of these lights: halves along the longest side of the box around their centres. @return the highest
    int add(const std::vector<LightNode>& nodes, std::span<int> lights) {
        if (lights.size() == 1) {
            pairs.push_back({nodes[lights.front()], lights.front()});
            return static_cast<int>(pairs.size()) - 1;
        }
        glm::vec3 low = nodes[lights.front()].center, high = low;
        for (const int i : lights) {
            low = glm::min(low, nodes[i].center);
            high = glm::max(high, nodes[i].center);
        }
        const glm::vec3 size = high - low;
        const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
        const std::size_t half = lights.size() / 2;
        std::nth_element(lights.begin(), lights.begin() + static_cast<std::ptrdiff_t>(half), lights.end(),
                         [&](int a, int b) {
                             const float x = nodes[a].center[axis], y = nodes[b].center[axis];
                             return x < y || (x == y && a < b);
                         });
        const int first = add(nodes, lights.first(half)), second = add(nodes, lights.subspan(half));
        pairs.push_back({join(pairs[first].node, pairs[second].node), -1, first, second,
                         pairs[first].lights + pairs[second].lights});
        return static_cast<int>(pairs.size()) - 1;
    }
};

void set_node(LightGroup& group, std::size_t i, const LightNode& node) {
    group.center.set(i, node.center);
    group.radius[i] = node.radius;
    group.nearby[i] = node.nearby ? 1.0f : 0.0f;
    group.directed[i] = node.directed ? 1.0f : 0.0f;
    group.axis.set(i, node.axis);
    group.cos_cone[i] = node.cos_cone;
    group.sin_cone[i] = std::sqrt(std::max(0.0f, 1.0f - node.cos_cone * node.cos_cone));
    group.cos_emission[i] = node.cos_emission;
    group.by_cosine[i] = node.by_cosine ? 1.0f : 0.0f;
    group.strength[i] = node.strength;
    group.most[i] = node.most;
}

/// Adds a group of these pairs, in their order, and the groups below them. @return the group's index
int add_group(LightTree& tree, const PairTree& pairs, std::vector<int> members) {
    while (members.size() < LightGroup::size) {
        const auto largest = std::max_element(members.begin(), members.end(), [&](int a, int b) {
            return pairs.pairs[a].lights < pairs.pairs[b].lights;
        });
        const PairTree::Pair& pair = pairs.pairs[*largest];
        if (pair.lights == 1) break;
        *largest = pair.first;
        members.insert(largest + 1, pair.second);
    }
    const std::size_t index = tree.groups.size();
    tree.groups.emplace_back();
    tree.groups[index].used = static_cast<int>(members.size());
    for (std::size_t i = 0; i < members.size(); ++i) {
        const PairTree::Pair& pair = pairs.pairs[members[i]];
        set_node(tree.groups[index], i, pair.node);
        const int child =
            pair.light >= 0 ? pair.light : tree.lights + add_group(tree, pairs, {pair.first, pair.second});
        tree.groups[index].children[i] = child;
    }
    return static_cast<int>(index);
}

}  // namespace

LightTree make_light_tree(const std::vector<LightNode>& lights) {
    LightTree tree;
    tree.lights = static_cast<int>(lights.size());
    if (lights.empty()) return tree;
    std::vector<int> order(lights.size());
    std::iota(order.begin(), order.end(), 0);
    // Near lights, directional ones, and the environment, which comes from all around, are not joined.
    const auto kind_of = [&](int i) { return lights[i].nearby ? 0 : lights[i].radius == 0.0f ? 1 : 2; };
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return kind_of(a) < kind_of(b); });
    PairTree pairs;
    std::vector<int> roots;
    for (auto begin = order.begin(); begin != order.end();) {
        const auto end = std::find_if(begin, order.end(), [&](int i) { return kind_of(i) != kind_of(*begin); });
        roots.push_back(pairs.add(lights, {begin, end}));
        begin = end;
    }
    add_group(tree, pairs, std::move(roots));
    return tree;
}

}  // namespace aleph
