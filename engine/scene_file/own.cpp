// The part of a scene that its own file defines, without the elements of includes.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/scene/visit.h"
#include "engine/scene_file/scene_text.h"

namespace aleph {

namespace {

/// The elements before the first included one. Only these are copied: included meshes are large.
template <class Element>
std::vector<Element> own_part(const char* kind, const std::vector<Element>& list, const std::string& file) {
    const auto is_included = [](const Element& element) { return element.include != no_index; };
    const auto end = std::find_if(list.begin(), list.end(), is_included);
    const auto late = std::find_if_not(end, list.end(), is_included);
    if (late != list.end()) {
        throw InputError(file, fmt::format("{} {}", kind, late - list.begin()),
                         "comes after an element of an include; the scene's own elements have to come first");
    }
    return {list.begin(), end};
}

void check_index(int index, std::size_t count, const char* kind, std::size_t user, const char* what,
                 const std::string& file) {
    if (index >= no_index && index < static_cast<int>(count)) return;
    throw InputError(file, fmt::format("{} {}", kind, user),
                     fmt::format("refers to {} {}, which belongs to an include or does not exist", what, index));
}

}  // namespace

Scene without_includes(const Scene& scene, const std::string& file) {
    Scene own;
    own.source = scene.source;
    own.film = scene.film;
    own.environment = scene.environment;
    for_each_list([&](const char* kind, auto& to, const auto& from) { to = own_part(kind, from, file); }, own, scene);

    for (std::size_t i = 0; i < own.nodes.size(); ++i) {
        const Node& node = own.nodes[i];
        check_index(node.parent, i, "node", i, "parent node", file);
        for (const int mesh : node.meshes) check_index(mesh, own.meshes.size(), "node", i, "mesh", file);
        check_index(node.camera, own.cameras.size(), "node", i, "camera", file);
        check_index(node.light, own.lights.size(), "node", i, "light", file);
    }
    for (std::size_t i = 0; i < own.meshes.size(); ++i) {
        const Mesh& mesh = own.meshes[i];
        check_index(mesh.material, own.materials.size(), "mesh", i, "material", file);
        check_index(mesh.deformation.points, own.point_caches.size(), "mesh", i, "points", file);
        check_index(mesh.deformation.skin, own.skins.size(), "mesh", i, "skin", file);
        check_index(mesh.subdivision.cage, own.cages.size(), "mesh", i, "cage", file);
    }
    for (std::size_t i = 0; i < own.cages.size(); ++i) {
        check_index(own.cages[i].points, own.point_caches.size(), "cage", i, "points", file);
    }
    for (std::size_t i = 0; i < own.source.includes.size(); ++i) {
        check_index(own.source.includes[i].node, own.nodes.size(), "include", i, "node", file);
    }
    return own;
}

}  // namespace aleph
