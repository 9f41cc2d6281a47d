#include "engine/gltf/gltf.h"

#include <utility>

#include "engine/gltf/reader.h"
#include "engine/scene/append.h"

namespace aleph {

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
    warn_of_invisible_meshes(reader);
    append_part(scene, std::move(reader.part), parent_node, include_index);
}

}  // namespace aleph
