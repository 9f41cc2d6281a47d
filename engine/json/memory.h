#pragma once
// JSON text without parsing: characters outside strings, and the memory that the values will take.

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/json/load_limits.h"

namespace aleph {

/// Position of the last character of the comment that begins at `at`; `at` if none does.
inline std::size_t skip_json_comment(std::string_view text, std::size_t at) {
    const std::string_view start = text.substr(at, 2);
    if (start != "//" && start != "/*") return at;
    const std::size_t end = text.find(start == "//" ? "\n" : "*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + (start == "//" ? 0 : 1);
}

/// Calls mark(character) for each character outside strings, and string(bytes) for each string.
/// @param comments  the text may hold // and /* */
template <class Mark, class String>
void scan_json(std::string_view text, bool comments, const Mark& mark, const String& string) {
    std::size_t string_start = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') {
                ++i;
            } else if (c == '"') {
                in_string = false;
                string(i - string_start);
            }
        } else if (c == '"') {
            in_string = true;
            string_start = i;
        } else if (c == '/' && comments) {
            i = skip_json_comment(text, i);
        } else {
            mark(c);
        }
    }
}

/// Upper estimate of the memory of the text's values in nlohmann::json, bytes, without parsing. A number of two bytes
/// becomes 48 (16 in a list whose capacity may be twice its length, 16 more when the list is destroyed), the member of
/// an object 250.
/// @param comments  the text may hold // and /* */
std::size_t estimate_json_memory(std::string_view text, bool comments);

/// Refuses a text whose values would take more than limits.json_values().
/// @param advice  what to do about it
/// @throws InputError
void check_json_memory(std::string_view text, bool comments, const LoadLimits& limits, const std::string& file,
                       std::string_view advice);

}  // namespace aleph
