// Nodes of a scene file: the tree, transforms, and references to elements.

#include <fmt/format.h>

#include <unordered_set>

#include "engine/base/errors.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

/// All node names of the file: for duplicates, and for parents that come too late rather than being absent.
/// @return whether a node includes files
bool collect_names(const JsonRef& list, NameIndex& names, std::size_t& count) {
    bool includes = false;
    for (const JsonRef node : list.elements()) {
        if (++count > max_scene_nodes) node.fail(fmt::format("more than {} nodes", max_scene_nodes));
        if (const auto name = node.find("name"); name && !name->string().empty()) {
            if (names.find(name->string())) {
                name->fail(fmt::format("two nodes are called \"{}\"", printable(name->string())));
            }
            names.add(name->string(), 0);
        }
        includes = includes || node.has("include");
        if (const auto children = node.find("children")) includes = collect_names(*children, names, count) || includes;
    }
    return includes;
}

class NodeReader {
  public:
    NodeReader(SceneReader& reader, const JsonRef& root, const JsonRef& list) : reader_(reader), scene_(reader.scene) {
        std::size_t count = 0;
        has_includes_ = collect_names(list, all_names_, count) || root.has("include");
    }

    void read_list(const JsonRef& list, int parent) {
        for (const JsonRef node : list.elements()) read(node, parent);
    }

  private:
    void read(const JsonRef& at, int parent) {
        reader_.charge(node_bytes, at, "it has too many nodes");
        const int index = static_cast<int>(scene_.nodes.size());
        Node node{.parent = parent};
        if (const auto name = at.find("parent")) node.parent = read_parent(*name, parent);
        const auto name = at.find("name");
        node.name = name ? name->string() : all_names_.unused(fmt::format("node {}", index));
        if (!name) all_names_.add(node.name, index);

        read_transform(at, node);
        read_guides(reader_, at, index);
        if (const auto target = at.find("look_at"); target && target->json().is_string())
            all_names_.require(*target, included_nodes_advice());
        if (const auto value = at.find("inherits")) node.inherits = read_visibility(*value, scene_.film.frame_rate);
        if (const auto value = at.find("visible")) node.visible = read_visibility(*value, scene_.film.frame_rate);
        const std::string inner = node.name.empty() ? fmt::format("node {}", index) : node.name;
        read_meshes(at, node, inner);
        if (const auto value = at.find("camera"))
            node.camera = read_use(reader_, *value, reader_.names.cameras, inner, add_camera);
        if (const auto value = at.find("light"))
            node.light = read_use(reader_, *value, reader_.names.lights, inner, add_light);

        const bool shows = !node.meshes.empty() || node.light != no_index || at.has("instance") || at.has("include");
        if (shows) refuse_late(at, node.parent);
        add_node(std::move(node));
        if (const auto instance = at.find("instance")) read_instance(*instance, index);
        const std::size_t includes = scene_.source.includes.size();
        read_includes(reader_, at, index);
        if (scene_.source.includes.size() > includes) with_include_.insert(index);
        if (const auto children = at.find("children")) read_list(*children, index);
    }

    /// An instance before this node would be without it.
    void refuse_late(const JsonRef& at, int parent) const {
        const int instance = parent == no_index ? no_index : shown_by_[parent];
        if (instance == no_index) return;
        at.fail(fmt::format("it has to come before \"{}\", which shows what is below \"{}\" again",
                            printable(scene_.nodes[instance].name), printable(scene_.nodes[parent].name)));
    }

    int read_parent(const JsonRef& at, int nested_under) const {
        if (nested_under != no_index)
            at.fail("this node has a parent already: it is in the list \"children\" of another");
        return require_earlier(at, "a parent");
    }

    int require_earlier(const JsonRef& at, const char* what) const {
        if (const auto found = reader_.names.nodes.find(at.string())) return *found;
        if (at.string().empty() || !all_names_.find(at.string()))
            return all_names_.require(at, included_nodes_advice());
        at.fail(fmt::format("\"{}\" comes after this node: {} has to come before, and a node cannot lie below itself",
                            printable(at.string()), what));
    }

