// Images, materials, lights and cameras of a scene file.

#include <fmt/format.h>

#include "engine/scene_file/reader.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

std::string read_path(const JsonRef& at) {
    if (const std::string fault = path_fault(at.string()); !fault.empty()) at.fail(fault);
    return at.string();
}

int add_image(SceneReader& reader, const JsonRef& at, const std::string& name) {
    reader.charge(sizeof(SceneImage) + 300, at, "it has too many images");
    SceneImage image{.name = name, .path = read_path(at)};
    reader.result.image_places.push_back(at.pointer());
    const int index = SceneReader::add(std::move(image), reader.scene.images, reader.names.images);
    reader.image_of_path.emplace(reader.scene.images[index].path, index);
    return index;
}

/// Reads an angle that stands under one of the field's two keys. @return its place; nothing where both are absent
template <class Element>
std::optional<JsonRef> read_angle(const JsonRef& at, const AngleField<Element>& field, const FrameRate& rate,
                                  Element& element) {
    auto degrees = at.find(field.key), radians = at.find(field.key_in_radians);
    if (degrees && radians) {
        radians->fail(fmt::format("either \"{}\" or \"{}\", not both", field.key, field.key_in_radians));
    }
    if (degrees) field.in(element) = read_degrees(*degrees, rate, field.range);
    if (radians) field.in(element) = read_number(*radians, rate, in_radians(field.range));
    return degrees ? degrees : radians;
}

template <class Fields, class Element>
void read_tracks(const JsonRef& at, const Fields& fields, const FrameRate& rate, Element& element) {
    for (const auto& field : fields) {
        const auto value = at.find(field.key);
        if (!value) continue;
        if constexpr (std::is_same_v<decltype(field.in(element)), Track<double>&>) {
            field.in(element) = read_number(*value, rate, field.range);
        } else {
            field.in(element) = read_vector(*value, rate, field.range);
        }
    }
}

TextureRef read_texture(SceneReader& reader, const JsonRef& at) {
    TextureRef texture;
    if (at.json().is_string()) {
        texture.image = read_image_use(reader, at);
        return texture;
    }
    texture.image = read_image_use(reader, at.require("image"));
    texture.uv_set = static_cast<int>(at.find_integer("uv_set", 0, 1).value_or(0));
    if (const auto wrap = at.find("wrap")) {
        const auto read = [](const JsonRef& word) { return read_word<Wrap>(word, wrap_words); };
        if (wrap->json().is_string()) {
            texture.wrap_u = texture.wrap_v = read(*wrap);
        } else {
            texture.wrap_u = read((*wrap)[0]);
            texture.wrap_v = read((*wrap)[1]);
        }
    }
    texture.nearest = at.find_string("filter").value_or("linear") == "nearest";
    if (const auto value = at.find("offset")) texture.uv_offset = read_dvec2(*value);
    if (const auto value = at.find("scale")) texture.uv_scale = read_dvec2(*value);
    const auto rotation = at.find("rotation"), radians = at.find("rotation_radians");
    if (rotation && radians) radians->fail("either \"rotation\" or \"rotation_radians\", not both");
    if (rotation) texture.uv_rotation = to_radians(rotation->number());
    if (radians) texture.uv_rotation = radians->number();
    return texture;
}

/// Calls add(reader, element, name) for the members of one of the root's objects, in the order of the file.
template <class Add>
void read_named(SceneReader& reader, const JsonRef& root, const KeyOrder& key_order, const char* kind, const Add& add) {
    const auto object = root.find(kind);
    if (!object || object->json().empty()) return;
    for (const std::string& name : key_order.at(kind)) add(reader, object->require(name), name);
}

void add_mesh(SceneReader& reader, const JsonRef& at, const std::string& name) {
    read_mesh(reader, at.require("shape"), at.find("material"), at.find("present"), name);
}

}  // namespace

