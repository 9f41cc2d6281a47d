#include "engine/json/text.h"

#include <fmt/format.h>
#include <locale.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_set>

#include "engine/base/errors.h"
#include "engine/json/json_ref.h"

namespace aleph {

namespace {

using nlohmann::json;

/// The parser reads numbers through strtod; while this lives the calling thread has the classic locale (HARD_CASES
/// DT-09).
class ClassicLocale {
  public:
    ClassicLocale() : classic_(newlocale(LC_ALL_MASK, "C", nullptr)), before_(uselocale(classic_)) {}
    ~ClassicLocale() {
        uselocale(before_);
        freelocale(classic_);
    }
    ClassicLocale(const ClassicLocale&) = delete;
    ClassicLocale& operator=(const ClassicLocale&) = delete;

  private:
    locale_t classic_, before_;
};

std::string line_and_column(std::string_view text, std::size_t offset) {
    std::size_t line = 1, column = 1;
    for (const char c : text.substr(0, offset)) {
        if (c == '\n') {
            ++line;
            column = 1;
        } else if ((static_cast<unsigned char>(c) & 0xc0) !=
                   0x80) {  // the bytes that continue a character count no column
            ++column;
        }
    }
    return fmt::format("line {}, column {}", line, column);
}

/// "[json.exception.parse_error.101] parse error at line 1, column 5: syntax error while ..." to what follows the
/// place.
std::string parser_reason(const std::string& what) {
    const auto column = what.find(", column ");
    const auto colon = what.find(": ", column == std::string::npos ? 0 : column);
    const std::string reason = colon == std::string::npos ? what : what.substr(colon + 2);
    return "not valid JSON: " + printable(reason, 300);
}

/// Builds the value. nlohmann's own builder keeps the last of two equal keys and is silent about it.
class Builder {
  public:
    Builder(std::string_view text, const std::string& file) : text_(text), file_(file) {}

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
        if (!level.keys.insert(level.key).second) throw InputError(file_, pointer(), "this key stands here twice");
        if (levels_.size() == 2) result_.key_order[levels_.front().key].push_back(level.key);
        return true;
    }

    bool parse_error(std::size_t position, const std::string&, const json::exception& error) {
        if (error.id == 406) {
            throw InputError(file_, line_and_column(text_, position - 1), "this number is too large for a double");
        }
        throw InputError(file_, line_and_column(text_, position == 0 ? 0 : position - 1), parser_reason(error.what()));
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
        if (levels_.size() > static_cast<std::size_t>(max_json_depth)) {
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
    JsonText result_;
    std::vector<Level> levels_;
};

std::string format_number(double value) {
    if (value == 0.0 && std::signbit(value)) return "-0.0";  // "-0" would be read as an integer and lose its sign
    return fmt::format("{}", value);
}

bool is_finite(const nlohmann::ordered_json& value) {
    if (value.is_number_float()) return std::isfinite(value.get<double>());
    return !value.is_structured() || std::all_of(value.begin(), value.end(), is_finite);
}

constexpr std::size_t line_width = 110;

/// Appends the value on one line. False where the text grows beyond `longest`; then it is cut off somewhere.
bool append_line(std::string& out, const nlohmann::ordered_json& value, std::size_t longest) {
    if (value.is_number_float()) {
        out += format_number(value.get<double>());
    } else if (!value.is_structured()) {
        out += value.dump();
    } else {
        out += value.is_array() ? '[' : '{';
        const char* separator = "";
        for (auto item = value.begin(); item != value.end(); ++item) {
            out += separator;
            separator = ", ";
            if (value.is_object()) out += nlohmann::ordered_json(item.key()).dump() + ": ";
            if (!append_line(out, *item, longest)) return false;
        }
        out += value.is_array() ? ']' : '}';
    }
    return out.size() <= longest;
}

/// Long lists of numbers, and of lists of whole numbers (faces), have many on a line.
bool is_bulk(const nlohmann::ordered_json& value) {
    const auto is_whole = [](const nlohmann::ordered_json& item) { return item.is_number_integer(); };
    return value.is_array() && std::all_of(value.begin(), value.end(), [&](const nlohmann::ordered_json& item) {
               return item.is_number() || (item.is_array() && std::all_of(item.begin(), item.end(), is_whole));
           });
}

constexpr std::size_t no_limit = std::numeric_limits<std::size_t>::max();

void append_bulk(std::string& out, const nlohmann::ordered_json& list, std::size_t indent) {
    const std::string margin(indent + 2, ' ');
    out += "[\n" + margin;
    std::size_t line = out.size();
    std::string text;
    bool first = true;
    for (const auto& item : list) {
        text.clear();
        append_line(text, item, no_limit);
        if (!first) {
            const bool full = out.size() - line + text.size() + indent + 4 > line_width;
            out += full ? ",\n" + margin : ", ";
            if (full) line = out.size();
        }
        first = false;
        out += text;
    }
    out += '\n' + std::string(indent, ' ') + ']';
}

void append_json(std::string& out, const nlohmann::ordered_json& value, std::size_t indent) {
    if (!value.is_structured() || value.empty()) {
        append_line(out, value, no_limit);
        return;
    }
    const bool is_array = value.is_array();
    out += is_array ? '[' : '{';
    const std::string margin(indent + 2, ' ');
    const char* separator = "\n";
    for (auto item = value.begin(); item != value.end(); ++item) {
        out += separator + margin;
        separator = ",\n";
        if (!is_array) out += nlohmann::ordered_json(item.key()).dump() + ": ";
        const std::size_t start = out.size();
        if (append_line(out, *item, start + line_width - std::min(indent, line_width))) continue;
        out.resize(start);
        if (is_bulk(*item)) {
            append_bulk(out, *item, indent + 2);
        } else {
            append_json(out, *item, indent + 2);
        }
    }
    out += '\n' + std::string(indent, ' ') + (is_array ? ']' : '}');
}

constexpr const char* large_mesh_advice =
    "keep large meshes and long lists of points in a .glb or .abc file and include that, or raise --load-memory "
    "(LoadLimits)";

}  // namespace

JsonText parse_json_text(std::string_view text, const std::string& file, const LoadLimits& limits) {
    if (text.size() > limits.text()) {
        throw InputError(file, "",
                         fmt::format("the text is larger than {} MiB; {}", limits.text() >> 20, large_mesh_advice));
    }
    check_json_memory(text, true, limits, file, large_mesh_advice);
    const ClassicLocale classic;
    Builder builder(text, file);
    json::sax_parse(text, &builder, json::input_format_t::json, true, true);
    return builder.take();
}

std::string format_json(const nlohmann::ordered_json& value, const std::string& file) {
    if (!is_finite(value)) throw InputError(file, "", "a number that should be written is not finite");
    try {
        std::string out;
        append_json(out, value, 0);
        return out + '\n';
    } catch (const json::type_error& error) {
        throw InputError(file, "", "a name or a path is not UTF-8: " + printable(error.what(), 300));
    }
}

}  // namespace aleph
