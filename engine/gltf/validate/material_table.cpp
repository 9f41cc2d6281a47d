#include "engine/gltf/validate/material_table.h"

#include <array>

#include "engine/gltf/validate/pointer.h"

namespace aleph {

namespace {

constexpr char core[] = "pbrMetallicRoughness", strength[] = "KHR_materials_emissive_strength",
               ior[] = "KHR_materials_ior", transmission[] = "KHR_materials_transmission",
               specular[] = "KHR_materials_specular", volume[] = "KHR_materials_volume",
               coat[] = "KHR_materials_clearcoat", sheen[] = "KHR_materials_sheen",
               anisotropy[] = "KHR_materials_anisotropy";
constexpr std::array owners{core, "", strength, ior, transmission, specular, volume, coat, sheen, anisotropy};

template <auto... path>
constexpr GltfFactor number(const char* owner, const char* key, double low, double high, bool takes_zero = false) {
    return {owner, key, low, high, {at<path...>}, {}, false, takes_zero};
}
template <auto... path>
constexpr GltfFactor color(const char* owner, const char* key, double high, bool has_alpha = false) {
    return {owner, key, 0.0, high, {}, {at<path...>}, has_alpha};
}

constexpr std::array factors{
    color<&Material::glow, &Glow::color>("", "emissiveFactor", 1),
    color<&Material::base_color>(core, "baseColorFactor", 1, true),
    number<&Material::gloss, &Gloss::metallic>(core, "metallicFactor", 0, 1),
    number<&Material::gloss, &Gloss::roughness>(core, "roughnessFactor", 0, 1),
    number<&Material::glow, &Glow::strength>(strength, "emissiveStrength", 0, no_limit),
    number<&Material::gloss, &Gloss::ior>(ior, "ior", 1, no_limit, true),  // 0: full reflection
    number<&Material::glass, &Glass::transmission>(transmission, "transmissionFactor", 0, 1),
    number<&Material::gloss, &Gloss::specular>(specular, "specularFactor", 0, 1),
    color<&Material::gloss, &Gloss::specular_color>(specular, "specularColorFactor", no_limit),
    number<&Material::glass, &Glass::thickness>(volume, "thicknessFactor", 0, no_limit),
    number<&Material::glass, &Glass::attenuation_distance>(volume, "attenuationDistance", min_gltf_size, no_limit),
    color<&Material::glass, &Glass::attenuation_color>(volume, "attenuationColor", 1),
    number<&Material::layers, &Layers::clearcoat>(coat, "clearcoatFactor", 0, 1),
    number<&Material::layers, &Layers::clearcoat_roughness>(coat, "clearcoatRoughnessFactor", 0, 1),
    color<&Material::layers, &Layers::sheen_color>(sheen, "sheenColorFactor", 1),
    number<&Material::layers, &Layers::sheen_roughness>(sheen, "sheenRoughnessFactor", 0, 1),
    number<&Material::layers, &Layers::anisotropy>(anisotropy, "anisotropyStrength", 0, 1),
    number<&Material::layers, &Layers::anisotropy_rotation>(anisotropy, "anisotropyRotation", -no_limit, no_limit),
};

constexpr std::array textures{
    GltfTexture{core, "baseColorTexture", TextureSlot::base_color},
    GltfTexture{core, "metallicRoughnessTexture", TextureSlot::metallic_roughness},
    GltfTexture{"", "normalTexture", TextureSlot::normal, &MaterialImages::normal_scale},
    GltfTexture{"", "emissiveTexture", TextureSlot::emission},
    GltfTexture{transmission, "transmissionTexture", TextureSlot::transmission},
    GltfTexture{specular, "specularTexture", TextureSlot::specular},
    GltfTexture{specular, "specularColorTexture", TextureSlot::specular_color},
    GltfTexture{volume, "thicknessTexture", TextureSlot::thickness},
    GltfTexture{coat, "clearcoatTexture", TextureSlot::clearcoat},
    GltfTexture{coat, "clearcoatRoughnessTexture", TextureSlot::clearcoat_roughness},
    GltfTexture{coat, "clearcoatNormalTexture", TextureSlot::clearcoat_normal, &MaterialImages::clearcoat_normal_scale},
    GltfTexture{sheen, "sheenColorTexture", TextureSlot::sheen_color},
    GltfTexture{sheen, "sheenRoughnessTexture", TextureSlot::sheen_roughness},
    GltfTexture{anisotropy, "anisotropyTexture", TextureSlot::anisotropy},
};

}  // namespace

std::span<const char* const> gltf_material_owners() {
    return owners;
}

std::span<const GltfFactor> gltf_factors() {
    return factors;
}

std::span<const GltfTexture> gltf_textures() {
    return textures;
}

bool is_gltf_extension(std::string_view owner) {
    return owner.starts_with("KHR_");
}

std::string gltf_owner_path(std::string_view owner) {
    if (owner.empty()) return {};
    return (is_gltf_extension(owner) ? "extensions/" : "") + std::string(owner) + "/";
}

Material make_gltf_material() {
    return {.gloss = {.metallic = 1.0}};
}

}  // namespace aleph