int add_material(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.film.frame_rate;
    reader.charge(sizeof(Material) + 900, at, "let shapes share materials");
    Material material{.name = name};
    read_tracks(at, material_numbers, rate, material);
    read_tracks(at, material_colors, rate, material);
    for (const auto& field : material_angles) read_angle(at, field, rate, material);
    read_fields(at, material_scales, material);
    for (const auto& field : material_textures) {
        if (const auto value = at.find(field.key)) material.textures[field.slot] = read_texture(reader, *value);
    }
    if (const auto value = at.find("alpha_mode")) {
        material.opacity.mode = read_word<Opacity::Mode>(*value, alpha_words);
    }
    if (const auto value = at.find("alpha_cutoff")) {
        material.opacity.cutoff = value->number();
        if (material.opacity.mode != Opacity::Mode::mask) {
            value->fail("\"alpha_cutoff\" needs \"alpha_mode\": \"mask\"");
        }
    }
    if (const auto value = at.find("unlit")) material.unlit = value->boolean();
    if (const auto value = at.find("double_sided")) material.double_sided = value->boolean();
    return SceneReader::add(std::move(material), reader.scene.materials, reader.names.materials);
}

int add_light(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.film.frame_rate;
    reader.charge(sizeof(Light) + 300, at, "it has too many lights");
    Light light{.name = name};
    light.kind = read_word<Light::Kind>(at.require("type"), light_words);
    read_tracks(at, light_colors, rate, light);
    read_tracks(at, light_numbers, rate, light);
    const auto range = at.find("range");
    if (range && light.kind == Light::Kind::directional) range->fail("a directional light has no range");
    for (const auto& field : light_cones) {
        const auto angle = read_angle(at, field, rate, light);
        if (angle && light.kind != Light::Kind::spot) angle->fail("only a spot light has cones");
    }
    if (const char* fault = fault_of_cones(light)) at.fail(fault);
    return SceneReader::add(std::move(light), reader.scene.lights, reader.names.lights);
}

int add_camera(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.film.frame_rate;
    reader.charge(sizeof(Camera) + 400, at, "it has too many cameras");
    Camera camera{.name = name};
    for (const auto& field : camera_angles) read_angle(at, field, rate, camera);
    const auto orthographic = at.find("orthographic");
    if (orthographic) camera.orthographic = orthographic->boolean();
    read_tracks(at, camera_numbers, rate, camera);
    if (const auto value = at.find("half_height"); value && !orthographic) {
        value->fail("\"half_height\" needs \"orthographic\": true");
    }
    read_fields(at, camera_lengths, camera);
    if (const auto value = at.find("shutter")) {
        camera.shutter = read_dvec2(*value);
        if (camera.shutter.y < camera.shutter.x) value->fail("the shutter has to open before it closes");
    }
    return SceneReader::add(std::move(camera), reader.scene.cameras, reader.names.cameras);
}

std::string path_fault(std::string_view path) {
    if (path.empty()) return "the path is empty";
    for (const char c : path) {
        if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return "a path holds no control characters";
        if (c == '\\') return "a path has forward slashes, no backslashes";
    }
    if (path.front() == '/' || path.front() == '~') return "a path is relative to the scene file, not absolute";
    const auto scheme = path.substr(0, path.find('/')).find(':');
    return scheme == std::string_view::npos ? "" : "a path is relative to the scene file: no drives and no addresses";
}

int read_image_use(SceneReader& reader, const JsonRef& at) {
    if (const auto named = reader.names.images.find(at.string())) return *named;
    if (const auto known = reader.image_of_path.find(at.string()); known != reader.image_of_path.end())
        return known->second;
    return add_image(reader, at, at.string());
}

void read_elements(SceneReader& reader, const JsonRef& root, const KeyOrder& order) {
    read_named(reader, root, order, "images", add_image);
    read_named(reader, root, order, "materials", add_material);
    read_named(reader, root, order, "points", add_points);
    read_named(reader, root, order, "cages", add_cage);
    read_named(reader, root, order, "meshes", add_mesh);
    read_named(reader, root, order, "lights", add_light);
    read_named(reader, root, order, "cameras", add_camera);
}

}  // namespace aleph
