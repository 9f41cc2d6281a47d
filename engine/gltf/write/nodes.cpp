// glTF writer: the tree of nodes, with what stands at each.

#include "engine/gltf/write/meshes.h"

namespace aleph {

namespace {

/// True where a node is shown in spite of a hidden one above it: glTF hides everything below a hidden node, so what is
/// hidden is said at the meshes and lights themselves.
bool shows_below_hidden(const Scene& scene) {
    std::vector<bool> hides(scene.nodes.size());  // the node or one above it may be hidden
    for (std::size_t n = 0; n < scene.nodes.size(); ++n) {
        const Node& node = scene.nodes[n];
        const bool above = node.parent != no_index && hides[node.parent];
        if (above && (has_key(node.visible, 2.0) || is_detached(node))) return true;
        hides[n] = above || has_key(node.visible, 0.0);
    }
    return false;
}

/// When something is there: 1, else 0.
/// @param tracks  on which that depends, step or nearest
/// @param value   from a time in s to 0 or 1
template <class Value>
Track<double> make_presence(const std::vector<const Track<double>*>& tracks, const Value& value) {
    SampledTimes sampled;
    for (const Track<double>* track : tracks) sampled.add(*track);
    std::vector<double> times = sampled.steps;
    times.insert(times.end(), sampled.smooth.begin(), sampled.smooth.end());
    sort_and_unite(times);
    if (times.empty()) return Track<double>(value(0.0) ? 1.0 : 0.0);
    std::vector<double> values;
    for (const double t : times) values.push_back(value(t) ? 1.0 : 0.0);
    return {std::move(times), std::move(values), Interpolation::step};
}

class NodeWriter {
  public:
    explicit NodeWriter(GltfWriter& writer)
        : writer_(writer), meshes_(writer), at_content_(shows_below_hidden(writer.scene)) {}

    void write() {
        const Scene& scene = writer_.scene;
        OrderedJson roots = OrderedJson::array();
        writer_.node_of.assign(scene.nodes.size(), no_index);
        for (int n = 0; n < std::ssize(scene.nodes); ++n) {
            const Node& node = scene.nodes[n];
            const bool in_world = is_detached(node) && is_animated(node.inherits);  // WrittenTransform is its world's
            const int above = in_world ? no_index : is_detached(node) ? space_of(scene, node) : node.parent;
            const int top = write_node(n);
            if (above == no_index) {
                roots.push_back(top);
            } else {
                adopt(writer_.node_of[above], top);
            }
        }
        meshes_.finish();
        OrderedJson root = OrderedJson::object();
        if (!scene.source.name.empty()) root["name"] = scene.source.name;
        if (!roots.empty()) root["nodes"] = std::move(roots);
        writer_.document["scene"] = writer_.add("scenes", std::move(root));
    }

  private:
    void adopt(int parent, int child) { writer_.node(parent)["children"].push_back(child); }

    int add_node(const std::string& name) {
        OrderedJson node = OrderedJson::object();
        if (!name.empty()) node["name"] = name;
        return writer_.add("nodes", std::move(node));
    }

    /// @return the glTF node that stands for the scene's, or the upper of two
    int write_node(int index) {
        const Node& node = writer_.scene.nodes[index];
        const WrittenTransform transform = write_transform(writer_, index);
        const bool is_nested = transform.is_nested();
        const int top = add_node(is_nested ? node.name + ".shear" : node.name);
        write_place(top, transform);
        int inner = top;
        if (is_nested) {
            inner = add_node(node.name);
            adopt(top, inner);
            set_rotation(inner, transform.parts.inner);
            writer_.animate(inner, "rotation", transform.inner_keys);
        }
        writer_.node_of[index] = inner;
        if (node.camera != no_index) writer_.node(inner)["camera"] = node.camera;
        if (!at_content_)
            show(top, make_presence({&node.visible}, [&](double t) { return evaluate(node.visible, t) != 0.0; }));
        write_content(index, inner);
        return top;
    }

