#include "engine/scene_file/scene_text.h"

#include <fmt/format.h>

#include <charconv>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "engine/json/text.h"
#include "engine/scene_file/guided_nodes.h"
#include "engine/scene_file/reader.h"
#include "engine/scene_file/schema.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

FrameRate read_frame_rate(const JsonRef& at) {
    if (!at.json().is_string()) return {at.integer(1, 1000000000), 1};
    const std::string& text = at.string();  // "30000/1001", by the schema
    const std::size_t slash = text.find('/');
    FrameRate rate;
    std::from_chars(text.data(), text.data() + slash, rate.numerator);
    std::from_chars(text.data() + slash + 1, text.data() + text.size(), rate.denominator);
    return rate;
}

std::int64_t read_frame(const JsonRef& list, std::size_t i) {
    return list[i].integer(-1000000000, 1000000000);
}

/// A name, or keys of frames and names. Whether the cameras exist is known when the includes are read.
void read_camera_choice(Scene& scene, const JsonRef& at) {
    if (at.json().is_string()) {
        scene.film.camera = at.string();
        return;
    }
    const JsonRef keys = at.require("keys");
    for (std::size_t i = 0; i < keys.array_size(); ++i) {
        const JsonRef key = keys[i], name = key[1];
        scene.film.camera_keys.push_back({read_frame(key, 0), name.string()});
        if (i > 0 && scene.film.camera_keys[i].frame <= scene.film.camera_keys[i - 1].frame)
            key.fail("key times have to ascend");
    }
}

void read_header(Scene& scene, const JsonRef& root) {
    scene.source.name = root.find_string("name").value_or("");
    if (const auto camera = root.find("camera")) read_camera_choice(scene, *camera);
    if (const auto fps = root.find("fps")) scene.film.frame_rate = read_frame_rate(*fps);
    if (const auto frames = root.find("frames")) {
        scene.film.range = FrameRange{read_frame(*frames, 0), read_frame(*frames, 1)};
        if (scene.film.range->last < scene.film.range->first) frames->fail("the last frame comes before the first");
    }
    if (const auto cuts = root.find("cuts")) {
        for (std::size_t i = 0; i < cuts->array_size(); ++i) {
            scene.film.cuts.push_back(read_frame(*cuts, i));
            if (i > 0 && scene.film.cuts[i] <= scene.film.cuts[i - 1]) (*cuts)[i].fail("cuts have to ascend");
        }
    }
    if (const auto viewing = root.find("viewing")) read_fields(*viewing, viewing_numbers, scene.film.viewing);
    if (const auto exposure = root.find("exposure")) scene.film.exposure = exposure->number();
    if (const auto value = root.find("environment")) {
        scene.environment.radiance = read_vector(*value, scene.film.frame_rate, environment_range);
    }
}

/// It may name one of the images, which are read before.
void read_environment_picture(SceneReader& reader, const JsonRef& root) {
    Scene& scene = reader.scene;
    const auto picture = root.find("environment_image");
    if (const auto rotation = root.find("environment_rotation")) {
        if (!picture) rotation->fail("\"environment_rotation\" turns \"environment_image\", which is not given");
        scene.environment.axis_rotation = read_axis_rotation(*rotation, scene.film.frame_rate);
        if (!scene.environment.axis_rotation)
            scene.environment.rotation = read_quaternion(*rotation, scene.film.frame_rate);
    }
    if (!picture) return;
    scene.environment.image = read_image_use(reader, *picture);
    if (!scene.environment.radiance) scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
}

void read_settings(Scene& scene, const JsonRef& root) {
    const auto settings = root.find("settings");
    if (!settings) return;
    for (const auto& setting : settings->json().items()) {
        const JsonRef value = settings->require(setting.key());
        if (value.json().is_boolean()) {
            scene.source.settings.emplace(setting.key(), value.boolean());
        } else if (value.json().is_string()) {
            scene.source.settings.emplace(setting.key(), value.string());
        } else {
            scene.source.settings.emplace(setting.key(), value.number());
        }
    }
}

/// A file of a later version gets its own message.
void check_version(const nlohmann::json& root, const std::string& file) {
    if (!root.is_object()) return;
    const auto version = root.find("aleph");
    if (version != root.end() && version->is_number_integer() && *version != 1) {
        throw InputError(file, "/aleph",
                         fmt::format("this is version {} of the format; version 1 is read", version->dump()));
    }
}

SceneText read_whole_text(std::string_view text, const std::string& file, const LoadLimits& limits) {
    JsonText parsed = parse_json_text(text, file, limits);
    check_version(parsed.root, file);
    replace_named_values(parsed.root, text, file, limits);
    check_scene_schema(parsed.root, file);
    const JsonRef root(parsed.root, file);

    SceneReader reader;
    reader.file = file;
    reader.limits = limits;
    read_header(reader.scene, root);
    read_elements(reader, root, parsed.key_order);
    read_environment_picture(reader, root);
    read_nodes(reader, root);
    read_includes(reader, root, no_index);
    read_settings(reader.scene, root);
    bake_guided_nodes(reader);
    make_meshes(reader);
    return std::move(reader.result);
}

}  // namespace

void NameIndex::add(const std::string& name, int index) {
    index_.emplace(name, index);
    names_.push_back(name);
}

std::string NameIndex::unused(const std::string& name) const {
    std::string candidate = name;
    for (int i = 2; index_.contains(candidate); ++i) candidate = fmt::format("{} {}", name, i);
    return candidate;
}

std::optional<int> NameIndex::find(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? std::nullopt : std::optional(found->second);
}

int NameIndex::require(const JsonRef& at, std::string_view advice) const {
    if (const auto found = find(at.string())) return *found;
    at.fail(fmt::format("there is no {} called \"{}\"{}{}", kind_, printable(at.string()),
                        suggestion(at.string(), names_), advice));
}

void SceneReader::charge(std::size_t bytes, const JsonRef& at, const char* advice) {
    memory += bytes;
    if (memory > limits.scene()) charge(0, at.pointer(), advice);
}

void SceneReader::charge(std::size_t bytes, const std::string& place, const char* advice) {
    memory += bytes;
    if (memory <= limits.scene()) return;
    throw InputError(file, place,
                     fmt::format("up to here the scene takes more than {} MiB; {}", limits.scene() >> 20, advice));
}

SceneText read_scene_text(std::string_view text, const std::string& file, const LoadLimits& limits) {
    try {
        return read_whole_text(text, file, limits);
    } catch (const InputError& error) {
        if (!error.place().starts_with('/') || text.find("\"named\"") == std::string_view::npos) throw;
        throw with_definition(error, parse_json_text(text, file, limits).root);
    }
}

}  // namespace aleph