    /// Advice for a name that may be that of a node of an included file.
    const char* included_nodes_advice() const {
        if (!has_includes_) return "";
        return "; nodes of an included file cannot be named here: name the node that has the \"include\"";
    }

    void read_transform(const JsonRef& at, Node& node) const {
        const FrameRate& rate = scene_.film.frame_rate;
        for (const char* whole : {"matrix", "operations"}) {
            if (!at.has(whole)) continue;
            for (const char* other : {"translation", "rotation", "scale", "operations", "look_at", "follow_path"}) {
                const auto found = at.find(other);
                if (!found || std::string(other) == whole) continue;
                found->fail(fmt::format("a node has either \"{}\" or \"{}\", not both", whole, other));
            }
        }
        if (const auto value = at.find("matrix")) node.transform.matrix = read_matrix(*value, rate);
        if (const auto value = at.find("operations")) node.transform.operations = read_operations(*value, rate);
        if (const auto value = at.find("translation"))
            node.transform.translation = read_vector(*value, rate, any_value);
        if (const auto value = at.find("scale")) node.transform.scale = read_scale(*value, rate);
        if (const auto value = at.find("rotation")) {
            node.transform.axis_rotation = read_axis_rotation(*value, rate);
            if (!node.transform.axis_rotation) node.transform.rotation = read_quaternion(*value, rate);
        }
    }

    void read_meshes(const JsonRef& at, Node& node, const std::string& name) {
        const auto shape = at.find("shape"), material = at.find("material");
        if (material && !shape) material->fail("\"material\" goes with \"shape\"; a mesh from \"meshes\" has its own");
        if (shape)
            node.meshes.push_back(
                read_mesh(reader_, *shape, material, std::nullopt, reader_.names.meshes.unused(name)));
        if (const auto mesh = at.find("mesh")) node.meshes.push_back(reader_.names.meshes.require(*mesh));
        for_each_element(at, "meshes", [&](const JsonRef& mesh, std::size_t) {
            node.meshes.push_back(reader_.names.meshes.require(mesh));
        });
    }

    /// Shows the named node here too: this node gets its meshes and light, and copies of all nodes below it.
    void read_instance(const JsonRef& at, int index) {
        const int source = require_earlier(at, "its source");
        if (!children_[source].empty()) refuse_ancestor(at, source, index);
        bool shows = share(at, source, index);
        shown_by_[source] = index;
        struct Copy {
            int source, parent;
        };
        std::vector<Copy> left;
        const auto add_children = [&](int node, int parent) {
            const std::vector<int>& below = children_[node];
            for (auto child = below.rbegin(); child != below.rend(); ++child) left.push_back({*child, parent});
        };
        add_children(source, index);
        while (!left.empty()) {
            const Copy next = left.back();
            left.pop_back();
            shown_by_[next.source] = index;
            reader_.charge(node_bytes, at, "too many nodes are copied");
            Node copy = scene_.nodes[next.source];
            copy.parent = next.parent;
            copy.meshes.clear();
            copy.light = copy.camera = no_index;
            copy.name = all_names_.unused(fmt::format("{}/{}", scene_.nodes[index].name, copy.name));
            reader_.charge(4 * copy.name.size(), at, "too many nodes are copied");
            const int made = add_node(std::move(copy));
            reader_.guided.copies.emplace_back(made, next.source);
            all_names_.add(scene_.nodes.back().name, made);
            shows = share(at, next.source, made) || shows;
            add_children(next.source, made);
        }
        if (!shows) at.fail("neither that node nor a node below it has meshes or a light");
    }

    void refuse_ancestor(const JsonRef& at, int source, int index) {
        for (int above = index; above != no_index; above = scene_.nodes[above].parent) {
            if (above == source) at.fail("this node lies below the one it names: it would hold itself");
            if (++ancestors_seen_ > max_ancestors_seen)
                at.fail("too many instances of nodes with children at too great a depth");
        }
    }

