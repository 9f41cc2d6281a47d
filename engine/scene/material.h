#pragma once
// Materials, and the images of their textures.

#include <array>
#include <cstdint>
#include <glm/gtc/type_precision.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <string>

#include "engine/base/image.h"
#include "engine/base/index.h"
#include "engine/scene/track.h"

namespace aleph {

/// A decoded picture. Eight bits a channel, or float for EXR and HDR and for the picture of the environment; one of the
/// two is empty.
struct SceneImage {
    std::string name{};
    std::string path{};  ///< relative to the scene file; empty where it was embedded
    Image<glm::u8vec4> bytes{};
    Image<glm::vec4> floats{};
    int include = no_index;

    bool operator==(const SceneImage&) const = default;
};

enum class Wrap { repeat, clamp, mirror };

struct TextureRef {
    int image = no_index;
    int uv_set = 0;
    Wrap wrap_u = Wrap::repeat;
    Wrap wrap_v = Wrap::repeat;
    bool nearest = false;  ///< no interpolation when magnified
    /// KHR_texture_transform: uv' = offset + R(rotation) (scale * uv), R counter-clockwise as glTF's v grows downwards.
    glm::dvec2 uv_offset{0.0};
    glm::dvec2 uv_scale{1.0};
    double uv_rotation = 0.0;  ///< radians

    bool operator==(const TextureRef&) const = default;
};

/// Texture coordinates of this size or more count as 0: beyond it, a float cannot hold fractions of a texel.
inline constexpr float max_texture_coordinate = 1e6f;

/// Textures of a material. Colours are sRGB, all else linear.
enum class TextureSlot : std::uint8_t {
    base_color,           ///< with alpha
    metallic_roughness,   ///< B metallic, G roughness
    emission,             ///< colour
    specular,             ///< A
    specular_color,       ///< colour
    transmission,         ///< R
    normal,               ///< tangent space; x along u, y against v, z outwards
    thickness,            ///< G
    clearcoat,            ///< R
    clearcoat_roughness,  ///< G
    clearcoat_normal,     ///< as `normal`, for the coat
    sheen_color,          ///< colour
    sheen_roughness,      ///< A
    anisotropy,           ///< RG direction, B strength
};

/// A texture of a material, and its key in scene files.
struct MaterialTexture {
    const char* key;
    TextureSlot slot;
};

/// In the order of the slots.
inline constexpr std::array material_textures{
    MaterialTexture{"base_color_texture", TextureSlot::base_color},
    MaterialTexture{"metallic_roughness_texture", TextureSlot::metallic_roughness},
    MaterialTexture{"emission_texture", TextureSlot::emission},
    MaterialTexture{"specular_texture", TextureSlot::specular},
    MaterialTexture{"specular_color_texture", TextureSlot::specular_color},
    MaterialTexture{"transmission_texture", TextureSlot::transmission},
    MaterialTexture{"normal_texture", TextureSlot::normal},
    MaterialTexture{"thickness_texture", TextureSlot::thickness},
    MaterialTexture{"clearcoat_texture", TextureSlot::clearcoat},
    MaterialTexture{"clearcoat_roughness_texture", TextureSlot::clearcoat_roughness},
    MaterialTexture{"clearcoat_normal_texture", TextureSlot::clearcoat_normal},
    MaterialTexture{"sheen_color_texture", TextureSlot::sheen_color},
    MaterialTexture{"sheen_roughness_texture", TextureSlot::sheen_roughness},
    MaterialTexture{"anisotropy_texture", TextureSlot::anisotropy},
};

/// Textures that hold colours.
constexpr bool is_color(TextureSlot slot) {
    return slot == TextureSlot::base_color || slot == TextureSlot::emission || slot == TextureSlot::specular_color ||
           slot == TextureSlot::sheen_color;
}

/// Textures that change normals.
constexpr bool is_normal_map(TextureSlot slot) {
    return slot == TextureSlot::normal || slot == TextureSlot::clearcoat_normal;
}

/// One value for each texture of a material.
template <class T>
struct TextureSlots {
    std::array<T, material_textures.size()> all{};

