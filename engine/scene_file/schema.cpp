#include "engine/scene_file/schema.h"

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr const char* schema_text =
#include "scene_schema.inc"
    ;

/// Takes {"named": ...} out of the alternatives: when a document is checked, the values stand in its places.
void remove_named_uses(nlohmann::json& schema) {
    if (!schema.is_structured()) return;
    for (nlohmann::json& inner : schema) remove_named_uses(inner);
    if (!schema.is_object() || !schema.contains("anyOf") || !schema["anyOf"].is_array()) return;
    auto& alternatives = schema["anyOf"].get_ref<nlohmann::json::array_t&>();
    const nlohmann::json use{{"$ref", "#/definitions/named_use"}};
    if (std::erase(alternatives, use) == 0 || alternatives.size() != 1) return;
    nlohmann::json only = alternatives.front();
    schema.erase("anyOf");
    only.update(schema);
    schema = std::move(only);
}

nlohmann::json schema_of_values() {
    nlohmann::json schema = scene_schema();
    remove_named_uses(schema);
    return schema;
}

}  // namespace

const nlohmann::json& scene_schema() {
    static const nlohmann::json schema = nlohmann::json::parse(schema_text);
    return schema;
}

void check_scene_schema(const nlohmann::json& document, const std::string& file) {
    static const JsonSchema schema(schema_of_values());
    if (const auto mismatch = schema.find_mismatch(document)) {
        throw InputError(file, mismatch->pointer, advise(*mismatch, document));
    }
}

}  // namespace aleph
