#pragma once
// The factors and textures of glTF materials, a row each: the validator checks them, the reader reads them, animations
// move them and the writer writes them. An extension whose properties are numbers, colours and textures is added here.

#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "engine/scene/material.h"
#include "engine/scene/place.h"

namespace aleph {

inline constexpr double no_limit = std::numeric_limits<double>::max();

/// A number or a colour.
struct GltfFactor {
    const char* owner;  ///< object that has it: "" the material, "KHR_..." its extension, else a member
    const char* key;
    double low, high;  ///< values beyond are clamped
    // Where a scene keeps it, one of the two.
    Place<Material, Track<double>> number{};
    Place<Material, Track<glm::dvec3>> color{};
    bool has_alpha = false;   ///< a fourth number: the material's opacity
    bool takes_zero = false;  ///< 0 has a meaning of its own, below `low`

    bool is_color() const { return color.find != nullptr; }
};

/// A texture.
struct GltfTexture {
    const char* owner;
    const char* key;
    TextureSlot slot;
    double MaterialImages::*scale = nullptr;  ///< of a normal map
};

/// In the order in which they are read.
std::span<const char* const> gltf_material_owners();
std::span<const GltfFactor> gltf_factors();
std::span<const GltfTexture> gltf_textures();

bool is_gltf_extension(std::string_view owner);
/// An owner's place within a material, with a slash behind it: "", "pbrMetallicRoughness/", "extensions/KHR_.../".
std::string gltf_owner_path(std::string_view owner);

/// The material of a file that says nothing of it: metal.
Material make_gltf_material();

/// Calls visit for the rows of an owner.
template <class Row, class Visit>
void for_each_of(std::span<const Row> rows, std::string_view owner, const Visit& visit) {
    for (const Row& row : rows)
        if (row.owner == owner) visit(row);
}

}  // namespace aleph
