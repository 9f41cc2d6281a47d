#include "engine/gltf/validate/pointer.h"

#include <fmt/format.h>

#include <charconv>
#include <numbers>
#include <vector>

namespace aleph {

namespace {

std::vector<GltfPropertyInfo> list_properties() {
    using enum GltfProperty;
    const std::string lights = "/extensions/KHR_lights_punctual/lights/{}/";
    std::vector<GltfPropertyInfo> properties = {
        {node_translation, GltfOwner::node, "/nodes/{}/translation", "VEC3", -no_limit, no_limit},
        {node_rotation, GltfOwner::node, "/nodes/{}/rotation", "VEC4", -no_limit, no_limit},
        {node_scale, GltfOwner::node, "/nodes/{}/scale", "VEC3", -no_limit, no_limit},
        {node_weights, GltfOwner::node, "/nodes/{}/weights", "SCALAR", -no_limit, no_limit},
        {node_visible, GltfOwner::node, "/nodes/{}/extensions/KHR_node_visibility/visible", "SCALAR", 0, 1},
        {camera_yfov, GltfOwner::camera, "/cameras/{}/perspective/yfov", "SCALAR", min_gltf_size,
         std::numbers::pi - min_gltf_size},
        {camera_xmag, GltfOwner::camera, "/cameras/{}/orthographic/xmag", "SCALAR", min_gltf_size, no_limit},
        {camera_ymag, GltfOwner::camera, "/cameras/{}/orthographic/ymag", "SCALAR", min_gltf_size, no_limit},
        {light_color, GltfOwner::light, lights + "color", "VEC3", 0, no_limit},
        {light_intensity, GltfOwner::light, lights + "intensity", "SCALAR", 0, no_limit},
        {light_range, GltfOwner::light, lights + "range", "SCALAR", min_gltf_size, no_limit},
        {light_inner_cone, GltfOwner::light, lights + "spot/innerConeAngle", "SCALAR", 0, std::numbers::pi / 2},
        {light_outer_cone, GltfOwner::light, lights + "spot/outerConeAngle", "SCALAR", min_gltf_size,
         std::numbers::pi / 2},
    };
    for (const GltfFactor& factor : gltf_factors()) {
        const std::string pointer = "/materials/{}/" + gltf_owner_path(factor.owner) + factor.key;
        const char* const type = !factor.is_color() ? "SCALAR" : factor.has_alpha ? "VEC4" : "VEC3";
        properties.push_back({material_factor, GltfOwner::material, pointer, type, factor.low, factor.high, &factor});
    }
    return properties;
}

std::optional<std::size_t> parse_index(std::string_view digits) {
    if (digits.size() > 9 || (digits.size() > 1 && digits[0] == '0')) return std::nullopt;
    std::size_t index = 0;
    const char* const last = digits.data() + digits.size();
    const auto [end, error] = std::from_chars(digits.data(), last, index);
    return error == std::errc() && end == last ? std::optional(index) : std::nullopt;
}

}  // namespace

std::optional<GltfPointer> find_gltf_property(std::string_view pointer) {
    static const std::vector<GltfPropertyInfo> properties = list_properties();
    for (const GltfPropertyInfo& info : properties) {
        const std::size_t gap = info.pointer.find("{}");
        const std::string_view whole = info.pointer, before = whole.substr(0, gap), after = whole.substr(gap + 2);
        if (pointer.size() <= before.size() + after.size()) continue;
        if (!pointer.starts_with(before) || !pointer.ends_with(after)) continue;
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
