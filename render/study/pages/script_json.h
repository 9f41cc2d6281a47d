#pragma once
// Data in a page.

#include <OpenImageIO/strutil.h>

#include <nlohmann/json.hpp>
#include <string>

#include "engine/base/errors.h"

namespace aleph {

/// A script element of JSON, which a "</script>" in a text must not end.
inline std::string script_json(const char* id, const nlohmann::ordered_json& json) {
    const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
    return std::string("<script id=\"") + id + "\" type=\"application/json\">" +
           OIIO::Strutil::replace(text, "<", "\\u003c", true) + "</script>";
}

/// @param place  a comment of the page that the text is put in the place of
inline void insert(std::string& page, std::string_view place, const std::string& text) {
    const std::size_t at = page.find(place);
    ALEPH_CHECK(at != std::string::npos, std::string(place));
    page.replace(at, place.size(), text);
}

}  // namespace aleph
