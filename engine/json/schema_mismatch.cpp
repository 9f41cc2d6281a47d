#include "engine/json/schema_mismatch.h"

#include <fmt/format.h>

#include <algorithm>
#include <regex>
#include <vector>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"

namespace aleph {

namespace {

using nlohmann::json;
using Mismatch = std::optional<SchemaMismatch>;

std::string found(const json& value) {
    if (value.is_string()) return fmt::format("the text \"{}\"", printable(value.get_ref<const std::string&>(), 40));
    if (value.is_array()) return fmt::format("a list of {}", value.size());
    if (value.is_object()) {
        return value.empty() ? "an empty object"
                             : fmt::format("an object with \"{}\"", printable(value.begin().key(), 40));
    }
    return value.dump();
}

bool has_type(const json& value, const std::string& type) {
    if (type == "object") return value.is_object();
    if (type == "array") return value.is_array();
    if (type == "string") return value.is_string();
    if (type == "boolean") return value.is_boolean();
    if (type == "integer") return value.is_number_integer();
    return type == "number" && value.is_number();
}

/// @param types  one name, or a list of those that are allowed
bool has_some_type(const json& value, const json& types) {
    if (types.is_string()) return has_type(value, types.get_ref<const std::string&>());
    return std::any_of(types.begin(), types.end(),
                       [&](const json& type) { return has_type(value, type.get_ref<const std::string&>()); });
}

std::string describe_limits(const json& schema) {
    std::string out = schema["type"] == "integer" ? "a whole number" : "a number";
    if (schema.contains("minimum") && schema.contains("maximum")) {
        return fmt::format("{} from {} to {}", out, schema["minimum"].dump(), schema["maximum"].dump());
    }
    if (schema.contains("minimum")) out += " of at least " + schema["minimum"].dump();
    if (schema.contains("exclusiveMinimum")) out += " above " + schema["exclusiveMinimum"].dump();
    return out;
}

class Walk {
  public:
    explicit Walk(const json& root) : root_(root) {}

    Mismatch check(const json& schema_or_reference, const json& value, const json::json_pointer& place,
                   int depth) const {
        const json& schema = resolve(schema_or_reference);
        if (schema.contains("anyOf")) return check_alternatives(schema, value, place, depth);
        if (!fits_here(schema, value)) {
            return SchemaMismatch{place.to_string(),
                                  fmt::format("expected {}, found {}", expected(schema), found(value)), depth};
        }
        if (value.is_array()) return check_items(schema, value, place, depth);
        if (value.is_object()) return check_members(schema, value, place, depth);
        return std::nullopt;
    }

  private:
    const json& resolve(const json& schema) const {
        const json* now = &schema;
        while (now->contains("$ref")) {
            now = &root_.at(json::json_pointer((*now)["$ref"].get_ref<const std::string&>().substr(1)));
        }
        return *now;
    }

    std::string expected(const json& schema_or_reference) const {
        const json& schema = resolve(schema_or_reference);
        if (schema.contains("title")) return schema["title"].get<std::string>();
        std::vector<std::string> parts;
        for (const char* list : {"anyOf", "enum"}) {
            if (!schema.contains(list)) continue;
            for (const json& one : schema[list]) parts.push_back(list[0] == 'a' ? expected(one) : one.dump());
        }
        if (!parts.empty()) {
            std::string out = parts.front();
            for (std::size_t i = 1; i < parts.size(); ++i) out += (i + 1 < parts.size() ? ", " : " or ") + parts[i];
            return out;
        }
        const std::string type = schema["type"].get<std::string>();
        if (type == "number" || type == "integer") return describe_limits(schema);
        if (type == "boolean") return "true or false";
        if (type == "string") return "text";
        return type == "array" ? "a list" : "an object";
    }

    /// What the value itself has to be, apart from what it holds.
    bool fits_here(const json& schema, const json& value) const {
        const auto holds = [&](const char* word, const auto& test) {
            return !schema.contains(word) || test(schema[word]);
        };
        if (!holds("type", [&](const json& type) { return has_some_type(value, type); })) return false;
        if (!holds("const", [&](const json& constant) { return value == constant; })) return false;
        if (!holds("enum",
                   [&](const json& list) { return std::find(list.begin(), list.end(), value) != list.end(); })) {
            return false;
        }
        if (value.is_number()) {
            return holds("minimum", [&](const json& limit) { return value >= limit; }) &&
                   holds("maximum", [&](const json& limit) { return value <= limit; }) &&
                   holds("exclusiveMinimum", [&](const json& limit) { return value > limit; });
        }
        if (value.is_array()) {
            return holds("minItems", [&](const json& limit) { return value.size() >= limit.get<std::size_t>(); }) &&
                   holds("maxItems", [&](const json& limit) { return value.size() <= limit.get<std::size_t>(); });
        }
        if (value.is_string()) {
            const std::string& text = value.get_ref<const std::string&>();
            const auto characters = static_cast<std::size_t>(std::count_if(
                text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xc0) != 0x80; }));
            return holds("minLength", [&](const json& limit) { return characters >= limit.get<std::size_t>(); }) &&
                   holds("maxLength", [&](const json& limit) { return characters <= limit.get<std::size_t>(); }) &&
                   holds("pattern", [&](const json& pattern) {
                       return std::regex_search(text, std::regex(pattern.get<std::string>()));
                   });
        }
        return true;
    }

