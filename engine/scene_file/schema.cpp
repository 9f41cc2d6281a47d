#include "engine/scene_file/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>
#include <vector>

#include "engine/base/errors.h"

namespace aleph {

using nlohmann::json;

namespace {

constexpr const char* schema_text =
#include "scene_schema.inc"
    ;

/// Takes {"named": ...} out of the alternatives: when a document is checked, the values stand in its places.
void remove_named_uses(json& schema) {
    if (!schema.is_structured()) return;
    for (json& inner : schema) remove_named_uses(inner);
    if (!schema.is_object() || !schema.contains("anyOf") || !schema["anyOf"].is_array()) return;
    auto& alternatives = schema["anyOf"].get_ref<json::array_t&>();
    const json use{{"$ref", "#/definitions/named_use"}};
    if (std::erase(alternatives, use) == 0 || alternatives.size() != 1) return;
    json only = alternatives.front();
    schema.erase("anyOf");
    only.update(schema);
    schema = std::move(only);
}

json schema_of_values() {
    json schema = scene_schema();
    remove_named_uses(schema);
    return schema;
}

struct Advice {
    std::vector<std::string_view> words;  ///< unknown keys, or texts that were found
    std::string_view text;
    std::string_view list{};  ///< first key of the place; empty: any
};

constexpr std::string_view about_rotation =
    "a rotation is {\"axis\": [0, 1, 0], \"degrees\": 90} or a quaternion x, y, z, w; for angles about x, y and z "
    "write "
    "\"operations\": [{\"rotate_z\": 0}, {\"rotate_y\": 90}, {\"rotate_x\": 0}]";
constexpr std::string_view about_keys = "keys are written as {\"keys\": [[0, ...], [10, ...]]}";
constexpr std::string_view about_lengths =
    "a sphere, cylinder or torus has a \"radius\", a quad [x, y], a box [x, y, z]";

const std::vector<Advice>& unknown_keys() {
    static const std::vector<Advice> table{
        {{"position", "location"}, "a node's place is \"translation\": [x, y, z]"},
        {{"rotate", "euler", "orientation"}, about_rotation},
        {{"look_at", "lookat", "target"},
         "a camera looks along -z of its node; \"look_at\" of the node, beside \"camera\", turns it"},
        {{"path", "motion_path"}, "a node moves along \"follow_path\": {\"points\": [...], \"at\": ...}"},
        {{"easing", "ease"}, "between keys, easing is \"interpolation\": \"ease\" or \"smooth\""},
        {{"color", "diffuse", "colour", "albedo"}, "the colour of a material is \"base_color\""},
        {{"emissive"}, "a material gives light with \"emission\": [r, g, b], in cd/m2"},
        {{"angle", "degree"},
         "the angle of a rotation is \"degrees\", that of a camera \"fov\", that of a spot \"outer_cone\""},
        {{"power", "energy", "strength", "brightness"}, "the strength of a light is \"intensity\""},
        {{"file"}, "meshes of other files are shown by \"include\": \"FILE.glb\""},
        {{"objects"}, "objects are listed in \"nodes\""},
        {{"resolution", "width"}, "the size of the picture is \"settings\": {\"size\": \"640x480\"}"},
        {{"samples"}, "the samples of a pixel are \"spp\"", "settings"},
        {{"start_frame"}, "the first and last frame are \"frames\": [0, 59]"},
    };
    return table;
}

const std::vector<Advice>& found_texts() {
    static const std::vector<Advice> table{
        {{"area"}, "an area light is a node with a \"shape\" and a \"material\" that has \"emission\""},
        {{"sun"}, "the sun is \"directional\""},
        {{"cube"}, "a cube is a \"box\""},
        {{"plane"}, "a plane is a \"quad\""},
        {{"progressive", "adaptive"}, "to sample until the error is small enough, write \"error\": 1", "settings"},
    };
    return table;
}

std::string_view find_advice(const std::vector<Advice>& table, std::string_view list, std::string_view word) {
    for (const Advice& advice : table) {
        const bool named = std::ranges::find(advice.words, word) != advice.words.end();
        if (named && (advice.list.empty() || advice.list == list)) return advice.text;
    }
    return {};
}

/// A rotation of three numbers, which other programs take for angles.
bool is_three_angles(const json::json_pointer& place, const json& value) {
    return place.back() == "rotation" && value.is_array() && value.size() == 3;
}

/// Pairs [time, [...]] without the object around them.
bool is_bare_keys(const json& value) {
    const auto is_key = [](const json& pair) {
        return pair.is_array() && pair.size() == 2 && pair[0].is_number() && pair[1].is_array();
    };
    return value.is_array() && !value.empty() && std::ranges::all_of(value, is_key);
}

/// Advice for a value of another kind than expected.
std::string advise_value(const json::json_pointer& place, std::string_view list, const json& value) {
    const std::string& key = place.back();
    if (is_three_angles(place, value)) return std::string(about_rotation);
    if (is_bare_keys(value)) return std::string(about_keys);
    if (key == "size" && value.is_number()) return std::string(about_lengths);
    if (!value.is_string()) return {};
    const auto& text = value.get_ref<const std::string&>();
    if (key == "shape") return fmt::format("write {{\"type\": \"{}\"}}", printable(text));
    if (key == "environment") return "a picture is \"environment_image\"";
    return std::string(find_advice(found_texts(), list, text));
}

}  // namespace

const json& scene_schema() {
    static const json schema = json::parse(schema_text);
    return schema;
}

std::string advise(const SchemaMismatch& mismatch, const json& document) {
    const json::json_pointer place(mismatch.pointer);
    if (place.empty() || !document.contains(place)) return mismatch.reason;
    const std::string_view pointer = mismatch.pointer;
    const std::string_view list = pointer.substr(1, pointer.find('/', 1) - 1);
    const json& value = document.at(place);
    std::string advice;
    std::string reason = mismatch.reason;
    if (reason.starts_with("unknown key ")) {
        advice = find_advice(unknown_keys(), list, place.back());
        if (!advice.empty()) reason = reason.substr(0, reason.find("; did you mean"));
    } else {
        advice = advise_value(place, list, value);
    }
    return advice.empty() ? reason : reason.append("; ").append(advice);
}

void check_scene_schema(const json& document, const std::string& file) {
    static const JsonSchema schema(schema_of_values());
    if (const auto mismatch = schema.find_mismatch(document)) {
        throw InputError(file, mismatch->pointer, advise(*mismatch, document));
    }
}

}  // namespace aleph
