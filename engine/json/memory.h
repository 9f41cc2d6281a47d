#pragma once
// The memory that JSON values will take, estimated from the text.

#include <cstddef>
#include <string>
#include <string_view>

#include "engine/json/load_limits.h"

namespace aleph {

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
