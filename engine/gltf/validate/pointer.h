#pragma once
// KHR_animation_pointer: the property that a JSON pointer names. Channels of nodes are named by the same pointers, so
// that every animated property has one name.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/gltf/validate/material_table.h"

namespace aleph {

enum class GltfProperty {
    node_translation,
    node_rotation,
    node_scale,
    node_weights,
    node_visible,
    camera_yfov,
    camera_xmag,  ///< the picture has its own width: it is not read
    camera_ymag,
    light_color,
    light_intensity,
    light_range,
    light_inner_cone,
    light_outer_cone,
    material_factor,  ///< GltfPropertyInfo::factor
};

/// The smallest field of view (radians), half height (m), range (m), attenuation distance (m) or cone (radians):
/// smaller keys are clamped to it. Below it the rays of neighbouring pixels are the same in single precision.
inline constexpr double min_gltf_size = 1e-6;

/// The kind of element that owns a property: the array whose length limits the pointer's index.
enum class GltfOwner { node, camera, light, material };

/// A property that can be animated, and what its keys must be.
struct GltfPropertyInfo {
    GltfProperty property;
    GltfOwner owner;
    std::string pointer;                 ///< "{}" stands for the owner's index
    std::string_view type;               ///< of the accessor
    double low, high;                    ///< keys beyond are clamped
    const GltfFactor* factor = nullptr;  ///< of a material
};

struct GltfPointer {
    const GltfPropertyInfo* info;
    std::size_t index;  ///< of the owner
};

/// The property that a pointer names; nothing where it cannot be animated or the pointer is malformed (an index with
/// leading zeros, say).
std::optional<GltfPointer> find_gltf_property(std::string_view pointer);

/// The property of a channel that names a node and a path; nothing for a path that glTF does not have.
std::optional<GltfPointer> find_node_property(std::size_t node, std::string_view path);

/// The pointer itself, "/nodes/3/translation".
std::string pointer_text(const GltfPointer& pointer);

}  // namespace aleph
