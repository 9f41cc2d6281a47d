#pragma once
// Named values: numbers, vectors and tracks of the root's object "named", used elsewhere as {"named": "door height"}.

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "engine/base/errors.h"
#include "engine/json/load_limits.h"

namespace aleph {

/// Puts the values in the places where they are used; values may use others. Not in "settings", and not directly in
/// "images" and "materials", where "named" is a name of the file's own.
/// @param text  of the file; its values and the copies together take at most limits.json_values()
/// @throws InputError with the place of use: no value of that name, one that holds itself, too many copies, too deep
void replace_named_values(nlohmann::json& root, std::string_view text, const std::string& file,
                          const LoadLimits& limits);

/// The error, and where the value at its place is defined if that is a named one.
/// @param root  of the file, before replace_named_values
InputError with_definition(const InputError& error, const nlohmann::json& root);

}  // namespace aleph