    /// Gives the node the source's meshes and light. @return whether the source has any
    bool share(const JsonRef& at, int source, int index) {
        const std::size_t includes = scene_.source.includes.size();
        for (std::size_t i = 0; with_include_.contains(source) && i < includes; ++i) {
            if (scene_.source.includes[i].node != source) continue;
            reader_.charge(include_bytes, at, "too many includes are shown again");
            scene_.source.includes.push_back(scene_.source.includes[i]);
            scene_.source.includes.back().node = index;
            reader_.result.include_places.push_back(at.pointer());
            with_include_.insert(index);
        }
        const Node& from = scene_.nodes[source];
        Node& to = scene_.nodes[index];
        reader_.charge(from.meshes.size() * sizeof(int), at, "too many meshes are shared");
        to.meshes.insert(to.meshes.end(), from.meshes.begin(), from.meshes.end());
        if (to.light == no_index) to.light = from.light;
        return !from.meshes.empty() || from.light != no_index || scene_.source.includes.size() > includes;
    }

    int add_node(Node node) {
        const int index = static_cast<int>(scene_.nodes.size());
        if (node.parent != no_index) children_[node.parent].push_back(index);
        if (!node.name.empty()) reader_.names.nodes.add(node.name, index);
        children_.emplace_back();
        shown_by_.push_back(node.parent == no_index ? no_index : shown_by_[node.parent]);
        scene_.nodes.push_back(std::move(node));
        return index;
    }

    static constexpr std::size_t node_bytes = sizeof(Node) + 600;  // with values of tracks and names to look up
    static constexpr std::size_t include_bytes = 4096;
    static constexpr std::size_t max_ancestors_seen = 10'000'000;

    SceneReader& reader_;
    Scene& scene_;
    NameIndex all_names_{"node"};
    bool has_includes_ = false;  ///< files, at the top or below a node
    std::size_t ancestors_seen_ = 0;
    std::vector<std::vector<int>> children_;  ///< by node
    std::unordered_set<int> with_include_;
    std::vector<int> shown_by_;  ///< by node: the last instance that shows it and what is below it
};

Include read_include(const JsonRef& at) {
    Include include;
    const bool plain = at.json().is_string();
    const std::optional<JsonRef> file = plain ? std::optional<JsonRef>() : at.find("file");
    const JsonRef& path = file ? *file : at;
    if (const std::string fault = path_fault(path.string()); !fault.empty()) path.fail(fault);
    include.path = path.string();
    if (plain) return include;
    if (const auto animation = at.find("animation")) {
        include.animations.emplace();
        if (animation->json().is_string()) include.animations->push_back(animation->string());
        if (animation->json().is_array())
            for (const JsonRef name : animation->elements()) include.animations->push_back(name.string());
    }
    if (const auto materials = at.find("materials")) {
        for (const auto& entry : materials->json().items()) {
            include.materials[entry.key()] = materials->require(entry.key()).string();
        }
    }
    if (const auto scale = at.find("scale")) include.scale = scale->number_above(0.0);
    if (const auto up = at.find("up")) include.up = static_cast<Include::Up>(up->string().front() - 'x');
    return include;
}

}  // namespace

void read_nodes(SceneReader& reader, const JsonRef& root) {
    const auto list = root.find("nodes");
    if (!list) return;
    NodeReader(reader, root, *list).read_list(*list, no_index);
}

void read_includes(SceneReader& reader, const JsonRef& parent, int node) {
    const auto include = parent.find("include");
    if (!include) return;
    const auto add = [&](const JsonRef& at) {
        reader.scene.source.includes.push_back(read_include(at));
        reader.scene.source.includes.back().node = node;
        reader.result.include_places.push_back(at.pointer());
    };
    if (!include->json().is_array()) return add(*include);
    for (const JsonRef one : include->elements()) add(one);
}

}  // namespace aleph
