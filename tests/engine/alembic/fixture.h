#pragma once
// Loads archives and drafts of archives, and finds elements of scenes and of the truth.

#include <algorithm>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "engine/load/load_scene.h"
#include "tests/support/files/alembic_draft.h"
#include "tests/support/files/alembic_truth.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/warnings.h"

namespace aleph {

inline Scene load(const std::string& name) {
    return load_scene(archive_path(name));
}

inline Scene load(const std::vector<DraftObject>& objects, std::vector<double> times = {0.0}) {
    const ScratchFolder folder;
    OgawaDraft draft;
    draft.times = std::move(times);
    return load_scene(write_draft(folder / "draft.abc", draft.finish(objects)));
}

inline std::string path_of(const Scene& scene, int node) {
    std::string path;
    for (int i = node; i != no_index; i = scene.nodes[i].parent) path = "/" + scene.nodes[i].name + path;
    return path;
}

/// The node at a path; no_index where there is none.
inline int find_node(const Scene& scene, const std::string& path) {
    for (std::size_t i = 0; i < scene.nodes.size(); ++i)
        if (path_of(scene, static_cast<int>(i)) == path) return static_cast<int>(i);
    return no_index;
}

inline const Node& node_named(const Scene& scene, const std::string& name) {
    return scene.nodes[find_named(scene.nodes, name)];
}

inline const Mesh& mesh_of(const Scene& scene, const std::string& node, std::size_t i = 0) {
    return scene.meshes[node_named(scene, node).meshes.at(i)];
}

inline const json& property_of(const json& object, const std::string& name) {
    for (const json& property : object["properties"][0]["properties"])
        if (property["name"] == name) return property;
    throw std::out_of_range("no property " + name);
}

inline glm::vec3 vec3_at(const json& values, std::size_t i) {
    return {values[3 * i].get<float>(), values[3 * i + 1].get<float>(), values[3 * i + 2].get<float>()};
}

inline glm::dvec3 triangle_normal(const std::vector<glm::vec3>& positions, const glm::uvec3& t) {
    const glm::dvec3 a = positions[t.x], b = positions[t.y], c = positions[t.z];
    return glm::cross(b - a, c - a);
}

}  // namespace aleph
