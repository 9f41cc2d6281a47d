// What can be told of a scene without a time: its instances, its range, its cameras, whether it moves.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/errors.h"
#include "engine/pose.h"

namespace aleph {
namespace {

/// Calls visit(track) for the tracks that place and show a node: those that pose() reads.
template <class Visit>
void visit_node_tracks(const Node& node, const Visit& visit) {
    visit(node.visible);
    if (node.matrix) {
        visit(*node.matrix);
        return;
    }
    visit(node.translation);
    visit(node.scale);
    if (node.axis_rotation)
        visit(node.axis_rotation->angle);
    else
        visit(node.rotation);
}

/// Tracks of what is neither a node nor a camera.
template <class Visit>
void visit_appearance_tracks(const Scene& scene, const Visit& visit) {
    for (const Material& m : scene.materials) {
        for (const auto* track : {&m.base_color, &m.emission, &m.specular_color}) visit(*track);
        for (const auto* track : {&m.alpha, &m.metallic, &m.roughness, &m.emission_strength, &m.specular, &m.ior})
            visit(*track);
    }
    for (const Light& light : scene.lights) {
        visit(light.color);
        visit(light.intensity);
    }
    if (scene.environment) visit(*scene.environment);
}

template <class Visit>
void visit_camera_tracks(const Scene& scene, const Visit& visit) {
    for (const Camera& camera : scene.cameras)
        for (const auto* track : {&camera.fov, &camera.half_height, &camera.aperture, &camera.focus_distance})
            visit(*track);
}

/// Nodes with a mesh or a light at or below them.
std::vector<bool> nodes_with_content(const Scene& scene) {
    std::vector<bool> content(scene.nodes.size(), false);
    for (std::size_t i = scene.nodes.size(); i-- > 0;) {
        const Node& node = scene.nodes[i];
        if (!node.meshes.empty() || node.light != no_index) content[i] = true;
        if (content[i] && node.parent != no_index) content[node.parent] = true;
    }
    return content;
}

}  // namespace

std::vector<Instance> list_instances(const Scene& scene) {
    std::vector<Instance> instances;
    for (std::size_t node = 0; node < scene.nodes.size(); ++node)
        for (const int mesh : scene.nodes[node].meshes) instances.push_back({static_cast<int>(node), mesh});
    return instances;
}

FrameRange frame_range(const Scene& scene) {
    if (scene.range) return *scene.range;
    double earliest = std::numeric_limits<double>::infinity(), latest = -earliest;
    const auto widen = [&](const auto& track) {
        if (track.key_count() <= 1) return;
        earliest = std::min(earliest, first_time(track));
        latest = std::max(latest, last_time(track));
    };
    for (const Node& node : scene.nodes) visit_node_tracks(node, widen);
    visit_appearance_tracks(scene, widen);
    visit_camera_tracks(scene, widen);
    if (!(earliest <= latest)) return {};

    // A key within rounding of a frame is on it: single-precision times are off by up to 6e-8 of themselves.
    const auto slack = [](double frame) { return 1e-6 + 1.2e-7 * std::abs(frame); };
    const double per_second = scene.frame_rate.per_second();
    const double limit = 9e15;  // whole numbers are exact in double up to here
    const double begin = std::clamp(earliest * per_second, -limit, limit);
    const double end = std::clamp(latest * per_second, -limit, limit);
    const auto first = static_cast<std::int64_t>(std::ceil(begin - slack(begin)));
    const auto last = static_cast<std::int64_t>(std::floor(end + slack(end)));
    return {first, std::max(first, last)};  // keys that all lie between two frames: the frame after them
}

int find_camera(const Scene& scene, const std::string& name) {
    const std::string& wanted = name.empty() ? scene.camera : name;
    std::vector<const Node*> holders;
    for (const Node& node : scene.nodes)
        if (node.camera != no_index) holders.push_back(&node);
    if (holders.empty()) throw InputError(scene.file, "camera", "the scene has no camera");
    if (wanted.empty()) return 0;

    const auto index_where = [&](const auto& is_it) {
        const auto found = std::ranges::find_if(holders, is_it);
        return found == holders.end() ? no_index : static_cast<int>(found - holders.begin());
    };
    const auto camera_name = [&](const Node* node) -> const std::string& { return scene.cameras[node->camera].name; };
    int index = index_where([&](const Node* node) { return node->name == wanted; });
    if (index == no_index) index = index_where([&](const Node* node) { return camera_name(node) == wanted; });
    if (index != no_index) return index;

    std::string known;
    for (const Node* node : holders) {
        const std::string& shown = node->name.empty() ? camera_name(node) : node->name;
        known += fmt::format("{}'{}'", known.empty() ? "" : ", ", printable(shown));
    }
    throw InputError(scene.file, "camera",
                     fmt::format("there is no camera '{}'; there is {}", printable(wanted), known));
}

bool is_world_animated(const Scene& scene) {
    bool animated = false;
    const auto look = [&](const auto& track) { animated = animated || is_animated(track); };
    const std::vector<bool> content = nodes_with_content(scene);
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (content[i]) visit_node_tracks(scene.nodes[i], look);
    visit_appearance_tracks(scene, look);
    return animated;
}

}  // namespace aleph
