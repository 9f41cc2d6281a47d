#pragma once
// The glTF reader's parts: each turns one kind of element into scene elements. Only gltf*.cpp use them.

#include <string>
#include <vector>

#include "engine/gltf_accessors.h"
#include "engine/gltf_source.h"
#include "engine/scene.h"

namespace aleph {

struct GltfReader {
    explicit GltfReader(const GltfSource& gltf) : source(gltf), accessors(gltf) {}

    const GltfSource& source;
    GltfAccessors accessors;
    Scene part;                               ///< what was read; indices count from its own elements
    std::vector<std::vector<int>> meshes_of;  ///< glTF mesh -> one scene mesh per primitive
    std::vector<int> node_of;                 ///< glTF node -> scene node, or no_index outside the scene

    void warn(const std::string& place, const std::string& text) {
        part.warnings.push_back(source.file + ": " + place + ": " + text);
    }
};

// In this order.
void read_materials(GltfReader& reader);
void read_meshes(GltfReader& reader);
void read_cameras_and_lights(GltfReader& reader);
void read_nodes(GltfReader& reader);
void read_animations(GltfReader& reader);

/// A quaternion made unit, and the length it had.
struct UnitRotation {
    glm::dquat rotation;
    double length = 1.0;

    bool was_far_from_unit() const { return !(length > 1.0 - 1e-3 && length < 1.0 + 1e-3); }
};

/// From x, y, z, w at `values`; of any length but 0, which is refused (HARD_CASES KF-04, KF-05).
/// @param place  names node and key in the error
UnitRotation read_rotation(const GltfReader& reader, const double* values, const std::string& place);

}  // namespace aleph
