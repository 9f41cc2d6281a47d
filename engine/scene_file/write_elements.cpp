#include "engine/scene_file/write_elements.h"

#include "engine/scene_file/tracks.h"

namespace aleph {

using nlohmann::ordered_json;

namespace {

ordered_json write_texture(const SceneWriting& at, const TextureRef& texture) {
    ordered_json out = at.name_in(at.scene.images, texture.image, "image");
    if (texture == TextureRef{.image = texture.image}) return out;
    out = {{"image", out}};
    if (texture.uv_set != 0) out["uv_set"] = texture.uv_set;
    const auto word = [](Wrap wrap) { return wrap_words[index_of(wrap)]; };
    if (texture.wrap_u != texture.wrap_v) {
        out["wrap"] = {word(texture.wrap_u), word(texture.wrap_v)};
    } else if (texture.wrap_u != Wrap::repeat) {
        out["wrap"] = word(texture.wrap_u);
    }
    if (texture.nearest) out["filter"] = "nearest";
    if (texture.uv_offset != glm::dvec2(0.0)) out["offset"] = {texture.uv_offset.x, texture.uv_offset.y};
    if (texture.uv_scale != glm::dvec2(1.0)) out["scale"] = {texture.uv_scale.x, texture.uv_scale.y};
    if (texture.uv_rotation != 0.0) {
        const auto degrees = exact_degrees(texture.uv_rotation);
        out[degrees ? "rotation" : "rotation_radians"] = degrees.value_or(texture.uv_rotation);
    }
    return out;
}

}  // namespace

void SceneWriting::angle(ordered_json& out, const char* degrees_key, const char* radians_key,
                         const Track<double>& value) const {
    validate(value, file, place + " " + degrees_key);
    if (const auto degrees = write_degrees(value, rate())) {
        out[degrees_key] = *degrees;
    } else {
        out[radians_key] = write_number(value, rate());
    }
}

void SceneWriting::rotation(ordered_json& out, const char* key, const Track<glm::dquat>& value,
                            const std::optional<AxisRotation>& about_axis) const {
    if (about_axis) {
        out[key]["axis"] = write_dvec3(about_axis->axis);
        angle(out[key], "degrees", "radians", about_axis->angle);
    } else {
        track(out, key, value, Node{}.transform.rotation, write_quaternion);
    }
}

ordered_json write_material(const SceneWriting& at, const Material& material) {
    const Material absent;
    ordered_json out = ordered_json::object();
    for (const auto& field : material_colors) {
        at.track(out, field.key, field.in(material), field.in(absent), write_vector);
    }
    for (const auto& field : material_numbers) {
        at.track(out, field.key, field.in(material), field.in(absent), write_number);
    }
    at.angles(out, material, absent, material_angles);
    for (const auto& field : material_scales) {
        if (field.in(material) != field.in(absent)) out[field.key] = field.in(material);
    }
    for (const auto& field : material_textures) {
        if (material.textures[field.slot].image != no_index)
            out[field.key] = write_texture(at, material.textures[field.slot]);
    }
    if (material.opacity.mode != absent.opacity.mode) {
        out["alpha_mode"] = alpha_words[index_of(material.opacity.mode)];
    }
    if (material.opacity.cutoff != absent.opacity.cutoff) out["alpha_cutoff"] = material.opacity.cutoff;
    if (material.unlit) out["unlit"] = true;
    if (material.double_sided) out["double_sided"] = true;
    return out;
}

ordered_json write_light(const SceneWriting& at, const Light& light) {
    const Light absent;
    ordered_json out = {{"type", light_words[index_of(light.kind)]}};
    at.track(out, "color", light.color, absent.color, write_vector);
    at.track(out, "intensity", light.intensity, absent.intensity, write_number);
    at.track(out, "range", light.range, absent.range, write_number);
    at.angles(out, light, absent, light_cones);
    return out;
}

ordered_json write_camera(const SceneWriting& at, const Camera& camera) {
    const Camera absent;
    ordered_json out = ordered_json::object();
    at.angles(out, camera, absent, camera_angles);
    if (camera.orthographic || camera.half_height != absent.half_height) out["orthographic"] = camera.orthographic;
    for (const auto& field : camera_numbers) {
        at.track(out, field.key, field.in(camera), field.in(absent), write_number);
    }
    if (camera.near_plane != absent.near_plane) out["near"] = camera.near_plane;
    if (camera.shutter != absent.shutter) out["shutter"] = {camera.shutter.x, camera.shutter.y};
    return out;
}

}  // namespace aleph
