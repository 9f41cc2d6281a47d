#include "engine/load/camera_check.h"

#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/load/source_file.h"
#include "engine/pose/parts.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// Per node: it holds a camera, or one hangs below it.
std::vector<bool> find_nodes_with_cameras(const Scene& scene) {
    std::vector<bool> holds(scene.nodes.size(), false);
    for (std::size_t i = scene.nodes.size(); i-- > 0;) {
        if (scene.nodes[i].camera != no_index) holds[i] = true;
        if (holds[i] && scene.nodes[i].parent != no_index) holds[scene.nodes[i].parent] = true;
    }
    return holds;
}

}  // namespace

void check_camera_axes(const Scene& scene) {
    const std::vector<bool> holds = find_nodes_with_cameras(scene);
    std::vector<bool> has_axes(scene.nodes.size(), false);
    const FrameRange range = frame_range(scene);
    ScenePose posed;
    posed.world.resize(scene.nodes.size());
    posed.visible.resize(scene.nodes.size());
    for (const std::int64_t number : {range.first, range.first + (range.last - range.first) / 2, range.last}) {
        const double seconds = scene.film.frame_rate.seconds_of(number);
        for (int i = 0; i < std::ssize(scene.nodes); ++i) {
            if (!holds[i]) continue;
            place_node(scene, i, seconds, posed);
            if (normal_matrix(posed.world[i]) != glm::dmat3(0.0)) has_axes[i] = true;
        }
    }
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) {
        const Node& node = scene.nodes[i];
        if (node.camera == no_index || has_axes[i]) continue;
        throw InputError(source_file(scene, node.include), fmt::format("node \"{}\"", printable(node.name)),
                         "its camera looks in no direction: the node or one above it has a scale of 0");
    }
}

}  // namespace aleph
