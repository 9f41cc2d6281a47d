#include "engine/gltf/gltf.h"

#include <fmt/format.h>

#include <utility>

#include "engine/gltf/reader.h"
#include "engine/scene/append.h"

namespace aleph {

namespace {

void warn_of_no_mesh(GltfReader& reader) {
    const tinygltf::Model& model = reader.source.model;
    for (std::size_t i = 0; i < model.nodes.size(); ++i)
        if (reader.node_of[i] != no_index && model.nodes[i].mesh >= 0) return;
    const std::string place =
        model.scenes.empty() ? "/nodes" : fmt::format("/scenes/{}", std::max(model.defaultScene, 0));
    reader.warn(place, "no node of the scene has a mesh: the file shows nothing");
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
    warn_of_no_mesh(reader);
    append_part(scene, std::move(reader.part), parent_node, include_index);
}

}  // namespace aleph
