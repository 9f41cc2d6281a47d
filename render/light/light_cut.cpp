#include "render/light/light_cut.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "render/surface/microfacets.h"
#include "render/surface/scatter.h"

namespace aleph {

namespace {

/// About how much of the light from a sphere gloss scatters to its viewer, over what it does of other light: the lobe
/// towards the centre, wider by the sphere's size.
/// @param offset  to the centre; 0: light from all around
float look_through_lobe(const LitSurface& lit, const glm::vec3& offset, float radius) {
    constexpr float least = 0.1f;  // lights beside a narrow lobe are told apart by their illuminance
    const float distance = glm::length(offset);
    const bool is_around = !(distance > radius);
    const float size = is_around ? 1.0f : radius / distance;
    const glm::vec3 sum = is_around ? glm::vec3(0.0f) : lit.view + lit.basis.to_local(offset / distance);
    const float length = glm::length(sum);
    const glm::vec3 half = length > 0.0f ? sum / length : glm::vec3(0.0f, 0.0f, 1.0f);
    const glm::vec2 widths = lit.material.widths();
    return least + ggx_d(glm::sqrt(widths * widths + 0.25f * size * size), half);
}

/// About how much of a light's sphere the receiver scatters, over what its illuminance tells.
/// @param center  m, of a light nearby; else the unit vector towards it, or 0
float find_seen_share(const Receiver& receiver, const glm::vec3& center, float radius, bool nearby) {
    float share = 1.0f;
    if (receiver.openings != nullptr && !nearby && (radius == 0.0f || center == glm::vec3(0.0f)))
        share = estimate_open_share(*receiver.openings, receiver, center);
    if (receiver.gloss != nullptr)
        share *= look_through_lobe(*receiver.gloss, nearby ? center - receiver.position : center, radius);
    return share;
}

/// Light that the nodes of a group bring, as the receiver scatters it.
LightReaches scattered_reach_of(const LightGroup& group, const Receiver& receiver) {
    LightReaches reaches = reach_of(group, receiver);
    if (receiver.gloss == nullptr && receiver.openings == nullptr) return reaches;
    for (int i = 0; i < group.used; ++i) {
        const glm::vec3 center(group.center.x[i], group.center.y[i], group.center.z[i]);
        const float seen = find_seen_share(receiver, center, group.radius[i], group.nearby[i] > 0.0f);
        reaches.bounds[i] *= seen;
        reaches.estimates[i] *= seen;
    }
    return reaches;
}

/// A cut while it is refined.
struct Candidates {
    int size = 0;
    std::array<int, LightCut::capacity> nodes;
    std::array<float, LightCut::capacity> bounds, estimates;

