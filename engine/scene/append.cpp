#include "engine/scene/append.h"

#include <iterator>

#include "engine/scene/visit.h"

namespace aleph {

namespace {

void shift(int& index, std::size_t offset) {
    if (index != no_index) index += static_cast<int>(offset);
}

/// Shifts the part's indices by the number of elements that the scene already has.
void rebase(Scene& part, const Scene& scene, int parent_node) {
    for (Node& node : part.nodes) {
        if (node.parent == no_index) {
            node.parent = parent_node;
        } else {
            shift(node.parent, scene.nodes.size());
        }
        for (int& mesh : node.meshes) shift(mesh, scene.meshes.size());
        shift(node.camera, scene.cameras.size());
        shift(node.light, scene.lights.size());
    }
    for (Mesh& mesh : part.meshes) {
        shift(mesh.material, scene.materials.size());
        shift(mesh.deformation.points, scene.point_caches.size());
        shift(mesh.deformation.skin, scene.skins.size());
        shift(mesh.subdivision.cage, scene.cages.size());
    }
    for (Cage& cage : part.cages) shift(cage.points, scene.point_caches.size());
    for (Skin& skin : part.skins) {
        for (int& joint : skin.joints) shift(joint, scene.nodes.size());
    }
    for (Material& material : part.materials) {
        for (TextureRef& texture : material.textures.all) shift(texture.image, scene.images.size());
    }
}

}  // namespace

void append_part(Scene& scene, Scene&& part, int parent_node, int include) {
    rebase(part, scene, parent_node);
    for_each_list(
        [&](const char*, auto& elements) {
            for (auto& element : elements) element.include = include;
        },
        part);
    // Reserve memory for all lists first: after that nothing can fail.
    const auto reserve = [](const char*, auto& all, const auto& more) { all.reserve(all.size() + more.size()); };
    const auto append = [](const char*, auto& all, auto& more) {
        all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
    };
    for_each_list(reserve, scene, part);
    reserve("", scene.source.warnings, part.source.warnings);
    for_each_list(append, scene, part);
    append("", scene.source.warnings, part.source.warnings);
}

bool can_be_copied(const Scene& scene, int begin, int end) {
    for (int i = begin; i < end; ++i) {
        for (const int mesh : scene.nodes[i].meshes) {
            const Deformation& deformation = scene.meshes[mesh].deformation;
            if (deformation.skin != no_index || !deformation.targets.empty()) return false;
        }
    }
    return true;
}

void append_copy(Scene& scene, int begin, int end, int parent_node, int include) {
    const int offset = static_cast<int>(scene.nodes.size()) - begin;
    scene.nodes.reserve(scene.nodes.size() + static_cast<std::size_t>(end - begin));
    for (int i = begin; i < end; ++i) {
        Node copy = scene.nodes[i];
        copy.parent = copy.parent >= begin ? copy.parent + offset : parent_node;
        copy.include = include;
        scene.nodes.push_back(std::move(copy));
    }
}

}  // namespace aleph
