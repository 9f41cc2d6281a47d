// Validator: materials, and cameras and lights.
#include <fmt/format.h>

#include <numbers>

#include "engine/base/errors.h"
#include "engine/gltf_validate_parts.h"

namespace aleph {

namespace {

void check_texture_info(const GltfCheck& check, const JsonRef& owner, std::string_view key) {
    const std::optional<JsonRef> info = owner.find(key);
    if (!info) return;
    info->expect_object();
    const JsonRef index = info->require("index");
    index.index(check.counts.textures, "texture");
    if (const std::optional<JsonRef> set = info->find("texCoord"); set && set->integer(0, 1 << 30) > 1) {
        set->fail("only texture coordinate sets 0 and 1 are supported");
    }
}

void check_material_extensions(const GltfCheck& check, const JsonRef& material) {
    if (const ExtensionRef strength(material, "KHR_materials_emissive_strength"); strength) {
        strength->check_number("emissiveStrength");
    }
    if (const ExtensionRef ior(material, "KHR_materials_ior"); ior) ior->check_number("ior");
    if (const ExtensionRef specular(material, "KHR_materials_specular"); specular) {
        specular->check_number("specularFactor");
        specular->check_numbers("specularColorFactor", 3);
        check_texture_info(check, *specular, "specularTexture");
        check_texture_info(check, *specular, "specularColorTexture");
    }
}

void check_camera(const JsonRef& camera) {
    camera.find_string("name");
    const JsonRef type = camera.require("type");
    if (type.string() == "perspective") {
        const JsonRef lens = camera.require("perspective");
        const JsonRef yfov = lens.require("yfov");
        if (yfov.number_above(0.0) >= std::numbers::pi) yfov.fail("must be below pi");
        lens.require("znear").number_above(0.0);
        lens.check_number("zfar");
        lens.check_number("aspectRatio");
    } else if (type.string() == "orthographic") {
        const JsonRef lens = camera.require("orthographic");
        lens.require("xmag").number();
        lens.require("ymag").number_above(0.0);
        lens.require("znear").number();
        lens.require("zfar").number();
    } else {
        type.fail(fmt::format("\"{}\" is no camera type", printable(type.string())));
    }
}

void check_light(const JsonRef& light) {
    light.find_string("name");
    const JsonRef type = light.require("type");
    if (type.string() == "spot") type.fail("spot lights are not supported");
    if (type.string() != "point" && type.string() != "directional") {
        type.fail(fmt::format("\"{}\" is no light type", printable(type.string())));
    }
    light.check_numbers("color", 3);
    light.check_number("intensity");
    if (const std::optional<JsonRef> range = light.find("range")) range->number_above(0.0);
}

}  // namespace

void check_materials(GltfCheck& check) {
    for_each_object(check.root, "materials", [&](const JsonRef& material, std::size_t) {
        material.find_string("name");
        if (const std::optional<JsonRef> pbr = material.find("pbrMetallicRoughness")) {
            pbr->expect_object();
            pbr->check_numbers("baseColorFactor", 4);
            pbr->check_number("metallicFactor");
            pbr->check_number("roughnessFactor");
            check_texture_info(check, *pbr, "baseColorTexture");
            check_texture_info(check, *pbr, "metallicRoughnessTexture");
        }
        material.check_numbers("emissiveFactor", 3);
        check_texture_info(check, material, "emissiveTexture");
        check_texture_info(check, material, "normalTexture");
        check_texture_info(check, material, "occlusionTexture");
        material.check_boolean("doubleSided");
        material.check_number("alphaCutoff");
        if (const std::optional<JsonRef> mode = material.find("alphaMode")) {
            const std::string& name = mode->string();
            if (name == "MASK" || name == "BLEND") {
                check.warn(*mode, fmt::format("alpha mode {} is not supported, the material counts as opaque", name));
            } else if (name != "OPAQUE") {
                mode->fail(fmt::format("\"{}\" is no alpha mode", printable(name)));
            }
        }
        check_material_extensions(check, material);
    });
}

void check_cameras_and_lights(GltfCheck& check) {
    for_each_object(check.root, "cameras", [&](const JsonRef& camera, std::size_t) { check_camera(camera); });
    if (const ExtensionRef lights(check.root, "KHR_lights_punctual"); lights) {
        for_each_object(*lights, "lights", [&](const JsonRef& light, std::size_t) { check_light(light); });
    }
}

}  // namespace aleph
