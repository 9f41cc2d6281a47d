#include "engine/json/schema_titles.h"

#include <fmt/format.h>

#include <string>
#include <vector>

namespace aleph {

namespace {

using nlohmann::json;

std::string join_choices(const std::vector<std::string>& parts) {
    std::string out = parts.front();
    for (std::size_t i = 1; i < parts.size(); ++i) out += (i + 1 < parts.size() ? ", " : " or ") + parts[i];
    return out;
}

std::string describe_number(const json& schema) {
    std::string out = schema["type"] == "integer" ? "a whole number" : "a number";
    if (schema.contains("minimum") && schema.contains("maximum")) {
        return fmt::format("{} from {} to {}", out, schema["minimum"].dump(), schema["maximum"].dump());
    }
    if (schema.contains("minimum")) out += " of at least " + schema["minimum"].dump();
    if (schema.contains("exclusiveMinimum")) out += " above " + schema["exclusiveMinimum"].dump();
    return out;
}

std::string describe(const json& schema, const json& root) {
    if (schema.contains("$ref")) {
        return describe(root.at(json::json_pointer(schema["$ref"].get_ref<const std::string&>().substr(1))), root);
    }
    if (schema.contains("title")) return schema["title"];
    std::vector<std::string> parts;
    if (schema.contains("anyOf")) {
        for (const json& alternative : schema["anyOf"]) parts.push_back(describe(alternative, root));
        return join_choices(parts);
    }
    if (schema.contains("enum")) {
        for (const json& value : schema["enum"]) parts.push_back(value.dump());
        return join_choices(parts);
    }
    const std::string type = schema["type"];
    if (type == "number" || type == "integer") return describe_number(schema);
    if (type == "boolean") return "true or false";
    if (type == "string") return "text";
    return type == "array" ? "a list" : "an object";
}

/// True for a schema that checks something. A property may be called "type": its value is an object.
bool is_schema(const json& value) {
    if (!value.is_object()) return false;
    const auto type = value.find("type");
    return value.contains("anyOf") || value.contains("enum") || (type != value.end() && !type->is_object());
}

void add_titles(json& value, const json& root) {
    if (!value.is_structured()) return;
    for (json& inner : value) add_titles(inner, root);
    if (is_schema(value) && !value.contains("title")) value["title"] = describe(value, root);
}

}  // namespace

void add_titles(json& schema) {
    const json root = schema;
    add_titles(schema, root);
}

}  // namespace aleph
