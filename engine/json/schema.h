#pragma once
// A JSON Schema, and the first value of a document that does not fit it.

#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

namespace valijson {
class Schema;
}

namespace aleph {

struct SchemaMismatch {
    std::string pointer;  ///< JSON pointer to the value that does not fit
    std::string reason;   ///< "expected 3 numbers, found a list of 2"
    int depth = 0;        ///< number of keys and indices from the root to the value
};

/// A schema, draft 7, compiled by valijson. Types are strict: 4.0 is not an integer.
class JsonSchema {
  public:
    /// A schema's `title` names what it expects in messages ("3 numbers"); where it has none, the message names its
    /// type, limits, `enum` or `anyOf`.
    explicit JsonSchema(nlohmann::json schema);
    ~JsonSchema();

    /// Nothing where the document fits. If no alternative of an `anyOf` fits, the result is from the alternative whose
    /// mismatch lies deepest.
    std::optional<SchemaMismatch> find_mismatch(const nlohmann::json& document) const;

  private:
    std::unique_ptr<valijson::Schema> compiled_;
};

}  // namespace aleph
