#pragma once
// Which instances share one tree: those that never move, deform, come or go. Rays then meet them without the transform
// and the tree of each instance.

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/pose/pose.h"

namespace aleph {

struct FlatPlan {
    std::vector<Instance> instances;  ///< list_instances(scene)
    std::vector<glm::dmat4> world;    ///< per node, object to world; of nodes that do not move
    std::vector<std::uint8_t> shown;  ///< per instance: it can be met at some time
    std::vector<std::uint8_t> flat;   ///< per instance: in the flat tree
    /// m, world: coordinates of the flat tree are relative to it. It depends on the scene alone, not on the camera.
    glm::dvec3 origin{0.0};
};

/// An instance stays outside the flat tree if rounding to single precision relative to `origin` could change its shape
/// or move the start of rays that leave it (fits() in flat_plan.cpp), or if its mesh has many instances, whose copies
/// would take too much memory: at most as many triangles are added as the scene has, and a quarter of a million.
/// @param flatten  false: no instance is flat
FlatPlan make_flat_plan(const Scene& scene, const PosePlan& plan, bool flatten = true);

}  // namespace aleph
