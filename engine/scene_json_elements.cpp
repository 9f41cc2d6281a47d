// Images, materials, meshes, lights and cameras of a scene file.

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "engine/close_names.h"
#include "engine/scene_json_reader.h"
#include "engine/scene_json_tracks.h"
#include "engine/shapes.h"

namespace aleph {

namespace {

template <class Words>
std::size_t read_word(const JsonRef& at, const Words& words) {
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (at.string() == words[i]) return i;
    }
    at.fail(fmt::format("unknown word \"{}\"", printable(at.string())));
}

std::string read_path(const JsonRef& at) {
    if (const std::string fault = path_fault(at.string()); !fault.empty()) at.fail(fault);
    return at.string();
}

int add_image(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const int index = static_cast<int>(reader.scene.images.size());
    SceneImage image;
    image.name = name;
    image.path = read_path(at);
    reader.images.add(name, index);
    reader.image_of_path.emplace(image.path, index);
    reader.scene.images.push_back(std::move(image));
    reader.result.image_places.push_back(at.pointer());
    return index;
}

int read_image_use(SceneReader& reader, const JsonRef& at) {
    if (const auto named = reader.images.find(at.string())) return *named;
    if (const auto known = reader.image_of_path.find(at.string()); known != reader.image_of_path.end())
        return known->second;
    return add_image(reader, at, at.string());
}

TextureRef read_texture(SceneReader& reader, const JsonRef& at) {
    TextureRef texture;
    if (at.json().is_string()) {
        texture.image = read_image_use(reader, at);
        return texture;
    }
    const JsonRef image = at.require("image");
    texture.image = read_image_use(reader, image);
    texture.uv_set = static_cast<int>(at.find_integer("uv_set", 0, 1).value_or(0));
    if (const auto wrap = at.find("wrap")) {
        const auto read = [](const JsonRef& word) { return static_cast<Wrap>(read_word(word, wrap_words)); };
        if (wrap->json().is_string()) {
            texture.wrap_u = texture.wrap_v = read(*wrap);
        } else {
            texture.wrap_u = read((*wrap)[0]);
            texture.wrap_v = read((*wrap)[1]);
        }
    }
    texture.nearest = at.find_string("filter").value_or("linear") == "nearest";
    return texture;
}

int add_material(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.frame_rate;
    Material material = absent_material();
    material.name = name;
    for (const auto& field : material_numbers) {
        if (const auto value = at.find(field.key)) material.*field.member = read_number(*value, rate, field.range);
    }
    for (const auto& field : material_colors) {
        if (const auto value = at.find(field.key)) material.*field.member = read_vector(*value, rate, field.range);
    }
    for (const auto& field : material_textures) {
        if (const auto value = at.find(field.key)) material.*field.member = read_texture(reader, *value);
    }
    if (const auto value = at.find("double_sided")) material.double_sided = value->boolean();
    reader.materials.add(name, static_cast<int>(reader.scene.materials.size()));
    reader.scene.materials.push_back(std::move(material));
    return static_cast<int>(reader.scene.materials.size()) - 1;
}

int add_light(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.frame_rate;
    Light light;
    light.name = name;
    const JsonRef type = at.require("type");
    light.kind = static_cast<Light::Kind>(read_word(type, light_words));
    if (const auto value = at.find("color")) light.color = read_vector(*value, rate, not_negative);
    if (const auto value = at.find("intensity")) light.intensity = read_number(*value, rate, not_negative);
    if (const auto value = at.find("range")) {
        light.range = value->number();
        if (light.kind == Light::Kind::directional) value->fail("a directional light has no range");
    }
    reader.lights.add(name, static_cast<int>(reader.scene.lights.size()));
    reader.scene.lights.push_back(std::move(light));
    return static_cast<int>(reader.scene.lights.size()) - 1;
}

int add_camera(SceneReader& reader, const JsonRef& at, const std::string& name) {
    const FrameRate& rate = reader.scene.frame_rate;
    Camera camera;
    camera.name = name;
    const auto fov = at.find("fov"), fov_radians = at.find("fov_radians"), orthographic = at.find("orthographic");
    if (fov && fov_radians) fov_radians->fail("either \"fov\" or \"fov_radians\", not both");
    if (fov) camera.fov = read_degrees(*fov, rate, field_of_view_degrees);
    if (fov_radians) camera.fov = read_number(*fov_radians, rate, {0.0, std::numbers::pi, true});
    if (orthographic) camera.orthographic = orthographic->boolean();
    for (const auto& field : camera_numbers) {
        if (const auto value = at.find(field.key)) camera.*field.member = read_number(*value, rate, field.range);
    }
    if (const auto value = at.find("half_height"); value && !orthographic) {
        value->fail("\"half_height\" needs \"orthographic\": true");
    }
    if (const auto value = at.find("near")) camera.near_plane = value->number();
    if (const auto value = at.find("shutter")) {
        camera.shutter = read_dvec2(*value);
        if (camera.shutter.y < camera.shutter.x) value->fail("the shutter has to open before it closes");
    }
    reader.cameras.add(name, static_cast<int>(reader.scene.cameras.size()));
    reader.scene.cameras.push_back(std::move(camera));
    return static_cast<int>(reader.scene.cameras.size()) - 1;
}

/// Keys that a kind of shape does not have would change nothing: most likely another kind was meant.
void check_shape_keys(const JsonRef& at, const Shape& shape) {
    const auto kind = static_cast<std::size_t>(shape.kind);
    for (const auto& member : at.json().items()) {
        const auto& known = shape_keys[kind];
        if (member.key() == "type" || std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
        const JsonRef value = at.require(member.key());
        value.fail(fmt::format("a {} has no \"{}\"", shape_words[kind], member.key()));
    }
    const bool flat = shape.kind == Shape::Kind::quad;
    if (const auto size = at.find("size"); size && size->array_size() != (flat ? 2u : 3u)) {
        size->fail(flat ? "the size of a quad is 2 numbers" : "the size of a box is 3 numbers");
    }
}

Shape read_shape(const JsonRef& at) {
    Shape shape;
    const JsonRef type = at.require("type");
    shape.kind = static_cast<Shape::Kind>(read_word(type, shape_words));
    check_shape_keys(at, shape);
    if (const auto value = at.find("size")) {
        const glm::dvec2 flat = read_dvec2(*value);
        shape.size = shape.kind == Shape::Kind::quad ? glm::dvec3(flat, 1.0) : read_dvec3(*value);
    }
    for (const auto& field : shape_numbers) {
        if (const auto value = at.find(field.key)) shape.*field.member = value->number();
    }
    if (const auto value = at.find("profile")) {
        for (std::size_t i = 0; i < value->array_size(); ++i) {
            const JsonRef point = (*value)[i];
            shape.profile.push_back(read_dvec2(point));
        }
    }
    if (const auto value = at.find("smooth")) shape.smooth = value->boolean();
    if (const auto value = at.find("uv_scale")) shape.uv_scale = read_dvec2(*value);
    if (const auto value = at.find_integer("segments", min_shape_segments, max_shape_segments)) {
        shape.segments = static_cast<int>(*value);
    }
    validate(shape, at.file(), at.pointer());
    return shape;
}

/// Calls add(element, name) for the members of one of the root's objects, in the order of the file.
template <class Add>
void read_named(const JsonRef& root, const KeyOrder& key_order, const char* kind, const Add& add) {
    const auto object = root.find(kind);
    if (!object || object->json().empty()) return;
    for (const std::string& name : key_order.at(kind)) {
        const JsonRef element = object->require(name);
        add(element, name);
    }
}

}  // namespace

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

int read_material_use(SceneReader& reader, const JsonRef& at, const std::string& name) {
    if (at.json().is_string()) return reader.materials.require(at);
    return add_material(reader, at, reader.materials.unused(name));
}

int read_light_use(SceneReader& reader, const JsonRef& at, const std::string& name) {
    if (at.json().is_string()) return reader.lights.require(at);
    return add_light(reader, at, reader.lights.unused(name));
}

int read_camera_use(SceneReader& reader, const JsonRef& at, const std::string& name) {
    if (at.json().is_string()) return reader.cameras.require(at);
    return add_camera(reader, at, reader.cameras.unused(name));
}

int read_shape_mesh(SceneReader& reader, const JsonRef& at, const std::optional<JsonRef>& material,
                    const std::string& name) {
    const Shape shape = read_shape(at);
    reader.shape_triangles += shape_triangle_count(shape);
    if (reader.shape_triangles > max_shape_triangles) {
        at.fail(
            fmt::format("with this shape there are more than {} triangles; lower \"segments\"", max_shape_triangles));
    }
    const int index = static_cast<int>(reader.scene.meshes.size());
    const int used = material ? read_material_use(reader, *material, name) : no_index;
    Mesh mesh;
    mesh.name = name;
    mesh.material = used;
    mesh.shape = shape;
    reader.scene.meshes.push_back(std::move(mesh));
    reader.meshes.add(name, index);
    return index;
}

void read_elements(SceneReader& reader, const JsonRef& root, const KeyOrder& order) {
    read_named(root, order, "images", [&](const JsonRef& at, const std::string& name) { add_image(reader, at, name); });
    read_named(root, order, "materials",
               [&](const JsonRef& at, const std::string& name) { add_material(reader, at, name); });
    read_named(root, order, "meshes", [&](const JsonRef& at, const std::string& name) {
        const JsonRef shape = at.require("shape");
        read_shape_mesh(reader, shape, at.find("material"), name);
    });
    read_named(root, order, "lights", [&](const JsonRef& at, const std::string& name) { add_light(reader, at, name); });
    read_named(root, order, "cameras",
               [&](const JsonRef& at, const std::string& name) { add_camera(reader, at, name); });
}

}  // namespace aleph