    T& operator[](TextureSlot slot) { return all[static_cast<std::size_t>(slot)]; }
    const T& operator[](TextureSlot slot) const { return all[static_cast<std::size_t>(slot)]; }
    bool operator==(const TextureSlots&) const = default;
};

// Groups of a material's properties: as tracks in a Material, as values at a time in MaterialValues (engine/pose).

/// The reflecting part: metal, and the dielectric's surface.
template <class Number, class Color>
struct GlossOf {
    Number metallic{0.0};
    Number roughness{1.0};
    Number specular{1.0};  ///< KHR_materials_specular: 0 is a pure Lambert surface
    Color specular_color{glm::dvec3(1.0)};
    Number ior{1.5};

    bool operator==(const GlossOf&) const = default;
};

/// Light that passes the surface.
template <class Number, class Color>
struct GlassOf {
    Number transmission{0.0};  ///< KHR_materials_transmission: share of light that passes the surface
    /// KHR_materials_volume. m, object space. Above 0: the mesh encloses a volume and light refracts; its value is not
    /// used further. 0: the surface is a thin sheet, which light passes straight.
    Number thickness{0.0};
    Number attenuation_distance{0.0};          ///< m, in which white becomes attenuation_color; 0: none
    Color attenuation_color{glm::dvec3(1.0)};  ///< of the volume, 0 to 1

    bool operator==(const GlassOf&) const = default;
};

/// Layers above the gloss, and how its lobe is stretched.
template <class Number, class Color>
struct LayersOf {
    Number clearcoat{0.0};  ///< KHR_materials_clearcoat: strength of the coat
    Number clearcoat_roughness{0.0};
    Color sheen_color{glm::dvec3(0.0)};  ///< KHR_materials_sheen
    Number sheen_roughness{0.0};
    Number anisotropy{0.0};           ///< KHR_materials_anisotropy: strength, 0 to 1
    Number anisotropy_rotation{0.0};  ///< radians, counter-clockwise from the tangent

    bool operator==(const LayersOf&) const = default;
};

using Gloss = GlossOf<Track<double>, Track<glm::dvec3>>;
using Glass = GlassOf<Track<double>, Track<glm::dvec3>>;
using Layers = LayersOf<Track<double>, Track<glm::dvec3>>;

/// Where the surface is.
struct Opacity {
    enum class Mode { opaque, mask, blend };
    Track<double> alpha{1.0};
    Mode mode = Mode::opaque;
    double cutoff = 0.5;  ///< mask: not there where alpha is below

    bool operator==(const Opacity&) const = default;
};

/// Radiance that the surface sends out.
struct Glow {
    Track<glm::dvec3> color{glm::dvec3(0.0)};
    Track<double> strength{1.0};  ///< KHR_materials_emissive_strength

    bool operator==(const Glow&) const = default;
};

/// Textures, and the factors on x and y of the normal maps.
struct MaterialImages : TextureSlots<TextureRef> {
    double normal_scale = 1.0;
    double clearcoat_normal_scale = 1.0;

    bool operator==(const MaterialImages&) const = default;
};

/// glTF 2.0 metallic-roughness. Unlike in glTF, `metallic` is 0 if not given: a colour alone means a plain surface.
struct Material {
    std::string name{};
    Track<glm::dvec3> base_color{glm::dvec3(1.0)};
    Opacity opacity{};
    Glow glow{};
    Gloss gloss{};
    Glass glass{};
    Layers layers{};
    MaterialImages textures{};
    bool unlit = false;         ///< KHR_materials_unlit: shows its base colour, takes and gives no light
    bool double_sided = false;  ///< lit and, where it emits, shining on both sides
    int include = no_index;

    bool operator==(const Material&) const = default;
};

}  // namespace aleph
