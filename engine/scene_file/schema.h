#pragma once
// The JSON Schema of scene files: scenes/scene.schema.json, compiled into the library.

#include <nlohmann/json.hpp>
#include <string>

#include "engine/json/schema.h"

namespace aleph {

const nlohmann::json& scene_schema();

/// Checks a document against the schema.
/// @throws InputError with the JSON pointer of the first value that does not fit and the reason: "expected 3 numbers,
/// found a list of 2", or an unknown key with close known ones
void check_scene_schema(const nlohmann::json& document, const std::string& file);

/// The reason of a mismatch; for keys and values that people know from other formats and programs, with what a scene
/// file has for them.
std::string advise(const SchemaMismatch& mismatch, const nlohmann::json& document);

}  // namespace aleph
