#pragma once
// Lists the parts of a scene that can change with time, so that the cost of a frame follows what moves.

#include <cstdint>
#include <vector>

#include "engine/pose/deform.h"
#include "engine/pose/pose.h"

namespace aleph {

struct PosePlan {
    std::vector<std::uint8_t> moving;  ///< per node: its transform or visibility can change
    std::vector<int> nodes;            ///< the moving ones, parents first
    std::vector<int> instances;        ///< into list_instances: those that move, deform, come or go
    std::vector<Deformer> deformers;
    std::vector<std::vector<int>> deformer_instances;  ///< per deformer: the instances of its mesh
    std::vector<int> materials;                        ///< with animated values
    bool lights = false;                               ///< some light moves, comes, goes or changes
    std::vector<int> light_nodes;
    std::vector<int> cameras;  ///< into ScenePose::cameras
    bool environment = false;
};

/// @param all  lists every part, as if each could change
PosePlan make_pose_plan(const Scene& scene, bool all = false);

/// Takes a pose of the same scene, from pose() or an earlier update, to another time. The result has the bits of
/// pose(scene, seconds), but only what can change is computed.
void update_pose(const Scene& scene, const PosePlan& plan, double seconds, ScenePose& posed);

}  // namespace aleph
