#pragma once
// The parts of the glTF reader: each reads one kind of element. Only this folder uses them.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/gltf/source.h"
#include "engine/scene/append.h"

namespace aleph {

// Values of accessors: any component type, normalized or not, packed, interleaved or sparse (accessors.cpp).

/// Vertices, indices and keys of a file may decode to decoded_bytes_base bytes, and decoded_bytes_per_buffer_byte more
/// for each byte of its buffers. Without a limit a small file that refers to the same data a million times would take
/// all memory.
inline constexpr std::uint64_t decoded_bytes_base = std::uint64_t{256} << 20;
inline constexpr std::uint64_t decoded_bytes_per_buffer_byte = 8;

class GltfAccessors {
  public:
    /// @param source  validated; must outlive this
    explicit GltfAccessors(const GltfSource& source);

    /// All components in order. Normalized integers become -1 (or 0) to 1, floats convert exactly.
    /// Instantiated for float and double.
    /// @throws InputError where a value is not finite or beyond +-max_value
    template <class T>
    std::vector<T> read(int accessor, double max_value = max_json_number);

    /// @param kind  what the indices count, for the message
    /// @throws InputError where an index is not below `limit`
    std::vector<std::uint32_t> read_indices(int accessor, std::size_t limit, const char* kind = "vertex");

    std::size_t count(int accessor) const { return source_.model.accessors[accessor].count; }
    std::size_t components(int accessor) const;  ///< 3 for VEC3
    bool is_float(int accessor) const {
        return source_.model.accessors[accessor].componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    }

    /// Counts memory before it is taken. Call it wherever data that was read is copied.
    /// @throws InputError beyond the file's allowance
    void charge(std::uint64_t bytes, const std::string& place);

  private:
    /// Calls store(element, component, value) with values of the component type: first the base values, then the sparse
    /// ones that replace some of them.
    template <class Store>
    void for_each_value(int accessor, const Store& store);
    std::vector<std::uint32_t> read_sparse_indices(int accessor, const nlohmann::json& sparse, std::size_t limit);

    const GltfSource& source_;
    std::uint64_t bytes_left_ = decoded_bytes_base;
};

/// How nodes use a scene mesh that was read from a primitive.
struct GltfMeshUse {
    std::size_t mesh = 0, primitive = 0;  ///< the glTF primitive
    bool shared = false;                  ///< by rigid nodes
    bool owned = false;                   ///< by one node that deforms it
    int rigid_copy = no_index;            ///< for rigid nodes, where a deforming one came first
};

struct GltfReader {
    explicit GltfReader(const GltfSource& gltf) : source(gltf), accessors(gltf) {}

    const GltfSource& source;
    GltfAccessors accessors;
    Scene part;                               ///< what was read; indices count from its own elements
    std::vector<std::vector<int>> meshes_of;  ///< glTF mesh -> one scene mesh per primitive with triangles
    std::vector<GltfMeshUse> uses;            ///< of the meshes in `meshes_of`, which come first in the part
    std::vector<int> node_of;                 ///< glTF node -> scene node, or no_index outside the scene
    std::vector<std::vector<int>> morphs_of;  ///< glTF node -> scene meshes whose targets its weights move
    int default_material = no_index;          ///< of the part, once a primitive needs it
    std::vector<int> skin_of;                 ///< glTF skin -> scene skin, or no_index where no node uses it

    void warn(const std::string& place, const std::string& text) {
        part.source.warnings.push_back(source.file + ": " + place + ": " + text);
    }
};

// Called in this order: each needs what the ones before have read.
void read_materials(GltfReader& reader);
void read_meshes(GltfReader& reader);
void read_cameras_and_lights(GltfReader& reader);
void read_nodes(GltfReader& reader);
void read_skins(GltfReader& reader);
/// Skinned meshes below a node that is flat at some time get a node of their own: they follow their joints alone, but
/// what a flat transform did to them cannot be undone. Comes after read_animations.
void free_skinned_meshes(GltfReader& reader);
/// @param names  of the animations that are read; null: all
void read_animations(GltfReader& reader, const std::vector<std::string>* names);

/// The material of primitives that name none, a white metal: added to the part on first use.
int default_material(GltfReader& reader);

/// The scene meshes that stand under a node: shared ones of a rigid mesh, the node's own of one that deforms.
/// @param node  of the file
std::vector<int> take_meshes(GltfReader& reader, std::size_t node);

/// The skin of a vertex: JOINTS_n and WEIGHTS_n, weights brought to a sum of 1.
void read_joint_weights(GltfReader& reader, const GltfMeshUse& use, std::size_t skin, Mesh& mesh);

/// A quaternion made unit, and the length it had.
struct UnitRotation {
    glm::dquat rotation;
    double length = 1.0;

    /// @param is_float  small integers are off by up to 7e-3
    bool was_far_from_unit(bool is_float = true) const {
        const double tolerance = is_float ? 1e-3 : 1.6e-2;
        return !(length > 1.0 - tolerance && length < 1.0 + tolerance);
    }
};

/// From x, y, z, w at `values`, of any length but 0.
/// @param place  names node and key in the error
/// @throws InputError where all four are 0
UnitRotation read_rotation(const GltfReader& reader, const double* values, const std::string& place);

}  // namespace aleph
