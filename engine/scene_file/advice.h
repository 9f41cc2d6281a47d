#pragma once
// Advice for keys and values that other formats and programs have: what to write in their place.

#include <nlohmann/json.hpp>

#include "engine/json/schema.h"

namespace aleph {

/// The reason of a mismatch; for keys and values that people know from elsewhere, with what a scene file has for them.
std::string advise(const SchemaMismatch& mismatch, const nlohmann::json& document);

}  // namespace aleph
