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

/// A decoded picture. Eight bits a channel, or float for EXR and HDR; one of the two is empty.
struct SceneImage {
    std::string name;
    std::string path;  ///< relative to the scene file; empty where it was embedded
    Image<glm::u8vec4> bytes;
    Image<glm::vec4> floats;
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
    std::string name;
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
    enum class AlphaMode { opaque, mask, blend };
    AlphaMode alpha_mode = AlphaMode::opaque;
    double alpha_cutoff = 0.5;              ///< mask: not there where alpha is below
    bool unlit = false;                     ///< KHR_materials_unlit: shows its base colour, takes and gives no light
    TextureRef base_color_texture;          ///< sRGB, with alpha
    TextureRef metallic_roughness_texture;  ///< B metallic, G roughness, linear
    TextureRef emission_texture;            ///< sRGB
    TextureRef specular_texture;            ///< A, linear
    TextureRef specular_color_texture;      ///< sRGB
    TextureRef transmission_texture;        ///< R, linear
    bool double_sided = false;              ///< lit and, where it emits, shining on both sides
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
};

}  // namespace aleph
