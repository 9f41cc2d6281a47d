#pragma once
// JSON text to values: text of any origin, limited in size, nesting and memory.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"

namespace aleph {

/// Deepest nesting of arrays and objects: parsers and destructors recurse.
inline constexpr int max_json_depth = 128;
/// Longest text of parse_strict_json, bytes, with embedded base64.
inline constexpr std::size_t max_json_bytes = std::size_t{256} << 20;

/// Parses JSON as the standard has it. The parser checks UTF-8.
/// @param advice  what to do about a text with too many values
/// @throws InputError with the place "line L, column C" for a syntax error
nlohmann::json parse_strict_json(std::string_view text, const std::string& file, const LoadLimits& limits,
                                 std::string_view advice);

struct JsonText {
    nlohmann::json root;  ///< objects sorted by key
    /// Keys of each object in the root, in the order of the file, by the object's name.
    std::map<std::string, std::vector<std::string>> key_order;
};

/// Parses the text of a scene file: comments are allowed, a key that is there twice is refused.
/// @throws InputError with the place "line L, column C" for a syntax error or a number too large for a double, else
/// with a JSON pointer
JsonText parse_json_text(std::string_view text, const std::string& file, const LoadLimits& limits = {});

/// Upper estimate of the memory of the text's values in nlohmann::json, bytes, without parsing. A number of two bytes
/// becomes 48 (16 in a list whose capacity may be twice its length, 16 more when the list is destroyed), the member of
/// an object 250.
/// @param comments  the text may hold // and /* */
std::size_t estimate_json_memory(std::string_view text, bool comments);

}  // namespace aleph
