#include "render/light_cut.h"

#include <algorithm>
#include <cmath>

#include "render/light_power.h"

namespace aleph {

namespace {

constexpr float below_one = 0x1.fffffep-1f;

/// A cut while it is refined.
struct Candidates {
    int size = 0;
    std::array<int, LightCut::capacity> nodes{};
    std::array<LightReach, LightCut::capacity> reaches{};

    void add(int node, const LightReach& reach) {
        if (reach.bound == 0.0f) return;  // not where it is not a number
        nodes[size] = node;
        reaches[size++] = reach;
    }
    void remove(int i) {
        --size;
        nodes[i] = nodes[size];
        reaches[i] = reaches[size];
    }
};

/// The group of the largest bound; none if all others are lights, or below the limit.
int find_brightest_group(const LightTree& tree, const Candidates& candidates, float limit) {
    int found = no_index;
    float largest = limit;
    for (int i = 0; i < candidates.size; ++i) {
        if (tree.is_light(candidates.nodes[i]) || !(candidates.reaches[i].bound > largest)) continue;
        largest = candidates.reaches[i].bound;
        found = i;
    }
    return found;
}

/// Removes the faintest while all that are removed bring less than the limit. @return what they bring
float leave_out(Candidates& candidates, float limit) {
    float sum = 0.0f;
    while (candidates.size > 0) {
        const auto begin = candidates.reaches.begin();
        const auto faintest = std::min_element(
            begin, begin + candidates.size, [](const LightReach& a, const LightReach& b) { return a.bound < b.bound; });
        if (!(sum + faintest->bound < limit)) break;
        sum += faintest->bound;
        candidates.remove(static_cast<int>(faintest - begin));
    }
    return sum;
}

/// Few lights without a limit: all, by vector instructions.
LightCut take_all_lights(const LightSet& lights, const Receiver& receiver, float behind) {
    LightCut cut;
    static_assert(LightCut::capacity % LightBounds::step == 0);
    std::array<float, LightCut::capacity> weights;
    bound_illuminances(lights.bounds, receiver.position, receiver.normal, behind,
                       {weights.data(), lights.bounds.strength.size()});
    for (int i = 0; i < lights.count(); ++i) {
        cut.nodes[i] = i;
        cut.weights[i] = weights[i];
        cut.total += weights[i];
    }
    cut.size = lights.count();
    return cut;
}

}  // namespace

LightCut find_light_cut(const LightSet& lights, const Receiver& receiver, float behind, const CutLimits& limits) {
    const LightTree& tree = lights.tree;
    const bool few = tree.lights <= LightCut::capacity;
    if (few && !(limits.left_out > 0.0f)) return take_all_lights(lights, receiver, behind);
    const auto reach = [&](int node) { return reach_of(tree.nodes[node], receiver.position, receiver.normal, behind); };
    Candidates candidates;
    if (few) {
        for (int i = 0; i < tree.lights; ++i) candidates.add(i, reach(i));
    } else {
        for (const int root : tree.roots) candidates.add(root, reach(root));
        while (candidates.size < std::min(limits.nodes, LightCut::capacity)) {
            const int group = find_brightest_group(tree, candidates, limits.divided);
            if (group == no_index) break;
            const LightNode& node = tree.nodes[candidates.nodes[group]];
            candidates.remove(group);
            candidates.add(node.first, reach(node.first));
            candidates.add(node.second, reach(node.second));
        }
    }
    LightCut cut;
    cut.left_out = leave_out(candidates, limits.left_out);
    cut.size = candidates.size;
    for (int i = 0; i < cut.size; ++i) {
        cut.nodes[i] = candidates.nodes[i];
        cut.weights[i] = candidates.reaches[i].estimate;
        cut.total += cut.weights[i];
    }
    return cut;
}

LightPick pick_light(const LightSet& lights, const LightCut& cut, const Receiver& receiver, float behind,
                     float number) {
    LightPick pick;
    if (!std::isfinite(cut.total) || !(cut.total > 0.0f)) return pick;
    const float place = number * cut.total;
    float below = 0.0f, sum = 0.0f;  // of the weights before the chosen one
    int chosen = 0;
    for (int i = 0; i < cut.size; ++i) {
        sum += cut.weights[i];
        const bool passed = sum <= place;
        chosen += passed ? 1 : 0;
        below = passed ? sum : below;
    }
    chosen = std::min(chosen, cut.size - 1);
    while (chosen > 0 && !(cut.weights[chosen] > 0.0f)) --chosen;  // rounding at the end
    pick.probability = cut.weights[chosen] / cut.total;
    pick.rest = std::clamp((place - below) / cut.weights[chosen], 0.0f, below_one);
    int node = cut.nodes[chosen];
    while (!lights.tree.is_light(node)) {
        const LightNode& group = lights.tree.nodes[node];
        const auto weigh = [&](int child) {
            return reach_of(lights.tree.nodes[child], receiver.position, receiver.normal, behind).estimate;
        };
        const float first = weigh(group.first), second = weigh(group.second);
        if (!(first + second > 0.0f)) return {};  // the group is wider than its parts: neither brings anything
        const float share = first / (first + second);
        const bool is_first = pick.rest < share;
        node = is_first ? group.first : group.second;
        pick.probability *= is_first ? share : 1.0f - share;
        pick.rest = is_first ? pick.rest / share : (pick.rest - share) / (1.0f - share);
        pick.rest = std::min(pick.rest, below_one);
    }
    pick.light = node;
    return pick;
}

}  // namespace aleph