    void set_rotation(int index, const glm::dquat& rotation) {
        if (rotation != glm::dquat(1.0, 0.0, 0.0, 0.0)) writer_.node(index)["rotation"] = to_json(rotation);
    }

    void write_place(int index, const WrittenTransform& transform) {
        if (transform.parts.translation != glm::dvec3(0.0))
            writer_.node(index)["translation"] = to_json(transform.parts.translation);
        set_rotation(index, transform.parts.rotation);
        if (transform.parts.scale != glm::dvec3(1.0)) writer_.node(index)["scale"] = to_json(transform.parts.scale);
        writer_.animate(index, "translation", transform.translation_keys);
        writer_.animate(index, "rotation", transform.rotation_keys);
        writer_.animate(index, "scale", transform.scale_keys);
    }

    /// Hides a node, as KHR_node_visibility does: with all that is below.
    void show(int index, const Track<double>& presence) {
        if (!is_animated(presence) && presence.values[0] != 0.0) return;
        writer_.extend(writer_.node(index), "KHR_node_visibility")["visible"] = first_value(presence) != 0.0;
        if (is_animated(presence)) writer_.animate_visibility(index, make_keys(presence));
    }

    /// Visible with regard to the nodes above it.
    bool is_visible(int index, double seconds) const {
        for (int n = index; n != no_index;) {
            const Node& node = writer_.scene.nodes[n];
            const double own = evaluate(node.visible, seconds);
            if (own == 0.0) return false;
            n = own >= 2.0 ? space_of(writer_.scene, node) : node.parent;
        }
        return true;
    }

    /// When a mesh or light at a node is there, as far as the nodes above it do not say that in the file.
    Track<double> presence_at(int index, const Mesh* mesh) const {
        std::vector<const Track<double>*> tracks;
        if (mesh != nullptr) tracks.push_back(&mesh->present);
        for (int n = at_content_ ? index : no_index; n != no_index; n = writer_.scene.nodes[n].parent)
            tracks.push_back(&writer_.scene.nodes[n].visible);
        return make_presence(tracks, [&](double t) {
            return (mesh == nullptr || evaluate(mesh->present, t) != 0.0) && (!at_content_ || is_visible(index, t));
        });
    }

    /// A node below `inner` for what is not always there, or where `inner` has a mesh already; else `inner` itself.
    int content_node(int inner, const Track<double>& presence, bool is_free) {
        const bool always = !is_animated(presence) && presence.values[0] != 0.0;
        if (always && is_free) return inner;
        const std::string name = writer_.node(inner).value("name", std::string());
        const int node = add_node(name + ".part");
        adopt(inner, node);
        show(node, presence);
        return node;
    }

    void write_content(int index, int inner) {
        const Node& node = writer_.scene.nodes[index];
        bool is_free = true;
        for (const std::vector<int>& group : meshes_.group(node.meshes)) {
            const Mesh& first = writer_.scene.meshes[group[0]];
            const int holder = content_node(inner, presence_at(index, &first), is_free);
            if (holder == inner) is_free = false;
            const int mesh = meshes_.write(group, node.name);
            writer_.node(holder)["mesh"] = mesh;
            if (is_skinned(first)) writer_.node(holder)["skin"] = first.deformation.skin;
            writer_.animate(holder, "weights", meshes_.weight_keys(group[0]));
        }
        if (node.light == no_index) return;
        const int holder = content_node(inner, presence_at(index, nullptr), true);
        writer_.extend(writer_.node(holder), "KHR_lights_punctual")["light"] = node.light;
    }

    GltfWriter& writer_;
    MeshWriter meshes_;
    bool at_content_;  ///< visibility is written at meshes and lights
};

}  // namespace

void write_nodes(GltfWriter& writer) {
    NodeWriter(writer).write();
}

}  // namespace aleph
