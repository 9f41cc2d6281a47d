#include "engine/scene_file/write_elements.h"

#include <algorithm>

#include "engine/scene_file/lists.h"
#include "engine/scene_file/reader.h"
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

ordered_json write_samples_of_points(const TimeSampling& sampling, const std::vector<std::vector<glm::vec3>>& samples,
                                     const FrameRate& rate) {
    std::vector<ordered_json> values;
    for (const auto& sample : samples) values.push_back(write_vectors(sample));
    return write_samples(sampling, rate, std::move(values));
}

/// A list cut into consecutive lists of the given lengths.
ordered_json write_runs(const std::vector<int>& lengths, const std::vector<int>& values) {
    ordered_json out = ordered_json::array();
    auto begin = values.begin();
    for (const int length : lengths) {
        out.push_back(std::vector<int>(begin, begin + length));
        begin += length;
    }
    return out;
}

template <class Words, class Word>
void write_word(ordered_json& out, const char* key, const Words& words, Word word, Word absent) {
    if (word != absent) out[key] = words[index_of(word)];
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
    at.tracks(out, material, absent, material_colors, write_vector);
    at.tracks(out, material, absent, material_numbers, write_number);
    at.angles(out, material, absent, material_angles);
    at.fields(out, material, absent, material_scales);
    for (const auto& field : material_textures) {
        if (material.textures[field.slot].image != no_index)
            out[field.key] = write_texture(at, material.textures[field.slot]);
    }
    write_word(out, "alpha_mode", alpha_words, material.opacity.mode, absent.opacity.mode);
    if (material.opacity.cutoff != absent.opacity.cutoff) out["alpha_cutoff"] = material.opacity.cutoff;
    if (material.unlit) out["unlit"] = true;
    if (material.double_sided) out["double_sided"] = true;
    return out;
}

ordered_json write_light(const SceneWriting& at, const Light& light) {
    const Light absent;
    ordered_json out = {{"type", light_words[index_of(light.kind)]}};
    at.tracks(out, light, absent, light_colors, write_vector);
    at.tracks(out, light, absent, light_numbers, write_number);
    at.angles(out, light, absent, light_cones);
    return out;
}

ordered_json write_camera(const SceneWriting& at, const Camera& camera) {
    const Camera absent;
    ordered_json out = ordered_json::object();
    at.angles(out, camera, absent, camera_angles);
    if (camera.orthographic || camera.half_height != absent.half_height) out["orthographic"] = camera.orthographic;
    at.tracks(out, camera, absent, camera_numbers, write_number);
    at.fields(out, camera, absent, camera_lengths);
    if (camera.shutter != absent.shutter) out["shutter"] = {camera.shutter.x, camera.shutter.y};
    return out;
}

ordered_json write_points(const PointCache& cache, const FrameRate& rate) {
    if (cache.positions.size() == 1 && cache.sampling == TimeSampling{}) return write_vectors(cache.positions.front());
    return write_samples_of_points(cache.sampling, cache.positions, rate);
}

ordered_json write_shape(const Shape& shape) {
    const Shape absent;
    const auto kind = index_of(shape.kind);
    const auto has = [&](const char* key) {
        return std::find(shape_keys[kind].begin(), shape_keys[kind].end(), key) != shape_keys[kind].end();
    };
    ordered_json out = {{"type", shape_words[kind]}};
    if (has("size") && shape.size != absent.size) {
        out["size"] = write_dvec3(shape.size);
        if (shape.kind == Shape::Kind::quad) out["size"].erase(2);
    }
    for (const auto& field : shape_numbers) {
        if (has(field.key) && field.in(shape) != field.in(absent)) out[field.key] = field.in(shape);
    }
    for (const glm::dvec2& point : shape.profile) out["profile"].push_back({point.x, point.y});
    if (shape.smooth != absent.smooth) out["smooth"] = shape.smooth;
    if (has("segments") && shape.segments != absent.segments) out["segments"] = shape.segments;
    if (shape.uv_scale != absent.uv_scale) out["uv_scale"] = {shape.uv_scale.x, shape.uv_scale.y};
    return out;
}

ordered_json write_cage(const Cage& cage, const std::string& points) {
    const Cage absent;
    ordered_json out = {{"points", points}};
    write_word(out, "scheme", scheme_words, cage.scheme, absent.scheme);
    write_word(out, "boundary", boundary_words, cage.boundary, absent.boundary);
    write_word(out, "uv_rule", uv_rule_words, cage.uv_rule, absent.uv_rule);
    if (cage.level != absent.level) out["level"] = cage.level;
    if (cage.max_level != absent.max_level) out["max_level"] = cage.max_level;
    out["faces"] = write_runs(cage.faces.sizes, cage.faces.points);
    const ordered_json chains = write_runs(cage.creases.lengths, cage.creases.points);
    for (std::size_t i = 0; i < chains.size(); ++i) {
        out["creases"].push_back({{"points", chains[i]}, {"sharpness", widen(cage.creases.sharpness[i])}});
    }
    for (std::size_t i = 0; i < cage.corners.points.size(); ++i) {
        out["corners"].push_back({{"point", cage.corners.points[i]}, {"sharpness", widen(cage.corners.sharpness[i])}});
    }
    if (!cage.faces.holes.empty()) out["holes"] = cage.faces.holes;
    if (!cage.uv.empty()) out["uv"] = write_vectors(cage.uv);
    if (!cage.faces.uv.empty() && cage.faces.uv != cage.faces.points) {
        out["face_uv"] = write_runs(cage.faces.sizes, cage.faces.uv);
    }
    if (!cage.faces.parts.empty()) out["parts"] = cage.faces.parts;
    return out;
}

ordered_json write_triangles(const Mesh& mesh, const PointCache* cache, const FrameRate& rate) {
    ordered_json out = {{"type", "mesh"}};
    if (cache != nullptr) {
        out["points"] = cache->name;
        if (!mesh.deformation.vertex_points.empty()) out["vertex_points"] = mesh.deformation.vertex_points;
    }
    if (cache == nullptr || first_positions(mesh, *cache) != mesh.positions) {
        out["positions"] = write_vectors(mesh.positions);
    }
    ordered_json::array_t triangles;
    triangles.reserve(3 * mesh.triangles.size());
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int i = 0; i < 3; ++i) triangles.emplace_back(triangle[i]);
    }
    out["triangles"] = std::move(triangles);
    if (!mesh.deformation.normal_samples.empty()) {
        out["normals"] =
            write_samples_of_points(mesh.deformation.normal_sampling, mesh.deformation.normal_samples, rate);
    } else if (!mesh.normals.empty()) {
        out["normals"] = write_vectors(mesh.normals);
    }
    if (!mesh.uv[0].empty()) out["uv"] = write_vectors(mesh.uv[0]);
    if (!mesh.uv[1].empty()) out["uv1"] = write_vectors(mesh.uv[1]);
    if (!mesh.colors.empty()) out["colors"] = write_vectors(mesh.colors);
    return out;
}

}  // namespace aleph
