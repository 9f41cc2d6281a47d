#include "engine/pose/pose.h"

#include "engine/pose/deform.h"
#include "engine/pose/parts.h"

namespace aleph {

ScenePose pose(const Scene& scene, double seconds) {
    ScenePose posed;
    posed.seconds = seconds;
    const std::size_t nodes = scene.nodes.size();
    posed.world.resize(nodes);
    posed.visible.resize(nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        place_node(scene, static_cast<int>(n), seconds, posed);
        if (scene.nodes[n].camera != no_index)
            posed.cameras.push_back(pose_camera(scene, static_cast<int>(n), posed.world[n], seconds));
        if (scene.nodes[n].light != no_index && posed.visible[n] != 0)
            posed.lights.push_back(pose_light(scene, static_cast<int>(n), posed.world[n], seconds));
    }
    posed.instances = list_instances(scene);
    posed.shown.resize(posed.instances.size());
    std::vector<std::uint8_t> shown_meshes(scene.meshes.size(), 0);
    for (std::size_t i = 0; i < posed.instances.size(); ++i) {
        posed.shown[i] = is_shown(scene, posed, i);
        if (posed.shown[i] != 0) shown_meshes[posed.instances[i].mesh] = 1;
    }
    posed.meshes.resize(scene.meshes.size());
    // Every mesh is filled here, so it does not matter which joints move.
    const std::vector<Deformer> deformers = find_deformers(scene, std::vector<std::uint8_t>(nodes, 1));
    std::vector<std::uint8_t> shown;
    for (const Deformer& deformer : deformers) shown.push_back(shown_meshes[deformer.mesh]);
    deform(scene, deformers, shown, true, posed);
    posed.materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) posed.materials.push_back(pose_material(material, seconds));
    pose_environment(scene.environment, seconds, posed);
    return posed;
}

}  // namespace aleph