    Mismatch check_alternatives(const json& schema, const json& value, const json::json_pointer& place,
                                int depth) const {
        Mismatch deepest, only;
        int of_this_type = 0;
        for (const json& alternative : schema["anyOf"]) {
            Mismatch mismatch = check(alternative, value, place, depth);
            if (!mismatch) return std::nullopt;
            if (may_have_type(alternative, value)) {
                ++of_this_type;
                only = mismatch;
            }
            if (!deepest || mismatch->depth > deepest->depth) deepest = std::move(mismatch);
        }
        if (deepest->depth > depth) return deepest;
        // No alternative gets inside. A single one of the right type, or a key that none of them knows, tells most.
        if (of_this_type == 1) return only;
        if (value.is_object()) {
            if (Mismatch unknown = check_keys(schema, value, place, depth)) return unknown;
        }
        return SchemaMismatch{place.to_string(), fmt::format("expected {}, found {}", expected(schema), found(value)),
                              depth};
    }

    bool may_have_type(const json& schema_or_reference, const json& value) const {
        const json& schema = resolve(schema_or_reference);
        return schema.contains("type") && has_some_type(value, schema["type"]);
    }

    Mismatch check_items(const json& schema, const json& value, const json::json_pointer& place, int depth) const {
        const auto items = schema.find("items");
        if (items == schema.end()) return std::nullopt;
        for (std::size_t i = 0; i < value.size(); ++i) {
            const json& item = items->is_array() ? (*items)[i] : *items;
            if (Mismatch mismatch = check(item, value[i], place / i, depth + 1)) return mismatch;
        }
        return std::nullopt;
    }

    /// Keys that the schema, or each of its alternatives that is an object, allows.
    void collect_keys(const json& schema_or_reference, std::vector<std::string>& keys) const {
        const json& schema = resolve(schema_or_reference);
        if (schema.contains("anyOf")) {
            for (const json& alternative : schema["anyOf"]) collect_keys(alternative, keys);
        }
        if (!schema.contains("properties")) return;
        for (const auto& property : schema["properties"].items()) {
            if (std::find(keys.begin(), keys.end(), property.key()) == keys.end()) keys.push_back(property.key());
        }
    }

    Mismatch check_keys(const json& schema, const json& value, const json::json_pointer& place, int depth) const {
        std::vector<std::string> known;
        collect_keys(schema, known);
        for (const auto& member : value.items()) {
            if (std::find(known.begin(), known.end(), member.key()) != known.end()) continue;
            return SchemaMismatch{
                (place / printable(member.key())).to_string(),
                fmt::format("unknown key \"{}\"{}", printable(member.key()), suggestion(member.key(), known)), depth};
        }
        return std::nullopt;
    }

    Mismatch check_members(const json& schema, const json& value, const json::json_pointer& place, int depth) const {
        const json none = json::object();
        const json& properties = schema.contains("properties") ? schema["properties"] : none;
        const bool closed = schema.contains("additionalProperties") && schema["additionalProperties"] == json(false);
        if (closed) {
            if (Mismatch unknown = check_keys(schema, value, place, depth)) return unknown;
        }
        for (const json& key : schema.contains("required") ? schema["required"] : json::array()) {
            if (value.contains(key.get_ref<const std::string&>())) continue;
            return SchemaMismatch{place.to_string(), fmt::format("the key {} is missing", key.dump()), depth};
        }
        for (const auto& member : value.items()) {
            const auto property = properties.find(member.key());
            const json* inner = property != properties.end() ? &*property : closed ? nullptr : additional(schema);
            if (inner == nullptr) continue;
            if (Mismatch mismatch = check(*inner, member.value(), place / printable(member.key()), depth + 1))
                return mismatch;
        }
        return std::nullopt;
    }

    const json* additional(const json& schema) const {
        const auto found_schema = schema.find("additionalProperties");
        return found_schema == schema.end() || !found_schema->is_object() ? nullptr : &*found_schema;
    }

    const json& root_;
};

}  // namespace

std::optional<SchemaMismatch> find_mismatch(const json& schema, const json& document) {
    return Walk(schema).check(schema, document, json::json_pointer(), 0);
}

}  // namespace aleph
