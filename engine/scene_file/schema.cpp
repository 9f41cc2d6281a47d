#include "engine/scene_file/schema.h"

#include "engine/base/errors.h"
#include "engine/json/schema.h"
#include "engine/scene_file/advice.h"

namespace aleph {

namespace {

constexpr const char* schema_text =
#include "scene_schema.inc"
    ;

}  // namespace

const nlohmann::json& scene_schema() {
    static const nlohmann::json schema = nlohmann::json::parse(schema_text);
    return schema;
}

void check_scene_schema(const nlohmann::json& document, const std::string& file) {
    static const JsonSchema schema(scene_schema());
    if (const auto mismatch = schema.find_mismatch(document)) {
        throw InputError(file, mismatch->pointer, advise(*mismatch, document));
    }
}

}  // namespace aleph
