#include "engine/pose/pose.h"

#include "engine/pose/plan.h"

namespace aleph {

ScenePose pose(const Scene& scene, double seconds) {
    ScenePose posed;
    posed.world.resize(scene.nodes.size());
    posed.visible.resize(scene.nodes.size());
    posed.instances = list_instances(scene);
    posed.shown.resize(posed.instances.size());
    posed.meshes.resize(scene.meshes.size());
    posed.materials.resize(scene.materials.size());
    for (int node = 0; node < std::ssize(scene.nodes); ++node) {
        if (scene.nodes[node].camera != no_index) posed.cameras.push_back({.node = node});
    }
    update_pose(scene, make_pose_plan(scene, true), seconds, posed);
    return posed;
}

}  // namespace aleph
