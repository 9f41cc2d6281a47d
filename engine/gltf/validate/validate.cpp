#include "engine/gltf/validate/validate.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <span>

#include "engine/base/errors.h"
#include "engine/gltf/validate/parts.h"

namespace aleph {

namespace {

constexpr std::array<std::string_view, 15> supported_extensions = {
    "EXT_mesh_gpu_instancing",    "KHR_animation_pointer",   "KHR_lights_punctual",
    "KHR_materials_anisotropy",   "KHR_materials_clearcoat", "KHR_materials_emissive_strength",
    "KHR_materials_ior",          "KHR_materials_sheen",     "KHR_materials_specular",
    "KHR_materials_transmission", "KHR_materials_unlit",     "KHR_materials_volume",
    "KHR_mesh_quantization",      "KHR_node_visibility",     "KHR_texture_transform"};

/// An extension that changes the look of things and is not supported, and what is missing without it.
struct MissingLook {
    std::string_view extension, missing;
};
constexpr std::array<MissingLook, 7> missing_looks = {{
    {"EXT_lights_image_based", "the light of its pictures"},
    {"KHR_materials_diffuse_transmission", "light that diffuses through thin surfaces"},
    {"KHR_materials_dispersion", "the separation of colours in refraction"},
    {"KHR_materials_iridescence", "the colours of thin films"},
    {"KHR_materials_pbrSpecularGlossiness", "its colours, with the metallic-roughness values of the file"},
    {"KHR_materials_variants", "its variants, with the materials of the primitives"},
    {"KHR_materials_volume_scatter", "the scattering of light inside volumes"},
}};

/// Compressed data is needed even where the file calls the extension optional.
constexpr std::array<std::string_view, 2> refused_extensions = {"EXT_meshopt_compression",
                                                                "KHR_draco_mesh_compression"};

bool contains(std::span<const std::string_view> names, std::string_view name) {
    return std::ranges::find(names, name) != names.end();
}

/// Names in all "extensions" objects of the document. "extras" are left out: applications may put anything there.
void collect_extensions(const nlohmann::json& value, std::set<std::string>& names) {
    if (value.is_array()) {
        for (const nlohmann::json& element : value) collect_extensions(element, names);
    } else if (value.is_object()) {
        for (const auto& [key, member] : value.items()) {
            if (key == "extras") continue;
            if (key == "extensions" && member.is_object()) {
                for (const auto& extension : member.items()) names.insert(extension.key());
            }
            collect_extensions(member, names);
        }
    }
}

void check_asset(const JsonRef& root) {
    const JsonRef asset = root.require("asset");
    const JsonRef version = asset.require("version");
    if (const std::string& text = version.string(); text.substr(0, 2) != "2.") {
        version.fail(fmt::format("glTF version \"{}\" is not supported, only 2.x", printable(text)));
    }
    if (const std::optional<JsonRef> version_needed = asset.find("minVersion");
        version_needed && version_needed->string() != "2.0") {
        version_needed->fail(
            fmt::format("the file needs glTF \"{}\", only 2.0 is supported", printable(version_needed->string())));
    }
}

}  // namespace

void expect_word(const JsonRef& at, std::initializer_list<std::string_view> words, std::string_view kind) {
    if (std::find(words.begin(), words.end(), at.string()) == words.end())
        at.fail(fmt::format("\"{}\" is no {}", printable(at.string()), kind));
}

void check_extensions(GltfCheck& check) {
    for (const char* const list : {"extensionsRequired", "extensionsUsed"}) {
        for_each_element(check.root, list, [&](const JsonRef& name, std::size_t) {
            if (name.string() == "KHR_mesh_quantization") check.is_quantized = true;
            if (list == std::string_view("extensionsRequired") && !contains(supported_extensions, name.string()))
                name.fail(fmt::format("the required extension {} is not supported", printable(name.string())));
        });
    }
    std::set<std::string> names;
    collect_extensions(check.root.json(), names);
    for (const std::string& name : names) {
        if (contains(refused_extensions, name)) {
            throw InputError(check.root.file(), "extensions", fmt::format("the extension {} is not supported", name));
        }
        if (contains(supported_extensions, name)) continue;
        const auto look = std::find_if(missing_looks.begin(), missing_looks.end(),
                                       [&](const MissingLook& missing) { return missing.extension == name; });
        check.warn(check.root, look == missing_looks.end()
                                   ? fmt::format("the extension {} is ignored", printable(name))
                                   : fmt::format("the extension {} is not supported: the file is rendered without {}",
                                                 name, look->missing));
    }
}

void validate_gltf(const JsonRef& root, bool has_binary_chunk, std::vector<std::string>& warnings) {
    root.expect_object();
    check_asset(root);
    GltfCheck check{root, has_binary_chunk, warnings};
    check_extensions(check);
    check_nodes(check);
    check_buffers(check);
    check_accessors(check);
    check_images(check);
    check_materials(check);
    check_cameras_and_lights(check);
    check_meshes(check);
    check_skins(check);
    check_animations(check);
}

}  // namespace aleph
