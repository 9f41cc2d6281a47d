#pragma once
// JSON inside a page.

#include <nlohmann/json.hpp>
#include <string>

namespace aleph {

/// JSON for a script element, which a "</script>" in a text must not end.
inline std::string script_json(const nlohmann::ordered_json& json) {
    std::string text;
    for (const char c : json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)) {
        if (c == '<') {
            text += "\\u003c";
        } else {
            text += c;
        }
    }
    return text;
}

}  // namespace aleph
