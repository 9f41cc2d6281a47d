#include <fmt/format.h>

#include <numbers>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "engine/load/format_rows.h"
#include "engine/scene/append.h"

namespace aleph {

namespace {

struct Included {
    int begin = 0, end = 0;
};

bool is_same_content(const Include& a, const Include& b) {
    return a.path == b.path && a.animations == b.animations && a.materials == b.materials && a.scale == b.scale &&
           a.up == b.up;
}

/// A node that turns and scales the file's content, if it has to be.
int add_axes_node(Scene& scene, int index) {
    const Include& include = scene.source.includes[index];
    if (include.scale == 1.0 && include.up == Include::Up::y) return include.node;
    constexpr double quarter = std::numbers::pi / 2.0;
    Node node{.name = include.path};
    node.parent = include.node;
    node.include = index;
    node.transform.scale = glm::dvec3(include.scale);
    if (include.up == Include::Up::x) node.transform.rotation = glm::angleAxis(quarter, glm::dvec3(0.0, 0.0, 1.0));
    if (include.up == Include::Up::z) node.transform.rotation = glm::angleAxis(-quarter, glm::dvec3(1.0, 0.0, 0.0));
    return append(scene.nodes, std::move(node));
}

template <class Accept>
int find_material(const Scene& scene, const std::string& name, const std::string& place, const Accept& accept) {
    std::vector<std::string> known;
    for (int i = 0; i < std::ssize(scene.materials); ++i) {
        if (!accept(scene.materials[i])) continue;
        if (scene.materials[i].name == name) return i;
        known.push_back(scene.materials[i].name);
    }
    throw InputError(scene.source.file, place,
                     fmt::format("there is no material \"{}\"{}", printable(name),
                                 known.empty() ? "; there are none" : suggestion(name, known)));
}

/// Replaces materials of the file by the scene's own.
void replace_materials(Scene& scene, int index, const std::string& place) {
    for (const auto& [theirs, ours] : scene.source.includes[index].materials) {
        const std::string pair = fmt::format("{}/materials/{}", place, printable(theirs));
        const int replaced = find_material(scene, theirs, pair, [&](const Material& m) { return m.include == index; });
        const int used = find_material(scene, ours, pair, [](const Material& m) { return m.include == no_index; });
        for (Mesh& mesh : scene.meshes) {
            if (mesh.include == index && mesh.material == replaced) mesh.material = used;
        }
    }
}

void append_file(Scene& scene, int index, const std::string& place, const LoadRequest& request) {
    const Include include = scene.source.includes[index];
    const SceneFormat& format =
        require_format(request.formats, FormatUse::include, include.path, scene.source.file, place);
    if (include.animations && !format.has_animation_names) {
        throw InputError(scene.source.file, place + "/animation",
                         fmt::format("{} has no animations to choose from", format.description));
    }
    const int parent = scene.source.includes[index].content = add_axes_node(scene, index);
    format.append({request.path.parent_path() / include.path, parent, index, request.limits,
                   include.animations ? &*include.animations : nullptr},
                  scene);
    replace_materials(scene, index, place);
}

}  // namespace

void load_includes(Scene& scene, const std::vector<std::string>& places, const LoadRequest& request) {
    std::vector<Included> included;
    for (int i = 0; i < std::ssize(scene.source.includes); ++i) {
        const Include& include = scene.source.includes[i];
        const int begin = static_cast<int>(scene.nodes.size());
        int same = 0;
        while (same < i && !(is_same_content(scene.source.includes[same], include) &&
                             can_be_copied(scene, included[same].begin, included[same].end))) {
            ++same;
        }
        if (same < i) {
            const int space = scene.source.includes[same].content;
            scene.source.includes[i].content =
                space < included[same].begin ? include.node : space + begin - included[same].begin;
            append_copy(scene, included[same].begin, included[same].end, include.node, i);
        } else {
            append_file(scene, i, places[i], request);
        }
        included.push_back({begin, static_cast<int>(scene.nodes.size())});
    }
}

}  // namespace aleph
