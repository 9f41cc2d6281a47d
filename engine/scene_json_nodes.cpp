// Nodes of a scene file: the tree, transforms, and what hangs there.

#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/scene_json_reader.h"
#include "engine/scene_json_tracks.h"
#include "engine/transforms.h"

namespace aleph {

namespace {

/// Every name that the file gives, to tell a parent that stands too late from one that is missing, and to see doubles.
void collect_names(const JsonRef& list, NameIndex& names, std::size_t& count) {
    for (std::size_t i = 0; i < list.array_size(); ++i) {
        const JsonRef node = list[i];
        if (++count > max_scene_nodes) node.fail(fmt::format("more than {} nodes", max_scene_nodes));
        if (const auto name = node.find("name"); name && !name->string().empty()) {
            if (names.find(name->string())) {
                name->fail(fmt::format("two nodes are called \"{}\"", printable(name->string())));
            }
            names.add(name->string(), 0);
        }
        if (const auto children = node.find("children")) collect_names(*children, names, count);
    }
}

class NodeReader {
  public:
    NodeReader(SceneReader& reader, const JsonRef& list) : reader_(reader), scene_(reader.scene) {
        std::size_t count = 0;
        collect_names(list, all_names_, count);
    }

    void read_list(const JsonRef& list, int parent) {
        for (std::size_t i = 0; i < list.array_size(); ++i) {
            const JsonRef node = list[i];
            read(node, parent);
        }
    }

  private:
    void read(const JsonRef& at, int parent) {
        const int index = static_cast<int>(scene_.nodes.size());
        Node node;
        node.parent = parent;
        if (const auto name = at.find("parent")) node.parent = read_parent(*name, parent);
        const auto name = at.find("name");
        node.name = name ? name->string() : all_names_.unused(fmt::format("node {}", index));
        if (!name) all_names_.add(node.name, index);

        read_transform(at, node);
        if (const auto value = at.find("visible")) node.visible = read_visibility(*value, scene_.frame_rate);
        const std::string inner = node.name.empty() ? fmt::format("node {}", index) : node.name;
        read_meshes(at, node, inner);
        if (const auto value = at.find("camera")) node.camera = read_camera_use(reader_, *value, inner);
        if (const auto value = at.find("light")) node.light = read_light_use(reader_, *value, inner);

        if (!node.name.empty()) reader_.nodes.add(node.name, index);
        scene_.nodes.push_back(std::move(node));
        read_includes(reader_, at, index);
        if (const auto children = at.find("children")) read_list(*children, index);
    }

    int read_parent(const JsonRef& at, int nested_under) const {
        if (nested_under != no_index) at.fail("this node has a parent already: it stands among its children");
        return require_earlier(at, "a parent");
    }

    int require_earlier(const JsonRef& at, const char* what) const {
        if (const auto found = reader_.nodes.find(at.string())) return *found;
        if (at.string().empty() || !all_names_.find(at.string())) return all_names_.require(at);
        at.fail(fmt::format("\"{}\" does not stand before this node: {} has to, and a node cannot lie below itself",
                            printable(at.string()), what));
    }

    void read_transform(const JsonRef& at, Node& node) const {
        const FrameRate& rate = scene_.frame_rate;
        if (const auto value = at.find("matrix")) {
            for (const char* other : {"translation", "rotation", "scale"}) {
                if (const auto found = at.find(other)) {
                    found->fail(fmt::format("a node has either \"matrix\" or \"{}\", not both", other));
                }
            }
            node.matrix = read_matrix(*value, rate);
        }
        if (const auto value = at.find("translation")) node.translation = read_vector(*value, rate, any_value);
        if (const auto value = at.find("scale")) node.scale = read_scale(*value, rate);
        if (const auto value = at.find("rotation")) read_rotation(*value, node);
    }

    void read_rotation(const JsonRef& at, Node& node) const {
        const auto axis = at.json().is_object() ? at.find("axis") : std::nullopt;
        if (!axis) {
            node.rotation = read_quaternion(at, scene_.frame_rate);
            return;
        }
        AxisRotation rotation;
        const glm::dvec3 given = read_dvec3(*axis);
        const double length = glm::length(safe_normalize(given));
        if (length == 0.0) axis->fail("the axis cannot be zero");
        // What is unit within rounding keeps its bits.
        rotation.axis = std::abs(glm::length(given) - 1.0) < 1e-15 ? given : safe_normalize(given);
        const auto degrees = at.find("degrees"), radians = at.find("radians");
        if (degrees.has_value() == radians.has_value()) at.fail("an axis goes with either \"degrees\" or \"radians\"");
        rotation.angle = degrees ? read_degrees(*degrees, scene_.frame_rate, any_value)
                                 : read_number(*radians, scene_.frame_rate, any_value);
        node.axis_rotation = std::move(rotation);
    }

    void read_meshes(const JsonRef& at, Node& node, const std::string& name) {
        const auto shape = at.find("shape"), material = at.find("material");
        if (material && !shape) material->fail("\"material\" goes with \"shape\"; a mesh has its own");
        if (shape)
            node.meshes.push_back(read_mesh(reader_, *shape, material, std::nullopt, reader_.meshes.unused(name)));
        if (const auto mesh = at.find("mesh")) node.meshes.push_back(reader_.meshes.require(*mesh));
        if (const auto list = at.find("meshes")) {
            for (std::size_t i = 0; i < list->array_size(); ++i) {
                const JsonRef mesh = (*list)[i];
                node.meshes.push_back(reader_.meshes.require(mesh));
            }
        }
        if (const auto instance = at.find("instance")) {
            const Node& other = scene_.nodes[static_cast<std::size_t>(require_earlier(*instance, "what it shares"))];
            if (other.meshes.empty()) instance->fail("that node has no meshes of its own to share");
            node.meshes.insert(node.meshes.end(), other.meshes.begin(), other.meshes.end());
        }
    }

    SceneReader& reader_;
    Scene& scene_;
    NameIndex all_names_{"node"};
};

}  // namespace

void read_nodes(SceneReader& reader, const JsonRef& root) {
    const auto list = root.find("nodes");
    if (!list) return;
    NodeReader(reader, *list).read_list(*list, no_index);
}

void read_includes(SceneReader& reader, const JsonRef& parent, int node) {
    const auto include = parent.find("include");
    if (!include) return;
    const auto add = [&](const JsonRef& at) {
        if (const std::string fault = path_fault(at.string()); !fault.empty()) at.fail(fault);
        reader.scene.includes.push_back({at.string(), node});
        reader.result.include_places.push_back(at.pointer());
    };
    if (include->json().is_string()) {
        add(*include);
        return;
    }
    for (std::size_t i = 0; i < include->array_size(); ++i) {
        const JsonRef path = (*include)[i];
        add(path);
    }
}

}  // namespace aleph
