#pragma once
// What to write in place of keys and values that other formats and programs have.

#include <nlohmann/json.hpp>

#include "engine/json/schema.h"

namespace aleph {

/// The reason of a mismatch; for keys and values that people know from elsewhere, with what a scene file has for them.
std::string advise(const SchemaMismatch& mismatch, const nlohmann::json& document);

}  // namespace aleph
