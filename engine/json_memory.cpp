// How much memory the values of a JSON text will take, before any of them is made.

#include <fmt/format.h>

#include "engine/base/errors.h"
#include "engine/json_text.h"

namespace aleph {

namespace {

/// Where the comment that begins here ends; `at` itself where none does.
std::size_t skip_comment(std::string_view text, std::size_t at) {
    const std::string_view start = text.substr(at, 2);
    if (start != "//" && start != "/*") return at;
    const std::size_t end = text.find(start == "//" ? "\n" : "*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + (start == "//" ? 0 : 1);
}

}  // namespace

std::size_t estimate_json_memory(std::string_view text, bool comments) {
    constexpr std::size_t element = 48, container = 96, member = 250, string = 48;
    std::size_t bytes = 0, string_start = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_string = false;
                bytes += string + (i - string_start);
            }
            continue;
        }
        switch (c) {
            case '"':
                in_string = true;
                string_start = i;
                break;
            case ',':
                bytes += element;
                break;
            case ':':
                bytes += member;
                break;
            case '[':
            case '{':
                bytes += element + container;
                break;
            case '/':
                if (comments) i = skip_comment(text, i);
                break;
            default:
                break;
        }
    }
    return bytes;
}

void check_json_memory(std::string_view text, bool comments, const std::string& file, std::string_view advice) {
    const std::size_t bytes = estimate_json_memory(text, comments);
    if (bytes <= max_json_memory) return;
    throw InputError(file, "",
                     fmt::format("its JSON holds so many values that they would take about {} MiB, more than {}; {}",
                                 bytes >> 20, max_json_memory >> 20, advice));
}

}  // namespace aleph
