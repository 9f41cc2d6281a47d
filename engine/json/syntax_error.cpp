#include "engine/json/syntax_error.h"

#include <algorithm>

#include "engine/base/errors.h"

namespace aleph {

namespace {

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

}  // namespace

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

}  // namespace aleph
