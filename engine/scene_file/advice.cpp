#include "engine/scene_file/advice.h"

#include <string_view>

namespace aleph {

namespace {

using nlohmann::json;

struct Advice {
    std::string_view list;  ///< first key of the place; empty: any
    std::string_view word;  ///< the unknown key, or the text that was found
    std::string_view text;
};

constexpr std::string_view about_transform = "a node's place is \"translation\": [x, y, z]";
constexpr std::string_view about_rotation =
    "a rotation is {\"axis\": [0, 1, 0], \"degrees\": 90} or a quaternion x, y, z, w; for angles about x, y and z "
    "write "
    "\"operations\": [{\"rotate_z\": 0}, {\"rotate_y\": 90}, {\"rotate_x\": 0}]";
constexpr std::string_view about_view = "a camera looks along -z of its node; \"rotation\" of the node turns it";
constexpr std::string_view about_color = "the colour of a material is \"base_color\"";
constexpr std::string_view about_emission = "a material gives light with \"emission\": [r, g, b], in cd/m2";
constexpr std::string_view about_size = "the size of the picture is \"settings\": {\"size\": \"640x480\"}";

constexpr Advice unknown_keys[] = {
    {"", "position", about_transform},
    {"", "location", about_transform},

    {"", "rotate", about_rotation},
    {"", "euler", about_rotation},
    {"", "orientation", about_rotation},
    {"", "look_at", about_view},
    {"", "lookat", about_view},
    {"", "target", about_view},
    {"", "color", about_color},
    {"", "diffuse", about_color},
    {"", "colour", about_color},
    {"", "albedo", about_color},
    {"", "emissive", about_emission},
    {"", "objects", "objects are listed in \"nodes\""},
    {"", "resolution", about_size},
    {"", "width", about_size},
    {"", "start_frame", "the first and last frame are \"frames\": [0, 59]"},
};

constexpr Advice found_texts[] = {
    {"", "area", "an area light is a node with a \"shape\" and a \"material\" that has \"emission\""},
    {"", "sun", "the sun is \"directional\""},
    {"", "cube", "a cube is a \"box\""},
    {"", "plane", "a plane is a \"quad\""},
    {"settings", "progressive", "to sample until the error is small enough, write \"error\": 1"},
    {"settings", "adaptive", "to sample until the error is small enough, write \"error\": 1"},
};

template <std::size_t Count>
std::string_view find_advice(const Advice (&table)[Count], std::string_view list, std::string_view word) {
    for (const Advice& advice : table) {
        if (advice.word == word && (advice.list.empty() || advice.list == list)) return advice.text;
    }
    return {};
}

/// A rotation of three numbers, which other programs take for angles.
bool is_three_angles(const json::json_pointer& place, const json& value) {
    return place.back() == "rotation" && value.is_array() && value.size() == 3;
}

}  // namespace

std::string advise(const SchemaMismatch& mismatch, const json& document) {
    const json::json_pointer place(mismatch.pointer);
    if (place.empty() || !document.contains(place)) return mismatch.reason;
    const std::string_view pointer = mismatch.pointer;
    const std::string_view list = pointer.substr(1, pointer.find('/', 1) - 1);
    const json& value = document.at(place);
    std::string_view advice;
    std::string reason = mismatch.reason;
    if (reason.starts_with("unknown key ")) {
        advice = find_advice(unknown_keys, list, place.back());
        if (!advice.empty()) reason = reason.substr(0, reason.find("; did you mean"));
    } else if (is_three_angles(place, value)) {
        advice = about_rotation;
    } else if (value.is_string()) {
        advice = find_advice(found_texts, list, value.get_ref<const std::string&>());
    }
    return advice.empty() ? reason : reason.append("; ").append(advice);
}

}  // namespace aleph