    /// Puts those of a group that bring anything in the place of one.
    void replace(int place, const LightGroup& group, const LightReaches& reaches) {
        std::array<int, LightGroup::size> brings;
        int added = 0;
        for (int i = 0; i < group.used; ++i) {
            brings[added] = i;
            added += reaches.bounds[i] == 0.0f ? 0 : 1;  // kept where it is not a number
        }
        const int after = size - place - 1;
        const auto make_room = [&](auto& values) {
            const auto begin = values.begin() + place + 1;
            if (added == 0) {
                std::copy(begin, begin + after, begin - 1);
            } else {
                std::copy_backward(begin, begin + after, begin + after + added - 1);
            }
        };
        make_room(nodes);
        make_room(bounds);
        make_room(estimates);
        for (int i = 0; i < added; ++i) {
            nodes[place + i] = group.children[brings[i]];
            bounds[place + i] = reaches.bounds[brings[i]];
            estimates[place + i] = reaches.estimates[brings[i]];
        }
        size += added - 1;
    }
};

/// The group of the largest bound; none if all nodes are lights.
int find_brightest_group(const LightTree& tree, const Candidates& candidates) {
    int found = no_index;
    float largest = 0.0f;
    for (int i = 0; i < candidates.size; ++i) {
        if (tree.is_light(candidates.nodes[i]) || !(candidates.bounds[i] > largest)) continue;
        largest = candidates.bounds[i];
        found = i;
    }
    return found;
}

Candidates find_candidates(const LightTree& tree, const Receiver& receiver) {
    Candidates candidates;
    const auto divide = [&](int place, const LightGroup& group) {
        candidates.replace(place, group, scattered_reach_of(group, receiver));
    };
    candidates.size = 1;
    divide(0, tree.groups.front());
    while (candidates.size + LightGroup::size - 1 <= LightCut::capacity) {
        const int brightest = find_brightest_group(tree, candidates);
        if (brightest == no_index) break;
        divide(brightest, tree.group(candidates.nodes[brightest]));
    }
    return candidates;
}

/// One of several by their weights. The number is stretched over it again, and the probability multiplied by its own.
/// @param ends  sums of the weights up to and including each
std::size_t choose(std::span<const float> weights, std::span<const float> ends, LightPick& pick) {
    const float total = ends.back(), place = pick.rest * total;
    int passed = 0;
    for (const float end : ends) passed += end <= place ? 1 : 0;
    auto chosen = std::min(static_cast<std::size_t>(passed), weights.size() - 1);
    while (chosen > 0 && !(weights[chosen] > 0.0f)) --chosen;  // rounding at the end
    const float below = chosen == 0 ? 0.0f : ends[chosen - 1];
    pick.rest = std::clamp((place - below) / weights[chosen], 0.0f, below_one);
    pick.probability *= weights[chosen] / total;
    return chosen;
}

/// Few lights: all, by vector instructions.
LightCut take_all_lights(const LightSet& lights, const Receiver& receiver) {
    LightCut cut;
    cut.size = lights.count();
    cut.has_all = true;
    static_assert(LightCut::few % LightBounds::step == 0 && LightCut::few <= LightCut::capacity);
    const LightBounds& bounds = lights.bounds;
    bound_illuminances(bounds, receiver, {cut.weights.data(), bounds.strength.size()});
    const bool by_share = (receiver.gloss != nullptr || receiver.openings != nullptr) && cut.size > 1;
    for (int i = 0; i < cut.size; ++i) {
        if (by_share) {
            const glm::vec3 center(bounds.x[i], bounds.y[i], bounds.z[i]);
            cut.weights[i] *= find_seen_share(receiver, center, bounds.radius[i], bounds.nearby[i] > 0.0f);
        }
        cut.ends[i] = cut.total += cut.weights[i];
    }
    return cut;
}

}  // namespace

LightCut find_light_cut(const LightSet& lights, const Receiver& receiver, const LightTree* tree) {
    LightCut cut;
    if (lights.count() == 0) return cut;
    if (tree == nullptr && lights.count() <= LightCut::few) return take_all_lights(lights, receiver);
    cut.tree = tree != nullptr ? tree : &lights.tree;
    const Candidates candidates = find_candidates(*cut.tree, receiver);
    for (int i = 0; i < candidates.size; ++i) {
        const float weight = candidates.estimates[i];
        cut.nodes[cut.size] = candidates.nodes[i];
        cut.weights[cut.size] = weight;
        cut.total += weight;
        cut.ends[cut.size] = cut.total;
        cut.size += weight == 0.0f ? 0 : 1;
    }
    return cut;
}

LightPick pick_light(const LightCut& cut, const Receiver& receiver, float number) {
    LightPick pick;
    if (!std::isfinite(cut.total) || !(cut.total > 0.0f)) return pick;
    pick.rest = number;
    pick.probability = 1.0f;
    const auto size = static_cast<std::size_t>(cut.size);
    const std::size_t chosen = choose({cut.weights.data(), size}, {cut.ends.data(), size}, pick);
    int node = cut.has_all ? static_cast<int>(chosen) : cut.nodes[chosen];
    while (!cut.has_all && !cut.tree->is_light(node)) {
        const LightGroup& group = cut.tree->group(node);
        const LightReaches reaches = scattered_reach_of(group, receiver);
        LightGroup::Values ends;
        float total = 0.0f;
        for (std::size_t i = 0; i < ends.size(); ++i) ends[i] = total += reaches.estimates[i];
        // A group is wider than its parts: it may be that none of them brings anything.
        if (!(total > 0.0f) || !std::isfinite(total)) return {};
        node = group.children[choose(reaches.estimates, ends, pick)];
    }
    pick.light = node;
    return pick;
}

}  // namespace aleph
