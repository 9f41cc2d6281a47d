#pragma once
// A scene beside what is read back from the .glb that it was written to.

#include <algorithm>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "engine/gltf/write/write.h"
#include "engine/load/load_scene.h"
#include "engine/pose/pose.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {

/// The files stay: tests/gltf_validator reads them.
inline const std::filesystem::path round_trip_folder = build_folder() / "round_trip";

/// Nodes in the order in which the writer's file lists them: depth first, with those as roots that leave their parent's
/// transform.
inline std::vector<int> depth_first(const Scene& scene) {
    std::vector<std::vector<int>> children(scene.nodes.size() + 1);  // the last: roots
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const bool leaves = std::ranges::any_of(node.inherits.values, [](double value) { return value == 0.0; });
        const bool is_root = node.parent == no_index || leaves;
        children[is_root ? scene.nodes.size() : static_cast<std::size_t>(node.parent)].push_back(static_cast<int>(n));
    }
    std::vector<int> order, open(children.back().rbegin(), children.back().rend());
    while (!open.empty()) {
        const int node = open.back();
        open.pop_back();
        order.push_back(node);
        open.insert(open.end(), children[node].rbegin(), children[node].rend());
    }
    return order;
}

/// Nodes of a file that stand for one of the scene: without those that the writer adds.
inline std::vector<int> own_nodes(const Scene& loaded) {
    std::vector<int> own;
    for (std::size_t n = 0; n < loaded.nodes.size(); ++n) {
        const std::string& name = loaded.nodes[n].name;
        if (!name.ends_with(".part") && !name.ends_with(".shear")) own.push_back(static_cast<int>(n));
    }
    return own;
}

struct Exported {
    Scene before, after;
    std::vector<std::string> losses;
    std::vector<int> nodes_before, nodes_after;  ///< pairs
    std::filesystem::path file;

    Exported(Scene scene, const std::string& name)
        : before(std::move(scene)), file(round_trip_folder / (name + ".glb")) {
        std::filesystem::create_directories(round_trip_folder);
        losses = write_gltf(before, file);
        after = load_scene(file);
        // A file without a camera gets one, which comes first.
        const bool has_camera = std::ranges::any_of(before.nodes, [](const Node& n) { return n.camera != no_index; });
        nodes_before = depth_first(before);
        nodes_after = own_nodes(after);
        if (!has_camera) nodes_after.erase(nodes_after.begin());
        EXPECT_EQ(nodes_before.size(), nodes_after.size());
    }

    /// The largest difference of world matrices at a time; positions relative to the size of the scene.
    /// @param size  m
    double world_difference(double seconds, double size) const {
        const ScenePose a = pose(before, seconds), b = pose(after, seconds);
        double largest = 0.0;
        for (std::size_t i = 0; i < std::min(nodes_before.size(), nodes_after.size()); ++i) {
            const glm::dmat4 difference = a.world[nodes_before[i]] - b.world[nodes_after[i]];
            largest = std::max(largest, glm::length(glm::dvec3(difference[3])) / size);
            for (int k = 0; k < 3; ++k) {
                const double length = std::max(glm::length(a.world[nodes_before[i]][k]), 1e-30);
                largest = std::max(largest, glm::length(difference[k]) / std::max(1.0, length));
            }
        }
        return largest;
    }
};

/// The diagonal of the box around all points of all nodes at a time, m; at least that of the cameras' distances.
inline double scene_size(const Scene& scene, double seconds) {
    const ScenePose posed = pose(scene, seconds);
    glm::dvec3 low(std::numeric_limits<double>::max()), high(-low);
    const auto add = [&](const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    };
    for (const Instance& instance : posed.instances)
        for (const glm::vec3& p : scene.meshes[instance.mesh].positions)
            add(glm::dvec3(posed.world[instance.node] * glm::dvec4(p, 1.0)));
    for (const CameraValues& camera : posed.cameras) add(camera.position);
    return low.x <= high.x ? std::max(glm::length(high - low), 1e-6) : 1.0;
}

}  // namespace aleph
