#include "engine/pose/plan.h"

#include "engine/pose/parts.h"
#include "engine/scene/visit.h"

namespace aleph {
namespace {

void plan_nodes(const Scene& scene, bool all, PosePlan& plan) {
    plan.moving.resize(scene.nodes.size(), 0);
    int camera = 0;
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const bool moves =
            all || (node.parent != no_index && plan.moving[node.parent] != 0) || has_animated_tracks(node);
        plan.moving[n] = moves;
        if (moves) plan.nodes.push_back(static_cast<int>(n));
        if (node.light != no_index) {
            plan.light_nodes.push_back(static_cast<int>(n));
            plan.lights = plan.lights || moves || has_animated_tracks(scene.lights[node.light]);
        }
        if (node.camera == no_index) continue;
        if (moves || has_animated_tracks(scene.cameras[node.camera])) plan.cameras.push_back(camera);
        ++camera;
    }
}

void plan_instances(const Scene& scene, PosePlan& plan) {
    std::vector<std::uint8_t> deforms(scene.meshes.size(), 0), changes(scene.meshes.size(), 0);
    for (const Deformer& deformer : plan.deformers) {
        deforms[deformer.mesh] = 1;
        if (deformer.changes) changes[deformer.mesh] = 1;
    }
    for (std::size_t m = 0; m < scene.meshes.size(); ++m)
        if (is_animated(scene.meshes[m].present)) changes[m] = 1;

    const std::vector<Instance> instances = list_instances(scene);
    std::vector<std::vector<int>> instances_of(scene.meshes.size());
    for (std::size_t i = 0; i < instances.size(); ++i) {
        const auto mesh = static_cast<std::size_t>(instances[i].mesh);
        if (plan.moving[instances[i].node] != 0 || changes[mesh] != 0) plan.instances.push_back(static_cast<int>(i));
        if (deforms[mesh] != 0) instances_of[mesh].push_back(static_cast<int>(i));
    }
    for (const Deformer& deformer : plan.deformers)
        plan.deformer_instances.push_back(std::move(instances_of[deformer.mesh]));
}

}  // namespace

PosePlan make_pose_plan(const Scene& scene, bool all) {
    PosePlan plan;
    plan_nodes(scene, all, plan);
    plan.deformers = find_deformers(scene, plan.moving);
    plan_instances(scene, plan);
    for (std::size_t i = 0; i < scene.materials.size(); ++i)
        if (all || has_animated_tracks(scene.materials[i])) plan.materials.push_back(static_cast<int>(i));
    plan.environment = all || has_animated_tracks(scene.environment);
    return plan;
}

void update_pose(const Scene& scene, const PosePlan& plan, double seconds, ScenePose& posed) {
    posed.seconds = seconds;
    for (const int node : plan.nodes) place_node(scene, node, seconds, posed);
    for (const int i : plan.instances) {
        const auto instance = static_cast<std::size_t>(i);
        posed.shown[instance] = is_shown(scene, posed, instance);
    }
    if (!plan.deformers.empty()) {
        std::vector<std::uint8_t> shown(plan.deformers.size(), 0);
        for (std::size_t d = 0; d < shown.size(); ++d)
            for (const int i : plan.deformer_instances[d]) shown[d] |= posed.shown[i];
        deform(scene, plan.deformers, shown, false, posed);
    }
    for (const int material : plan.materials) {
        const auto m = static_cast<std::size_t>(material);
        posed.materials[m] = pose_material(scene.materials[m], seconds);
    }
    if (plan.lights) {
        posed.lights.clear();
        for (const int node : plan.light_nodes) {
            const auto n = static_cast<std::size_t>(node);
            if (posed.visible[n] != 0) posed.lights.push_back(pose_light(scene, node, posed.world[n], seconds));
        }
    }
    for (const int camera : plan.cameras) {
        CameraValues& values = posed.cameras[camera];
        values = pose_camera(scene, values.node, posed.world[values.node], seconds);
    }
    if (plan.environment) pose_environment(scene.environment, seconds, posed);
}

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
