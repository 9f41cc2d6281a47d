#include "engine/gltf/validate/pointer.h"

#include <fmt/format.h>

#include <array>
#include <limits>
#include <numbers>

namespace aleph {

namespace {

constexpr double unlimited = std::numeric_limits<double>::max();

constexpr std::array<GltfPropertyInfo, 30> properties = {{
    {GltfProperty::node_translation, GltfOwner::node, "/nodes/{}/translation", "VEC3", -unlimited, unlimited},
    {GltfProperty::node_rotation, GltfOwner::node, "/nodes/{}/rotation", "VEC4", -unlimited, unlimited},
    {GltfProperty::node_scale, GltfOwner::node, "/nodes/{}/scale", "VEC3", -unlimited, unlimited},
    {GltfProperty::node_weights, GltfOwner::node, "/nodes/{}/weights", "SCALAR", -unlimited, unlimited},
    {GltfProperty::node_visible, GltfOwner::node, "/nodes/{}/extensions/KHR_node_visibility/visible", "SCALAR", 0, 1},
    {GltfProperty::camera_yfov, GltfOwner::camera, "/cameras/{}/perspective/yfov", "SCALAR", min_gltf_size,
     std::numbers::pi - min_gltf_size},
    {GltfProperty::camera_ymag, GltfOwner::camera, "/cameras/{}/orthographic/ymag", "SCALAR", min_gltf_size, unlimited},
    {GltfProperty::light_color, GltfOwner::light, "/extensions/KHR_lights_punctual/lights/{}/color", "VEC3", 0,
     unlimited},
    {GltfProperty::light_intensity, GltfOwner::light, "/extensions/KHR_lights_punctual/lights/{}/intensity", "SCALAR",
     0, unlimited},
    {GltfProperty::light_range, GltfOwner::light, "/extensions/KHR_lights_punctual/lights/{}/range", "SCALAR",
     min_gltf_size, unlimited},
    {GltfProperty::light_inner_cone, GltfOwner::light, "/extensions/KHR_lights_punctual/lights/{}/spot/innerConeAngle",
     "SCALAR", 0, std::numbers::pi / 2},
    {GltfProperty::light_outer_cone, GltfOwner::light, "/extensions/KHR_lights_punctual/lights/{}/spot/outerConeAngle",
     "SCALAR", min_gltf_size, std::numbers::pi / 2},
    {GltfProperty::material_base_color, GltfOwner::material, "/materials/{}/pbrMetallicRoughness/baseColorFactor",
     "VEC4", 0, 1},
    {GltfProperty::material_metallic, GltfOwner::material, "/materials/{}/pbrMetallicRoughness/metallicFactor",
     "SCALAR", 0, 1},
    {GltfProperty::material_roughness, GltfOwner::material, "/materials/{}/pbrMetallicRoughness/roughnessFactor",
     "SCALAR", 0, 1},
    {GltfProperty::material_emission, GltfOwner::material, "/materials/{}/emissiveFactor", "VEC3", 0, 1},
    {GltfProperty::material_emission_strength, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_emissive_strength/emissiveStrength", "SCALAR", 0, unlimited},
    {GltfProperty::material_ior, GltfOwner::material, "/materials/{}/extensions/KHR_materials_ior/ior", "SCALAR", 1,
     unlimited},
    {GltfProperty::material_specular, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_specular/specularFactor", "SCALAR", 0, 1},
    {GltfProperty::material_specular_color, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_specular/specularColorFactor", "VEC3", 0, unlimited},
    {GltfProperty::material_transmission, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_transmission/transmissionFactor", "SCALAR", 0, 1},
    {GltfProperty::material_thickness, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_volume/thicknessFactor", "SCALAR", 0, unlimited},
    {GltfProperty::material_attenuation_distance, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_volume/attenuationDistance", "SCALAR", min_gltf_size, unlimited},
    {GltfProperty::material_attenuation_color, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_volume/attenuationColor", "VEC3", 0, 1},
    {GltfProperty::material_clearcoat, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_clearcoat/clearcoatFactor", "SCALAR", 0, 1},
    {GltfProperty::material_clearcoat_roughness, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_clearcoat/clearcoatRoughnessFactor", "SCALAR", 0, 1},
    {GltfProperty::material_sheen_color, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_sheen/sheenColorFactor", "VEC3", 0, 1},
    {GltfProperty::material_sheen_roughness, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_sheen/sheenRoughnessFactor", "SCALAR", 0, 1},
    {GltfProperty::material_anisotropy, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_anisotropy/anisotropyStrength", "SCALAR", 0, 1},
    {GltfProperty::material_anisotropy_rotation, GltfOwner::material,
     "/materials/{}/extensions/KHR_materials_anisotropy/anisotropyRotation", "SCALAR", -unlimited, unlimited},
}};

std::optional<std::size_t> parse_index(std::string_view digits) {
    if (digits.empty() || digits.size() > 9 || (digits.size() > 1 && digits[0] == '0')) return std::nullopt;
    std::size_t index = 0;
    for (const char c : digits) {
        if (c < '0' || c > '9') return std::nullopt;
        index = 10 * index + static_cast<std::size_t>(c - '0');
    }
    return index;
}

}  // namespace

std::optional<GltfPointer> find_gltf_property(std::string_view pointer) {
    for (const GltfPropertyInfo& info : properties) {
        const std::size_t gap = info.pointer.find("{}");
        const std::string_view before = info.pointer.substr(0, gap), after = info.pointer.substr(gap + 2);
        if (pointer.size() <= before.size() + after.size()) continue;
        if (pointer.substr(0, before.size()) != before) continue;
        if (pointer.substr(pointer.size() - after.size()) != after) continue;
        const std::string_view digits = pointer.substr(before.size(), pointer.size() - before.size() - after.size());
        if (const std::optional<std::size_t> index = parse_index(digits)) return GltfPointer{&info, *index};
    }
    return std::nullopt;
}

std::optional<GltfPointer> find_node_property(std::size_t node, std::string_view path) {
    if (path != "translation" && path != "rotation" && path != "scale" && path != "weights") return std::nullopt;
    return find_gltf_property(fmt::format("/nodes/{}/{}", node, path));
}

std::string pointer_text(const GltfPointer& pointer) {
    return fmt::format(fmt::runtime(pointer.info->pointer), pointer.index);
}

}  // namespace aleph
