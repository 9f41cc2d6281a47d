#pragma once
// Titles for the parts of a JSON Schema that have none.

#include <nlohmann/json.hpp>

namespace aleph {

/// Gives every part of the schema without a `title` one: its type and limits ("a number from 0 to 1"), the values of
/// its `enum`, or the titles of its `anyOf`. Knows $ref to "#/...".
void add_titles(nlohmann::json& schema);

}  // namespace aleph
