#include "engine/json/memory.h"

#include <fmt/format.h>

#include "engine/base/errors.h"

namespace aleph {

std::size_t estimate_json_memory(std::string_view text, bool comments) {
    constexpr std::size_t element = 48, container = 96, member = 250, string = 48;
    std::size_t bytes = 0;
    const auto add_mark = [&](char c) {
        if (c == ',') {
            bytes += element;
        } else if (c == ':') {
            bytes += member;
        } else if (c == '[' || c == '{') {
            bytes += element + container;
        }
    };
    scan_json(text, comments, add_mark, [&](std::size_t length) { bytes += string + length; });
    return bytes;
}

void check_json_memory(std::string_view text, bool comments, const LoadLimits& limits, const std::string& file,
                       std::string_view advice) {
    const std::size_t bytes = estimate_json_memory(text, comments);
    if (bytes <= limits.json_values()) return;
    throw InputError(file, "",
                     fmt::format("its JSON holds so many values that they would take about {} MiB, more than {}; {}",
                                 bytes >> 20, limits.json_values() >> 20, advice));
}

}  // namespace aleph
