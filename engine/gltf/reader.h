#pragma once
// The parts of the glTF reader: each reads one kind of element. Only this folder uses them.

#include <string>
#include <vector>

#include "engine/gltf/accessors.h"
#include "engine/gltf/source.h"
#include "engine/scene/scene.h"

namespace aleph {

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
