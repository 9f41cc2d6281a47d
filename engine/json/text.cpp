#include "engine/json/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_set>

#include "engine/base/errors.h"

namespace aleph {

namespace {

using nlohmann::json;

std::string line_and_column(std::string_view text, std::size_t offset) {
    std::size_t line = 1, column = 1;
    for (const char c : text.substr(0, offset)) {
        if (c == '\n') {
            ++line;
            column = 1;
        } else if ((static_cast<unsigned char>(c) & 0xc0) != 0x80) {  // not a continuation byte of UTF-8
            ++column;
        }
    }
    return fmt::format("line {}, column {}", line, column);
}

/// Position of the last character of the comment that begins at `at`; `at` if none does.
std::size_t skip_json_comment(std::string_view text, std::size_t at) {
    const std::string_view start = text.substr(at, 2);
    if (start != "//" && start != "/*") return at;
    const std::size_t end = text.find(start == "//" ? "\n" : "*/", at + 2);
    return end == std::string_view::npos ? text.size() : end + (start == "//" ? 0 : 1);
}

/// Refuses a text whose values would take more than limits.json_values().
/// @param advice  what to do about it
void check_json_memory(std::string_view text, bool comments, const LoadLimits& limits, const std::string& file,
                       std::string_view advice) {
    const std::size_t bytes = estimate_json_memory(text, comments);
    if (bytes <= limits.json_values()) return;
    throw InputError(file, "",
                     fmt::format("its JSON holds so many values that they would take about {} MiB, more than {}; {}",
                                 bytes >> 20, limits.json_values() >> 20, advice));
}

/// Why a text is not JSON, in plain words.
struct SyntaxError {
    std::size_t offset = 0;  ///< of the byte to look at
    std::string reason;
};

/// The part after the place of "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error ...".
std::string parser_reason(const std::string& what) {
    const auto column = what.find(", column ");
    const auto colon = what.find(": ", column == std::string::npos ? 0 : column);
    return printable(colon == std::string::npos ? what : what.substr(colon + 2), 300);
}

/// Where the token that ends at `position` begins. The parser keeps the bytes of strings and numbers only.
std::size_t token_start(std::string_view text, std::size_t position, std::string_view token) {
    const auto is_letter = [](char c) { return c >= 'a' && c <= 'z'; };
    std::size_t start = position - 1;
    if (std::string_view("{}[]").find(text[start]) != std::string_view::npos) return start;
    if (!is_letter(text[start])) return position - std::min(std::max<std::size_t>(token.size(), 1), position);
    while (start > 0 && is_letter(text[start - 1])) --start;
    return start;
}

bool begins_value(char c) {
    return c == '"' || c == '{' || c == '[' || c == '-' || (c >= '0' && c <= '9') || c == 't' || c == 'f' || c == 'n';
}

/// Recognizes a missing comma and one too many. Other reasons are the parser's.
/// @param position  bytes read when the parser stopped
/// @param token     the bytes of the last token
/// @param what      the message of nlohmann's parser
SyntaxError explain_syntax_error(std::string_view text, std::size_t position, std::string_view token,
                                 const std::string& what) {
    if (position > 0 && position <= text.size() && what.find("unexpected end of input") == std::string::npos) {
        const std::size_t start = token_start(text, position, token);
        const std::size_t before = start == 0 ? std::string_view::npos : text.find_last_not_of(" \t\r\n", start - 1);
        const char first = text[start];
        const bool closing_expected =
            what.find("; expected '}'") != std::string::npos || what.find("; expected ']'") != std::string::npos;
        const bool apart = start > before + 1 || std::string_view("{[\"").find(first) != std::string_view::npos;
        if (before != std::string_view::npos && apart && closing_expected && begins_value(first)) {
            return {before + 1, "not valid JSON: a comma is missing here"};
        }
        if (before != std::string_view::npos && text[before] == ',' && (first == '}' || first == ']')) {
            return {before, "not valid JSON: this comma is one too many"};
        }
    }
    return {position == 0 ? 0 : position - 1, "not valid JSON: " + parser_reason(what)};
}

/// Builds the value, and refuses a text with the place and a plain reason. nlohmann's own builder silently keeps the
/// last of two equal keys.
class Builder {
  public:
    /// @param unique_keys  refuses a key that is there twice
    Builder(std::string_view text, const std::string& file, bool unique_keys)
        : text_(text), file_(file), unique_keys_(unique_keys) {}

