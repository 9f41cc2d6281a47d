#pragma once
// Why a document does not fit a JSON Schema, in plain words.

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace aleph {

struct SchemaMismatch {
    std::string pointer;  ///< JSON pointer to the value that does not fit
    std::string reason;   ///< "expected 3 numbers, found a list of 2"
    int depth = 0;        ///< of the pointer
};

/// The first value, in the order of the document, that does not fit; of the alternatives of an `anyOf` the one that
/// fits deepest tells. Knows the words that scene.schema.json uses: $ref (#/definitions/...), anyOf, type, const, enum,
/// pattern, limits of numbers, lengths, items (one schema, or one each), properties, required, additionalProperties.
/// A schema's `title` says what it expects. Strict: 4.0 is no integer.
std::optional<SchemaMismatch> find_mismatch(const nlohmann::json& schema, const nlohmann::json& document);

}  // namespace aleph
