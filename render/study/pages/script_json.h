#pragma once
// JSON inside a page.

#include <OpenImageIO/strutil.h>

#include <nlohmann/json.hpp>
#include <string>

namespace aleph {

/// JSON for a script element, which a "</script>" in a text must not end.
inline std::string script_json(const nlohmann::ordered_json& json) {
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return OIIO::Strutil::replace(text, "<", "\\u003c", true);
}

}  // namespace aleph
