#pragma once
// Few nodes of the light tree that stand for all lights as seen from a surface point, and lights chosen among them.

#include "render/light/lights.h"

namespace aleph {

struct LightCut {
    static constexpr int few = 16;       ///< so many lights, without a tree of their own, are all in the cut
    static constexpr int capacity = 24;  ///< nodes
    const LightTree* tree = nullptr;
    int size = 0;
    bool has_all = false;                 ///< the nodes are all lights, and `nodes` is not set
    std::array<int, capacity> nodes;      ///< children of LightTree, in its order: neighbours are neighbours
    std::array<float, capacity> weights;  ///< about the illuminance that each brings, or what gloss shows of it
    std::array<float, capacity> ends;     ///< sum of the weights up to and including each
    float total = 0.0f;                   ///< of the weights; infinite or not a number if a weight is
};

/// Few lights and no tree: all of them. Else groups are divided, that of the largest bound first, until there are
/// enough nodes.
/// @param tree  of the lights; null: LightSet::tree
LightCut find_light_cut(const LightSet& lights, const Receiver& receiver, const LightTree* tree = nullptr);

/// A light chosen for a surface point.
struct LightPick {
    int light = no_index;  ///< no_index: none
    float probability = 0.0f;
    float rest = 0.0f;  ///< what the choice left of its number, uniform in [0,1): even numbers leave even ones
};

/// Chosen in proportion to what the nodes bring, and then the groups within them.
/// @param number  in [0,1)
LightPick pick_light(const LightCut& cut, const Receiver& receiver, float number);

}  // namespace aleph
