#include "engine/pose/pose.h"

#include "engine/pose/deform.h"
#include "engine/pose/parts.h"

namespace aleph {

ScenePose pose(const Scene& scene, double seconds) {
    ScenePose frame;
    frame.seconds = seconds;
    const std::size_t nodes = scene.nodes.size();
    frame.world.resize(nodes);
    frame.visible.resize(nodes);
    for (std::size_t n = 0; n < nodes; ++n) {
        place_node(scene, static_cast<int>(n), seconds, frame);
        if (scene.nodes[n].camera != no_index)
            frame.cameras.push_back(pose_camera(scene, static_cast<int>(n), frame.world[n], seconds));
        if (scene.nodes[n].light != no_index && frame.visible[n] != 0)
            frame.lights.push_back(pose_light(scene, static_cast<int>(n), frame.world[n], seconds));
    }
    frame.instances = list_instances(scene);
    frame.shown.resize(frame.instances.size());
    std::vector<std::uint8_t> shown_meshes(scene.meshes.size(), 0);
    for (std::size_t i = 0; i < frame.instances.size(); ++i) {
        frame.shown[i] = is_shown(scene, frame, i);
        if (frame.shown[i] != 0) shown_meshes[frame.instances[i].mesh] = 1;
    }
    frame.meshes.resize(scene.meshes.size());
    // Which joints move does not matter here: everything is filled.
    const std::vector<Deformer> deformers = find_deformers(scene, std::vector<std::uint8_t>(nodes, 1));
    std::vector<std::uint8_t> shown;
    for (const Deformer& deformer : deformers) shown.push_back(shown_meshes[deformer.mesh]);
    deform(scene, deformers, shown, frame.world, seconds, true, frame.meshes);
    frame.materials.reserve(scene.materials.size());
    for (const Material& material : scene.materials) frame.materials.push_back(pose_material(material, seconds));
    frame.environment = pose_environment(scene, seconds);
    return frame;
}

}  // namespace aleph
