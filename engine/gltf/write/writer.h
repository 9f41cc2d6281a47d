#pragma once
// The parts of the glTF writer: each writes one kind of element. Only this folder uses them.

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "engine/gltf/write/buffer.h"
#include "engine/gltf/write/decompose.h"
#include "engine/gltf/write/keys.h"
#include "engine/pose/pose.h"

namespace aleph {

struct GltfWriter {
    /// @param name  of the file, for errors
    GltfWriter(const Scene& source, const std::string& name) : scene(source), range(frame_range(source)), buffer(name) {
        placed.world.resize(scene.nodes.size());
        placed.visible.resize(scene.nodes.size());
        placed.meshes.resize(scene.meshes.size());
    }

    const Scene& scene;
    FrameRange range;
    GlbBuffer buffer;
    OrderedJson document = OrderedJson::object();
    std::set<std::string> extensions;
    OrderedJson samplers = OrderedJson::array(), channels = OrderedJson::array();  ///< of the one animation
    std::vector<int> node_of;  ///< scene node -> glTF node that holds its content and its children
    int default_material = no_index;
    ScenePose placed;  ///< room for what is sampled
    std::vector<std::string> warnings;

    /// Adds an element to one of the document's lists. @return its index
    int add(const char* list, OrderedJson element) {
        OrderedJson& elements = document[list];
        elements.push_back(std::move(element));
        return static_cast<int>(elements.size()) - 1;
    }
    OrderedJson& node(int index) { return document["nodes"][index]; }

    /// The extension of an element, which is added if it is missing.
    OrderedJson& extend(OrderedJson& element, const char* extension) {
        extensions.insert(extension);
        OrderedJson& all = element["extensions"];
        if (!all.contains(extension)) all[extension] = OrderedJson::object();
        return all[extension];
    }

    /// Frames between these times.
    /// @param place  of what is sampled, for the error about too many
    void add_frames(SampledTimes& times, const std::string& place);
    /// Keys of a track, sampled at the frames too where glTF cannot hold its own. Instantiated for double, dvec3,
    /// dquat.
    template <class T>
    WrittenKeys keys_of(const Track<T>& track, const std::string& place);

    /// Keys of a node's "translation", "rotation", "scale" or "weights"; none where they are constant.
    void animate(int node, const char* path, const WrittenKeys& keys);
    /// Keys of the property that a JSON pointer names (KHR_animation_pointer).
    void animate(const std::string& pointer, const WrittenKeys& keys);
    /// Keys 0 and 1 of a node's visibility.
    void animate_visibility(int node, const WrittenKeys& keys);

  private:
    int add_sampler(const WrittenKeys& keys, int output);
    void add_channel(const std::string& pointer, int sampler);
};

// Called in this order: each needs what the ones before have written.
void write_materials(GltfWriter& writer);
void write_cameras_and_lights(GltfWriter& writer);
void write_nodes(GltfWriter& writer);
void write_skins(GltfWriter& writer);

/// The glTF material of a mesh; of one without a material the scene's default, which differs from glTF's.
int material_of(GltfWriter& writer, int material);

/// Divides colours by the largest number of the keys if that is above 1. @return what they were divided by
double scale_to_one(Track<glm::dvec3>& color);

/// s: of the first key, or 0 if that is earlier. glTF begins at 0 s.
template <class T>
double first_time(const Track<T>& track) {
    return std::max(0.0, sample_time(track.sampling, 0));
}
/// The value that stands where there are no keys in glTF.
template <class T>
T first_value(const Track<T>& track) {
    return track.key_count() == 1 ? key_value(track, 0) : evaluate(track, first_time(track));
}

/// A node's transform with respect to what it is written under, as one node or two.
struct WrittenTransform {
    TransformParts parts;  ///< one node will do where the inner rotation is the identity without keys
    WrittenKeys translation_keys, rotation_keys, scale_keys, inner_keys;

    bool is_nested() const { return parts.inner != glm::dquat(1.0, 0.0, 0.0, 0.0) || !inner_keys.times.empty(); }
};

/// @param node  of the scene
WrittenTransform write_transform(GltfWriter& writer, int node);

bool has_key(const Track<double>& track, double value);

/// True where the node does not hang below its parent: at some time the parent's transform does not apply.
bool is_detached(const Node& node);

// Vectors and colours as JSON.
template <class T>
OrderedJson to_json(const T& value) {
    return std::vector<double>(components(value).begin(), components(value).end());
}

}  // namespace aleph
