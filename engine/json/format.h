#pragma once
// JSON values to text.

#include <nlohmann/json.hpp>
#include <string>

namespace aleph {

/// The value as text that ends with a newline. A list or an object is on one line where that fits 110 columns, else it
/// has one element per line, indented by 2; long lists of numbers, and of lists of whole numbers, fill their lines.
/// Numbers are the shortest that give back the same bits, in any locale.
/// @throws InputError (file as given) for text that is not UTF-8 and numbers that are not finite
std::string format_json(const nlohmann::ordered_json& value, const std::string& file);

}  // namespace aleph
