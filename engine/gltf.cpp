#include "engine/gltf.h"

#include <iterator>
#include <utility>

#include "engine/gltf_reader.h"

namespace aleph {

namespace {

void shift(int& index, std::size_t offset) {
    if (index != no_index) index += static_cast<int>(offset);
}

/// Makes the part's indices those that its elements have once they stand behind the scene's own.
void rebase(Scene& part, const Scene& scene, int parent_node, int include) {
    for (Node& node : part.nodes) {
        if (node.parent == no_index) {
            node.parent = parent_node;
        } else {
            shift(node.parent, scene.nodes.size());
        }
        for (int& mesh : node.meshes) shift(mesh, scene.meshes.size());
        shift(node.camera, scene.cameras.size());
        shift(node.light, scene.lights.size());
        node.include = include;
    }
    for (Mesh& mesh : part.meshes) {
        shift(mesh.material, scene.materials.size());
        shift(mesh.skin, scene.skins.size());
        mesh.include = include;
    }
    for (Material& material : part.materials) {
        for (TextureRef* texture :
             {&material.base_color_texture, &material.metallic_roughness_texture, &material.emission_texture,
              &material.specular_texture, &material.specular_color_texture, &material.transmission_texture}) {
            shift(texture->image, scene.images.size());
        }
        material.include = include;
    }
    for (Skin& skin : part.skins) {
        for (int& joint : skin.joints) shift(joint, scene.nodes.size());
        skin.include = include;
    }
    for (SceneImage& image : part.images) image.include = include;
    for (Light& light : part.lights) light.include = include;
    for (Camera& camera : part.cameras) camera.include = include;
}

}  // namespace

void append_gltf(const std::filesystem::path& file, Scene& scene, int parent_node, int include_index) {
    const GltfSource source = load_gltf_source(file);
    GltfReader reader(source);
    reader.part.warnings = source.warnings;
    read_materials(reader);
    read_meshes(reader);
    read_cameras_and_lights(reader);
    read_nodes(reader);
    read_skins(reader);
    read_animations(reader);
    rebase(reader.part, scene, parent_node, include_index);

    // Room first, for all: after that nothing can fail half way.
    const auto for_each_list = [&](const auto& apply) {
        apply(scene.nodes, reader.part.nodes);
        apply(scene.meshes, reader.part.meshes);
        apply(scene.skins, reader.part.skins);
        apply(scene.materials, reader.part.materials);
        apply(scene.images, reader.part.images);
        apply(scene.lights, reader.part.lights);
        apply(scene.cameras, reader.part.cameras);
        apply(scene.warnings, reader.part.warnings);
    };
    for_each_list([](auto& all, const auto& more) { all.reserve(all.size() + more.size()); });
    for_each_list([](auto& all, auto& more) {
        all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    });
}

}  // namespace aleph
