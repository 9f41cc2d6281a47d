#include "engine/json/schema.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#include <vector>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"

namespace aleph {

namespace {

using nlohmann::json;
using valijson::Subschema;
using Adapter = valijson::adapters::NlohmannJsonAdapter;
using Visitor = valijson::ValidationVisitor<Adapter>;
using Mismatch = std::optional<SchemaMismatch>;
using Patterns = std::unordered_map<std::string, std::regex>;

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

/// Gives every part of a schema without a `title` one: its type and limits ("a number from 0 to 1"), the values of
/// its `enum`, or the titles of its `anyOf`. Knows $ref to "#/...".
void add_titles(json& value, const json& root) {
    if (!value.is_structured()) return;
    for (json& inner : value) add_titles(inner, root);
    if (is_schema(value) && !value.contains("title")) value["title"] = describe(value, root);
}

std::string describe_value(const json& value) {
    if (value.is_string()) return fmt::format("the text \"{}\"", printable(value.get_ref<const std::string&>(), 40));
    if (value.is_array()) return fmt::format("a list of {}", value.size());
    if (value.is_object()) {
        return value.empty() ? "an empty object"
                             : fmt::format("an object with \"{}\"", printable(value.begin().key(), 40));
    }
    return value.dump();
}

/// valijson's visitor, which judges a value, stopped at the first mismatch. valijson's own list of results would have
/// several entries for every wrong value: gigabytes for a hostile file.
class FirstMismatch : public Visitor {
  public:
    FirstMismatch(const json& value, const json::json_pointer& place, int depth, Patterns& patterns)
        : Visitor(Adapter(value), {}, true, nullptr, patterns),
          value_(value),
          place_(place),
          depth_(depth),
          patterns_(patterns) {}

    Mismatch find(const Subschema& schema) {
        Subschema::ApplyFunction visit_this = [&](const Subschema::Constraint& rule) { return rule.accept(*this); };
        if (schema.apply(visit_this)) return std::nullopt;
        if (mismatch_ && has_length_) return std::move(mismatch_);
        return here(fmt::format("expected {}, found {}", schema.hasTitle() ? schema.getTitle() : "another value",
                                describe_value(value_)));
    }

    using Visitor::visit;

    bool visit(const TypeConstraint& constraint) override { return has_type_ = Visitor::visit(constraint); }
    bool visit(const EnumConstraint& constraint) override { return has_type_ = Visitor::visit(constraint); }

    bool visit(const MinItemsConstraint& constraint) override { return check_length(Visitor::visit(constraint)); }
    bool visit(const MaxItemsConstraint& constraint) override { return check_length(Visitor::visit(constraint)); }

    bool visit(const SingularItemsConstraint& constraint) override {
        if (!value_.is_array()) return true;
        for (std::size_t i = 0; i < value_.size(); ++i) {
            if (!fits(value_[i], place_ / i, *constraint.getItemsSubschema())) return false;
        }
        return true;
    }

    bool visit(const LinearItemsConstraint& constraint) override {
        if (!value_.is_array()) return true;
        bool all = true;
        constraint.applyToItemSubschemas([&](std::size_t i, const Subschema* schema) {
            return i < value_.size() && (all = fits(value_[i], place_ / i, *schema));
        });
        return all;
    }

    bool visit(const PropertiesConstraint& constraint) override {
        if (!value_.is_object()) return true;
        constraint.applyToProperties([&](const auto& name, const Subschema* schema) {
            properties_.emplace_back(name.c_str(), schema);
            return true;
        });
        const Subschema* const additional = constraint.getAdditionalPropertiesSubschema();
        if (additional == nullptr && !all_known(properties_)) return false;
        for (const auto& member : value_.items()) {
            const auto known = std::find_if(properties_.begin(), properties_.end(),
                                            [&](const Property& property) { return property.first == member.key(); });
            const Subschema& schema = known == properties_.end() ? *additional : *known->second;
            if (!fits(member.value(), place_ / printable(member.key()), schema)) return false;
        }
        return true;
    }

