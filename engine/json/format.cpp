#include "engine/json/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "engine/base/errors.h"

namespace aleph {

namespace {

std::string format_number(double value) {
    if (value == 0.0 && std::signbit(value)) return "-0.0";  // "-0" would be read as an integer and lose its sign
    return fmt::format("{}", value);
}

bool is_finite(const nlohmann::ordered_json& value) {
    if (value.is_number_float()) return std::isfinite(value.get<double>());
    return !value.is_structured() || std::all_of(value.begin(), value.end(), is_finite);
}

constexpr std::size_t line_width = 110;

/// Appends the value on one line. False where the text becomes longer than `max_length`; then it is incomplete.
bool append_line(std::string& out, const nlohmann::ordered_json& value, std::size_t max_length) {
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
            if (!append_line(out, *item, max_length)) return false;
        }
        out += value.is_array() ? ']' : '}';
    }
    return out.size() <= max_length;
}

/// Lists of numbers and of lists of whole numbers (faces): several elements on each line.
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

}  // namespace

std::string format_json(const nlohmann::ordered_json& value, const std::string& file) {
    if (!is_finite(value)) throw InputError(file, "", "a number that should be written is not finite");
    try {
        std::string out;
        append_json(out, value, 0);
        return out + '\n';
    } catch (const nlohmann::json::type_error& error) {
        throw InputError(file, "", "a name or a path is not UTF-8: " + printable(error.what(), 300));
    }
}

}  // namespace aleph
