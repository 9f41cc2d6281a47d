#pragma once
// The JSON Schema of scene files (scenes/scene.schema.json), part of the library.

#include <nlohmann/json.hpp>
#include <string>

namespace aleph {

/// The schema itself.
const nlohmann::json& scene_schema();

/// Checks a document against the schema.
/// @throws InputError with the JSON pointer of the first value that does not fit, and in plain words what was expected
/// there and what was found; an unknown key is named, with a known one that is close
void check_scene_schema(const nlohmann::json& document, const std::string& file);

}  // namespace aleph