    bool visit(const RequiredConstraint& constraint) override {
        if (!value_.is_object() || mismatch_) return true;
        constraint.applyToRequiredProperties([&](const auto& name) {
            const std::string key = name.c_str();
            if (!value_.contains(key)) mismatch_ = here(fmt::format("the key \"{}\" is missing", key));
            return !mismatch_;
        });
        return !mismatch_;
    }

    bool visit(const AnyOfConstraint& constraint) override {
        Mismatch deepest, of_this_type;
        int count_of_this_type = 0;
        bool one_fits = false;
        std::vector<Property> properties;
        constraint.applyToSubschemas([&](unsigned, const Subschema* schema) {
            FirstMismatch alternative(value_, place_, depth_, patterns_);
            Mismatch mismatch = alternative.find(*schema);
            one_fits = !mismatch;
            if (one_fits) return false;
            if (alternative.has_type_) {
                ++count_of_this_type;
                of_this_type = mismatch;
            }
            properties.insert(properties.end(), alternative.properties_.begin(), alternative.properties_.end());
            if (!deepest || mismatch->depth > deepest->depth) deepest = std::move(mismatch);
            return true;
        });
        if (one_fits) return true;
        // The clearest reason: inside the value, else the only alternative of its type, else a key unknown to all.
        if (deepest->depth > depth_) {
            mismatch_ = deepest;
        } else if (count_of_this_type == 1) {
            mismatch_ = of_this_type;
        } else if (value_.is_object() && !properties.empty()) {
            all_known(properties);
        }
        return false;
    }

  private:
    using Property = std::pair<std::string, const Subschema*>;

    Mismatch here(std::string reason) const { return SchemaMismatch{place_.to_string(), std::move(reason), depth_}; }

    bool fits(const json& inner, const json::json_pointer& place, const Subschema& schema) {
        mismatch_ = FirstMismatch(inner, place, depth_ + 1, patterns_).find(schema);
        return !mismatch_;
    }

    bool check_length(bool good) {
        has_length_ = has_length_ && good;
        return good;
    }

    /// Notes a key that is not among the properties.
    bool all_known(const std::vector<Property>& properties) {
        std::vector<std::string> names;
        for (const Property& property : properties) names.push_back(property.first);
        for (const auto& member : value_.items()) {
            if (std::find(names.begin(), names.end(), member.key()) != names.end()) continue;
            const std::string key = printable(member.key());
            mismatch_ =
                SchemaMismatch{(place_ / key).to_string(),
                               fmt::format("unknown key \"{}\"{}", key, suggestion(member.key(), names)), depth_};
            return false;
        }
        return true;
    }

    const json& value_;
    const json::json_pointer place_;
    const int depth_;
    Patterns& patterns_;
    bool has_type_ = true;              ///< false: the value is of another type, or none of the values of `enum`
    bool has_length_ = true;            ///< false: the reason is the length of the list, whatever is in it
    std::vector<Property> properties_;  ///< of the schema, where the value is an object
    Mismatch mismatch_;
};

}  // namespace

JsonSchema::JsonSchema(json schema) : compiled_(std::make_unique<valijson::Schema>()) {
    add_titles(schema, json(schema));
    valijson::SchemaParser(valijson::SchemaParser::kDraft7).populateSchema(Adapter(schema), *compiled_);
}

JsonSchema::~JsonSchema() = default;

std::optional<SchemaMismatch> JsonSchema::find_mismatch(const json& document) const {
    // Most documents fit: without places and reasons this takes half the time.
    valijson::Validator validator(valijson::Validator::kStrongTypes);
    if (validator.validate(*compiled_, Adapter(document), nullptr)) return std::nullopt;
    Patterns patterns;
    return FirstMismatch(document, json::json_pointer(), 0, patterns).find(*compiled_);
}

}  // namespace aleph
