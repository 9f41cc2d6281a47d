#pragma once
// JSON text as people write it: comments allowed, no key twice, no number that is lost, errors with line and column.

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"

namespace aleph {

/// About the memory that nlohmann's values take, from above, without parsing: a number of two bytes becomes 48 (16 in
/// a list that may have grown to twice its length, 16 again where it is destroyed), the member of an object 250.
/// @param comments  the text may hold // and /* */
std::size_t estimate_json_memory(std::string_view text, bool comments);

/// Refuses a text whose values would take more than limits.json_values().
/// @param advice  what to do about it
/// @throws InputError
void check_json_memory(std::string_view text, bool comments, const LoadLimits& limits, const std::string& file,
                       std::string_view advice);

struct JsonText {
    nlohmann::json root;  ///< objects sorted by key
    /// Keys of the root's own objects as they stand in the file, by the object's name: where order counts.
    std::map<std::string, std::vector<std::string>> key_order;
};

/// Parses the text of a scene file, whatever the process's locale. Size, memory and nesting (max_json_depth) are
/// limited.
/// @throws InputError with place "line L, column C" for a syntax error or a number too large for a double, else a JSON
/// pointer
JsonText parse_json_text(std::string_view text, const std::string& file, const LoadLimits& limits = {});

/// The value as text: a list or an object stands on one line where that fits 110 columns, else one element a line,
/// indented by 2; long lists of numbers, and of lists of whole numbers, fill their lines. Numbers are the shortest that
/// give back the same bits, whatever the locale. Ends with a newline.
/// @throws InputError (file as given) for text that is not UTF-8 and numbers that are not finite
std::string format_json(const nlohmann::ordered_json& value, const std::string& file);

}  // namespace aleph
