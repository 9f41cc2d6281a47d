// g++ 12 sees overlapping copies in std::string::replace where there are none (GCC PR 105651).
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wrestrict"
#endif

#include "engine/scene_file/schema.h"

#include <memory>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>

#include "engine/base/errors.h"
#include "engine/json/schema_mismatch.h"

namespace aleph {

namespace {

constexpr const char* schema_text =
#include "scene_schema.inc"
    ;

const valijson::Schema& compiled_schema() {
    static const std::unique_ptr<const valijson::Schema> schema = [] {
        auto compiled = std::make_unique<valijson::Schema>();
        valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
        parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(scene_schema()), *compiled);
        return compiled;
    }();
    return *schema;
}

}  // namespace

const nlohmann::json& scene_schema() {
    static const nlohmann::json schema = nlohmann::json::parse(schema_text);
    return schema;
}

void check_scene_schema(const nlohmann::json& document, const std::string& file) {
    // valijson decides; it is asked for the verdict alone, since it collects an error for every value of a file and its
    // texts do not say what was expected.
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    if (validator.validate(compiled_schema(), valijson::adapters::NlohmannJsonAdapter(document), nullptr)) return;
    if (const auto mismatch = find_mismatch(scene_schema(), document)) {
        throw InputError(file, mismatch->pointer, mismatch->reason);
    }
    throw InputError(file, "", "does not fit scene.schema.json");
}

}  // namespace aleph
