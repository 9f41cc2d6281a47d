#include "engine/gltf/gltf.h"

#include <fmt/format.h>

#include <utility>

#include "engine/gltf/reader.h"
#include "engine/scene/append.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// A node whose matrix or scale has no larger number shrinks metres to less than an atom.
constexpr double min_scale = 1e-12;

/// True if the node's own transform is constant and shrinks everything to a point.
bool shrinks_to_point(const Node& node) {
    const LocalTransform& local = node.transform;
    if (local.matrix)
        return !is_animated(*local.matrix) && largest_element(glm::dmat3(key_value(*local.matrix, 0))) < min_scale;
    return !is_animated(local.scale) && largest_element(key_value(local.scale, 0)) < min_scale;
}

/// Per scene node: a mesh that follows the node's transform hangs on it or below it. Skinned meshes follow joints.
std::vector<bool> find_nodes_with_meshes(const Scene& part) {
    std::vector<bool> holds(part.nodes.size(), false);
    for (std::size_t i = part.nodes.size(); i-- > 0;) {
        const Node& node = part.nodes[i];
        for (const int mesh : node.meshes) holds[i] = holds[i] || part.meshes[mesh].deformation.skin == no_index;
        if (holds[i] && node.parent != no_index) holds[node.parent] = true;
    }
    return holds;
}

/// Warns of a scene without a mesh, and of nodes that always shrink their meshes to a point.
void warn_of_invisible_meshes(GltfReader& reader) {
    const tinygltf::Model& model = reader.source.model;
    bool has_mesh = false;
    std::size_t count = 0;
    std::string first;
    const std::vector<bool> holds = find_nodes_with_meshes(reader.part);
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
        const int index = reader.node_of[i];
        if (index == no_index) continue;
        has_mesh = has_mesh || model.nodes[i].mesh >= 0;
        const Node& node = reader.part.nodes[index];
        if (!holds[index] || !shrinks_to_point(node)) continue;
        if (count++ == 0) first = fmt::format("/nodes/{}/{}", i, node.transform.matrix ? "matrix" : "scale");
    }
    if (!has_mesh) {
        const std::string place =
            model.scenes.empty() ? "/nodes" : fmt::format("/scenes/{}", std::max(model.defaultScene, 0));
        reader.warn(place, "no node of the scene has a mesh: the file shows nothing");
    }
    if (count > 0) {
        const std::string others = count == 1 ? "" : fmt::format(" (and those of {} more nodes)", count - 1);
        reader.warn(first, fmt::format("shrinks the meshes below the node to a point{}: they cannot be seen", others));
    }
}

}  // namespace

void append_gltf(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index,
                 const LoadLimits& limits, const std::vector<std::string>* animations) {
    const GltfSource source = load_gltf_source(file, limits);
    GltfReader reader(source);
    reader.part.source.warnings = source.warnings;
    read_materials(reader);
    read_meshes(reader);
    read_cameras_and_lights(reader);
    read_nodes(reader);
    read_skins(reader);
    read_animations(reader, animations);
    free_skinned_meshes(reader);
    warn_of_invisible_meshes(reader);
    append_part(scene, std::move(reader.part), parent_node, include_index);
}

}  // namespace aleph
