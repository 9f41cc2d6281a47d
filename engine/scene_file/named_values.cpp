#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <unordered_map>
#include <vector>

#include "engine/json/close_names.h"
#include "engine/json/json_ref.h"
#include "engine/json/text.h"
#include "engine/scene_file/reader.h"

namespace aleph {

namespace {

using nlohmann::json;

bool is_use(const json& value) {
    return value.is_object() && value.size() == 1 && value.begin().key() == "named" && value.begin()->is_string();
}

/// Members whose own keys are names: {"named": "oak"} there is no use of a value.
bool has_names_for_keys(std::string_view key) {
    return key == "images" || key == "materials";
}

struct Extent {
    std::size_t bytes = 0;  ///< upper estimate as by estimate_json_memory
    int depth = 0;          ///< of lists and objects
};

Extent measure(const json& value) {
    Extent all{.bytes = 48, .depth = 0};
    if (value.is_string()) all.bytes += value.get_ref<const std::string&>().size();
    if (!value.is_structured()) return all;
    all.bytes += 96;
    for (const auto& member : value.items()) {
        const Extent inner = measure(member.value());
        all.bytes += inner.bytes + (value.is_object() ? 250 + member.key().size() : 0);
        all.depth = std::max(all.depth, inner.depth);
    }
    ++all.depth;
    return all;
}

class NamedValues {
  public:
    NamedValues(json& root, const std::string& file, std::size_t bytes, const LoadLimits& limits)
        : root_(root), at_root_(root, file), limits_(limits), bytes_(bytes) {
        if (const auto named = root.find("named"); named != root.end() && named->is_object()) {
            for (const auto& member : named->items()) {
                values_[member.key()].value = &member.value();
                names_.push_back(member.key());
            }
        }
    }

    void replace_all() {
        for (const std::string& name : names_) finish(name, at_root_, 2);
        replace_inside(root_, at_root_, 1);
    }

  private:
    struct Value {
        json* value = nullptr;
        bool open = false, done = false;  ///< being finished; holds no uses
        Extent extent;                    ///< when done
    };

    /// @param depth  of the value in the document
    void replace(json& value, const JsonRef& at, int depth) {
        if (is_use(value))
            put(value, at, depth);
        else
            replace_inside(value, at, depth);
    }

    void replace_inside(json& value, const JsonRef& at, int depth) {
        if (!value.is_structured()) return;
        check_depth(depth, at);
        if (value.is_array()) {
            for (std::size_t i = 0; i < value.size(); ++i) {
                if (value[i].is_structured()) replace(value[i], at[i], depth + 1);
            }
            return;
        }
        for (const auto& member : value.items()) {
            if (!member.value().is_structured()) continue;
            if (depth == 1 && (member.key() == "named" || member.key() == "settings")) continue;
            const JsonRef inner = at.require(member.key());
            if (has_names_for_keys(member.key()))
                replace_inside(member.value(), inner, depth + 1);
            else
                replace(member.value(), inner, depth + 1);
        }
    }

    void put(json& use, const JsonRef& at, int depth) {
        const std::string name = use.begin()->get<std::string>();
        if (!values_.contains(name)) {
            at.fail(fmt::format("there is no named value \"{}\"{}", printable(name), suggestion(name, names_)));
        }
        const Value& found = finish(name, at, depth + 1);
        check_depth(depth + found.extent.depth - 1, at);
        bytes_ += found.extent.bytes;
        if (bytes_ > limits_.json_values()) {
            at.fail(fmt::format("up to here the named values and their copies take more than {} MiB",
                                limits_.json_values() >> 20));
        }
        use = json(*found.value);
    }

    /// The value without uses of others in it.
    /// @param depth  limits the recursion through values that use values
    const Value& finish(const std::string& name, const JsonRef& at, int depth) {
        Value& found = values_.at(name);
        if (found.done) return found;
        if (found.open) at.fail(fmt::format("the named value \"{}\" holds itself{}", printable(name), through(name)));
        check_depth(depth, at);
        found.open = true;
        open_.push_back(name);
        const JsonRef at_named = at_root_.require("named");
        replace(*found.value, at_named.require(name), depth);
        open_.pop_back();
        found.extent = measure(*found.value);
        found.done = true;
        return found;
    }

    std::string through(const std::string& name) const {
        std::vector<std::string> others;
        for (auto other = open_.rbegin(); *other != name && others.size() < 4; ++other)
            others.push_back('"' + printable(*other) + '"');
        return others.empty() ? "" : fmt::format(", through {}", fmt::join(others, ", "));
    }

    static void check_depth(int depth, const JsonRef& at) {
        if (depth > max_json_depth) {
            at.fail(fmt::format("with its named values this is nested more than {} deep", max_json_depth));
        }
    }

    json& root_;
    const JsonRef at_root_;
    const LoadLimits& limits_;
    std::size_t bytes_;
    std::unordered_map<std::string, Value> values_;
    std::vector<std::string> names_, open_;
};

}  // namespace

void replace_named_values(json& root, std::string_view text, const std::string& file, const LoadLimits& limits) {
    if (!root.is_object()) return;
    NamedValues(root, file, root.contains("named") ? estimate_json_memory(text, true) : 0, limits).replace_all();
}

InputError with_definition(const InputError& error, const json& root) {
    const auto named = root.find("named");
    if (named == root.end() || !named->is_object() || error.place().starts_with("/settings")) return error;
    std::vector<std::string> tokens;  // of the place, the last first
    for (json::json_pointer place(error.place()); !place.empty(); place.pop_back()) tokens.push_back(place.back());
    const json* value = &root;
    json::json_pointer defined;  // place of the value, from its last definition on
    for (; !tokens.empty(); tokens.pop_back()) {
        const json::json_pointer token = json::json_pointer() / tokens.back();
        if (!value->contains(token)) break;
        value = &value->at(token);
        if (!defined.empty()) defined /= token;
        for (int i = 0; i < max_json_depth && is_use(*value); ++i) {
            const auto found = named->find(value->begin()->get<std::string>());
            if (found == named->end()) break;
            defined = json::json_pointer("/named") / found.key();
            value = &*found;
        }
    }
    if (defined.empty()) return error;
    return {error.file(), error.place(),
            fmt::format("{}; this value is defined at {}", error.reason(), printable(defined.to_string(), 300))};
}

}  // namespace aleph
