#pragma once
// Materials, and the images of their textures.

#include <array>
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

/// glTF 2.0 metallic-roughness, its defaults.
struct Material {
    std::string name{};
    Track<glm::dvec3> base_color{glm::dvec3(1.0)};
    Track<double> alpha{1.0};
    Track<double> metallic{1.0};
    Track<double> roughness{1.0};
    Track<glm::dvec3> emission{glm::dvec3(0.0)};  ///< radiance factor
    Track<double> emission_strength{1.0};         ///< KHR_materials_emissive_strength
    Track<double> specular{1.0};                  ///< KHR_materials_specular: 0 is a pure Lambert surface
    Track<glm::dvec3> specular_color{glm::dvec3(1.0)};
    Track<double> ior{1.5};
    Track<double> transmission{0.0};  ///< KHR_materials_transmission: share of light that passes the surface
    /// KHR_materials_volume. Above 0: the mesh encloses a volume and light refracts; its value is not used further.
    /// 0: the surface is a thin sheet, which light passes straight.
    Track<double> thickness{0.0};                          ///< m, object space
    Track<double> attenuation_distance{0.0};               ///< m, in which white becomes attenuation_color; 0: none
    Track<glm::dvec3> attenuation_color{glm::dvec3(1.0)};  ///< of the volume, 0 to 1
    Track<double> clearcoat{0.0};                          ///< KHR_materials_clearcoat: strength of the coat
    Track<double> clearcoat_roughness{0.0};
    Track<glm::dvec3> sheen_color{glm::dvec3(0.0)};  ///< KHR_materials_sheen
    Track<double> sheen_roughness{0.0};
    Track<double> anisotropy{0.0};           ///< KHR_materials_anisotropy: strength, 0 to 1
    Track<double> anisotropy_rotation{0.0};  ///< radians, counter-clockwise from the tangent
    double normal_scale = 1.0;               ///< factor on x and y of the normal map
    double clearcoat_normal_scale = 1.0;
    enum class AlphaMode { opaque, mask, blend };
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;                 ///< mask: not there where alpha is below
    bool unlit = false;                        ///< KHR_materials_unlit: shows its base colour, takes and gives no light
    TextureRef base_color_texture{};           ///< sRGB, with alpha
    TextureRef metallic_roughness_texture{};   ///< B metallic, G roughness, linear
    TextureRef emission_texture{};             ///< sRGB
    TextureRef specular_texture{};             ///< A, linear
    TextureRef specular_color_texture{};       ///< sRGB
    TextureRef transmission_texture{};         ///< R, linear
    TextureRef normal_texture{};               ///< tangent space, linear; x along u, y against v, z outwards
    TextureRef thickness_texture{};            ///< G, linear
    TextureRef clearcoat_texture{};            ///< R, linear
    TextureRef clearcoat_roughness_texture{};  ///< G, linear
    TextureRef clearcoat_normal_texture{};     ///< as normal_texture, for the coat
    TextureRef sheen_color_texture{};          ///< sRGB
    TextureRef sheen_roughness_texture{};      ///< A, linear
    TextureRef anisotropy_texture{};           ///< RG direction, B strength, linear
    bool double_sided = false;                 ///< lit and, where it emits, shining on both sides
    int include = no_index;

    bool operator==(const Material&) const = default;
};

/// A texture of a material, and its key in scene files.
struct MaterialTexture {
    const char* key;
    TextureRef Material::*member;
};

inline constexpr std::array material_textures{
    MaterialTexture{"base_color_texture", &Material::base_color_texture},
    MaterialTexture{"metallic_roughness_texture", &Material::metallic_roughness_texture},
    MaterialTexture{"emission_texture", &Material::emission_texture},
    MaterialTexture{"specular_texture", &Material::specular_texture},
    MaterialTexture{"specular_color_texture", &Material::specular_color_texture},
    MaterialTexture{"transmission_texture", &Material::transmission_texture},
    MaterialTexture{"normal_texture", &Material::normal_texture},
    MaterialTexture{"thickness_texture", &Material::thickness_texture},
    MaterialTexture{"clearcoat_texture", &Material::clearcoat_texture},
    MaterialTexture{"clearcoat_roughness_texture", &Material::clearcoat_roughness_texture},
    MaterialTexture{"clearcoat_normal_texture", &Material::clearcoat_normal_texture},
    MaterialTexture{"sheen_color_texture", &Material::sheen_color_texture},
    MaterialTexture{"sheen_roughness_texture", &Material::sheen_roughness_texture},
    MaterialTexture{"anisotropy_texture", &Material::anisotropy_texture},
};

}  // namespace aleph
