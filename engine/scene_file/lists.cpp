#include "engine/scene_file/lists.h"

#include <fmt/format.h>

#include <charconv>

namespace aleph {

namespace {

/// Calls visit for every number of a flat list, or of a list of groups.
template <class Visit>
void for_each_number(const JsonRef& at, std::size_t width, const Visit& visit) {
    const std::size_t count = at.array_size();
    if (count == 0) return;
    if (!at.json().front().is_array()) {
        if (count % width != 0) {
            at.fail(fmt::format("has {} numbers; they come in groups of {}", count, width));
        }
        for (std::size_t i = 0; i < count; ++i) visit(at[i]);
        return;
    }
    for (std::size_t i = 0; i < count; ++i) {
        const JsonRef group = at[i];
        if (group.array_size() != width) {
            group.fail(fmt::format("expected {} numbers, found {}", width, group.array_size()));
        }
        for (std::size_t k = 0; k < width; ++k) visit(group[k]);
    }
}

}  // namespace

template <class Vector>
std::vector<Vector> read_vectors(const JsonRef& at) {
    constexpr std::size_t width = Vector::length();
    std::vector<Vector> values;
    values.reserve(at.array_size() / width + 1);
    std::size_t i = 0;
    for_each_number(at, width, [&](const JsonRef& number) {
        if (i % width == 0) values.emplace_back();
        values.back()[static_cast<int>(i++ % width)] = static_cast<float>(number.number());
    });
    return values;
}

template std::vector<glm::vec2> read_vectors(const JsonRef&);
template std::vector<glm::vec3> read_vectors(const JsonRef&);
template std::vector<glm::vec4> read_vectors(const JsonRef&);

int read_index(const JsonRef& at, std::size_t count, const char* kind) {
    const std::int64_t index = at.integer(0, std::numeric_limits<int>::max());
    if (static_cast<std::size_t>(index) >= count) {
        at.fail(count == 0 ? fmt::format("there is no {} {}: there are none", kind, index)
                           : fmt::format("there is no {} {}: they are numbered 0 to {}", kind, index, count - 1));
    }
    return static_cast<int>(index);
}

std::vector<int> read_indices(const JsonRef& at, std::size_t width, std::size_t count, const char* kind) {
    std::vector<int> indices;
    indices.reserve(at.array_size());
    for_each_number(at, width, [&](const JsonRef& number) { indices.push_back(read_index(number, count, kind)); });
    return indices;
}

double widen(float value) {
    const std::string text = fmt::format("{}", value);
    double wide = value;
    std::from_chars(text.data(), text.data() + text.size(), wide);
    return static_cast<float>(wide) == value ? wide : value;
}

nlohmann::ordered_json write_floats(const float* first, std::size_t count) {
    nlohmann::ordered_json out = nlohmann::ordered_json::array();
    auto& list = out.get_ref<nlohmann::ordered_json::array_t&>();
    list.reserve(count);
    for (std::size_t i = 0; i < count; ++i) list.emplace_back(widen(first[i]));
    return out;
}

}  // namespace aleph
