// Validator: materials, and cameras and lights.
#include <fmt/format.h>

#include <numbers>

#include "engine/gltf/validate/material_table.h"
#include "engine/gltf/validate/parts.h"
#include "engine/gltf/validate/pointer.h"

namespace aleph {

namespace {

void check_texture_info(const GltfCheck& check, const JsonRef& owner, std::string_view key) {
    const std::optional<JsonRef> info = owner.find(key);
    if (!info) return;
    info->expect_object();
    info->require("index").index(check.count("textures"), "texture");
    const ExtensionRef transform(*info, "KHR_texture_transform");
    if (transform) {
        transform->check_numbers("offset", 2);
        transform->check_number("rotation");
        transform->check_numbers("scale", 2);
    }
    const std::optional<JsonRef> given = info->find("texCoord");
    const std::optional<JsonRef> other = transform ? transform->find("texCoord") : std::nullopt;
    const std::int64_t own = given ? given->integer(0, 1 << 30) : 0;
    const std::int64_t used = other ? other->integer(0, 1 << 30) : own;
    if (used > 1 && key != "occlusionTexture")
        (other ? other : given)->fail("only texture coordinate sets 0 and 1 are supported");
}

/// Types, and ranges beyond which no value near is meant; the reader clamps factors.
void check_owner(const GltfCheck& check, std::string_view name, const JsonRef& owner) {
    owner.expect_object();
    for_each_of(gltf_factors(), name, [&](const GltfFactor& factor) {
        if (factor.is_color()) {
            owner.check_numbers(factor.key, factor.has_alpha ? 4 : 3);
        } else {
            owner.check_number(factor.key);
        }
    });
    for_each_of(gltf_textures(), name, [&](const GltfTexture& texture) {
        check_texture_info(check, owner, texture.key);
        const std::optional<JsonRef> info = owner.find(texture.key);
        if (info && texture.scale != nullptr) info->check_number("scale");
    });
}

/// Nothing is clipped here, but planes the wrong way round show that the file is broken.
void check_far_plane(const JsonRef& lens) {
    const std::optional<JsonRef> far = lens.find("zfar");
    const double near = lens.require("znear").number();
    if (far && !(far->number() > near)) far->fail(fmt::format("must lie beyond znear, found {}", far->number()));
}

void check_camera(const JsonRef& camera) {
    camera.find_string("name");
    const JsonRef type = camera.require("type");
    expect_word(type, {"perspective", "orthographic"}, "camera type");
    if (type.string() == "perspective") {
        const JsonRef lens = camera.require("perspective");
        const JsonRef yfov = lens.require("yfov");
        if (yfov.number_above(0.0) >= std::numbers::pi) yfov.fail("must be below pi");
        if (yfov.number() < min_gltf_size) {
            yfov.fail(fmt::format("must be at least {} radians, found {}", min_gltf_size, yfov.number()));
        }
        lens.require("znear").number_above(0.0);
        check_far_plane(lens);
        if (const std::optional<JsonRef> aspect = lens.find("aspectRatio")) aspect->number_above(0.0);
    } else {
        const JsonRef lens = camera.require("orthographic");
        for (const char* const key : {"xmag", "ymag"}) {
            const JsonRef size = lens.require(key);
            if (size.number() == 0.0) size.fail("must not be 0");
        }
        const JsonRef near = lens.require("znear");
        if (near.number() < 0.0) near.fail(fmt::format("must not be negative, found {}", near.number()));
        lens.require("zfar");
        check_far_plane(lens);
    }
}

void check_cone(const JsonRef& spot) {
    spot.expect_object();
    const std::optional<JsonRef> inner = spot.find("innerConeAngle"), outer = spot.find("outerConeAngle");
    constexpr double widest = std::numbers::pi / 2.0;
    const double outer_angle = outer ? outer->number_above(0.0) : std::numbers::pi / 4.0;
    if (outer_angle > static_cast<double>(static_cast<float>(widest))) {  // files hold floats
        outer->fail(fmt::format("must be at most a quarter turn, found {} radians", outer_angle));
    }
    const double inner_angle = inner ? inner->number() : 0.0;
    if (inner_angle < 0.0) inner->fail(fmt::format("must not be negative, found {}", inner_angle));
    if (inner_angle >= outer_angle) {
        spot.fail(fmt::format("the inner cone ({} radians) must be narrower than the outer one ({})", inner_angle,
                              outer_angle));
    }
}

void check_light(const JsonRef& light) {
    light.find_string("name");
    const JsonRef type = light.require("type");
    expect_word(type, {"point", "directional", "spot"}, "light type");
    light.check_numbers("color", 3);
    light.check_number("intensity");
    if (const std::optional<JsonRef> range = light.find("range")) range->number_above(0.0);
    if (type.string() == "spot") check_cone(light.require("spot"));
}

}  // namespace

void check_materials(GltfCheck& check) {
    for_each_object(check.root, "materials", [&](const JsonRef& material, std::size_t) {
        material.find_string("name");
        for (const char* const name : gltf_material_owners()) {
            if (is_gltf_extension(name)) {
                if (const ExtensionRef extension(material, name); extension) check_owner(check, name, *extension);
            } else if (*name == '\0') {
                check_owner(check, name, material);
            } else if (const std::optional<JsonRef> member = material.find(name)) {
                check_owner(check, name, *member);
            }
        }
        if (const ExtensionRef unlit(material, "KHR_materials_unlit"); unlit) unlit->expect_object();
        if (const ExtensionRef volume(material, "KHR_materials_volume"); volume) {
            if (const auto distance = volume->find("attenuationDistance")) distance->number_above(0.0);
        }
        check_texture_info(check, material, "occlusionTexture");
        material.check_boolean("doubleSided");
        if (const std::optional<JsonRef> cutoff = material.find("alphaCutoff"); cutoff && cutoff->number() < 0.0) {
            cutoff->fail(fmt::format("must not be negative, found {}", cutoff->number()));
        }
        if (const std::optional<JsonRef> mode = material.find("alphaMode"))
            expect_word(*mode, {"MASK", "BLEND", "OPAQUE"}, "alpha mode");
    });
}

void check_cameras_and_lights(GltfCheck& check) {
    for_each_object(check.root, "cameras", [&](const JsonRef& camera, std::size_t) { check_camera(camera); });
    if (const ExtensionRef lights(check.root, "KHR_lights_punctual"); lights) {
        for_each_object(*lights, "lights", [&](const JsonRef& light, std::size_t) { check_light(light); });
    }
}

}  // namespace aleph