    bool null() { return add(nullptr); }
    bool boolean(bool value) { return add(value); }
    bool number_integer(json::number_integer_t value) { return add(value); }
    bool number_unsigned(json::number_unsigned_t value) { return add(value); }
    bool number_float(json::number_float_t value, const std::string&) { return add(value); }
    bool string(std::string& value) { return add(std::move(value)); }
    bool binary(json::binary_t&) { return false; }
    bool start_object(std::size_t) { return open(json::object()); }
    bool start_array(std::size_t) { return open(json::array()); }
    bool end_object() { return close(); }
    bool end_array() { return close(); }

    bool key(std::string& name) {
        Level& level = levels_.back();
        level.key = std::move(name);
        if (unique_keys_ && !level.keys.insert(level.key).second)
            throw InputError(file_, pointer(), "this key is here twice");
        if (levels_.size() == 2) result_.key_order[levels_.front().key].push_back(level.key);
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token, const json::exception& error) {
        if (error.id == 406) {
            throw InputError(file_, line_and_column(text_, position - 1), "this number is too large for a double");
        }
        const SyntaxError found = explain_syntax_error(text_, position, token, error.what());
        throw InputError(file_, line_and_column(text_, found.offset), found.reason);
    }

    JsonText take() { return std::move(result_); }

  private:
    struct Level {
        json* container = nullptr;
        std::string key;
        std::unordered_set<std::string> keys;
    };

    bool add(json&& value) {
        insert(std::move(value));
        return true;
    }

    json* insert(json&& value) {
        if (levels_.empty()) {
            result_.root = std::move(value);
            return &result_.root;
        }
        Level& level = levels_.back();
        if (level.container->is_array()) {
            level.container->push_back(std::move(value));
            return &level.container->back();
        }
        return &((*level.container)[level.key] = std::move(value));
    }

    bool open(json&& container) {
        json* inserted = insert(std::move(container));
        levels_.push_back({inserted, {}, {}});
        if (levels_.size() > max_json_depth) {
            throw InputError(file_, "", fmt::format("nested more than {} deep", max_json_depth));
        }
        return true;
    }

    bool close() {
        levels_.pop_back();
        return true;
    }

    std::string pointer() const {
        json::json_pointer path;
        for (const Level& level : levels_) {
            if (level.container->is_array()) {
                path /= level.container->size() - 1;
            } else {
                path /= printable(level.key);
            }
        }
        return path.to_string();
    }

    std::string_view text_;
    const std::string& file_;
    bool unique_keys_;
    JsonText result_;
    std::vector<Level> levels_;
};

constexpr const char* large_mesh_advice =
    "keep large meshes and long lists of points in a .glb or .abc file and include that, or raise --load-memory "
    "(LoadLimits)";

}  // namespace

std::size_t estimate_json_memory(std::string_view text, bool comments) {
    constexpr std::size_t element = 48, container = 96, member = 250, string = 48;
    std::size_t bytes = 0, string_start = 0;
    bool in_string = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        const char c = text[i];
        if (in_string) {
            if (c == '\\') ++i;
            if (c != '"') continue;
            in_string = false;
            bytes += string + i - string_start;
        } else if (c == '"') {
            in_string = true;
            string_start = i;
        } else if (c == '/' && comments) {
            i = skip_json_comment(text, i);
        } else if (c == ',') {
            bytes += element;
        } else if (c == ':') {
            bytes += member;
        } else if (c == '[' || c == '{') {
            bytes += element + container;
        }
    }
    return bytes;
}

nlohmann::json parse_strict_json(std::string_view text, const std::string& file, const LoadLimits& limits,
                                 std::string_view advice) {
    if (text.size() > max_json_bytes) {
        throw InputError(file, "",
                         fmt::format("the JSON text has {} bytes, more than {}", text.size(), max_json_bytes));
    }
    check_json_memory(text, false, limits, file, advice);
    Builder builder(text, file, false);
    json::sax_parse(text, &builder, json::input_format_t::json, true, false);
    return builder.take().root;
}

JsonText parse_json_text(std::string_view text, const std::string& file, const LoadLimits& limits) {
    if (text.size() > limits.text()) {
        throw InputError(file, "",
                         fmt::format("the text is larger than {} MiB; {}", limits.text() >> 20, large_mesh_advice));
    }
    check_json_memory(text, true, limits, file, large_mesh_advice);
    Builder builder(text, file, true);
    json::sax_parse(text, &builder, json::input_format_t::json, true, true);
    return builder.take();
}

}  // namespace aleph
