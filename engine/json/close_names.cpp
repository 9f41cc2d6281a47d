#include "engine/json/close_names.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr std::size_t max_compared_length = 64;  // bytes; the distance costs their square
constexpr std::size_t max_compared = 100000;     // names
constexpr std::size_t max_suggested = 3;
constexpr std::size_t max_listed = 6;

/// Number of changed, missing or added letters up to which two names are close; a swap of neighbours counts two.
std::size_t max_distance(std::size_t length) {
    return std::max<std::size_t>(length >= 3 ? 2 : 1, length / 3);
}

std::string join_quoted(std::vector<std::string> names) {
    for (std::string& name : names) name = '"' + printable(name, 64) + '"';
    return join_choices(names);
}

}  // namespace

std::string join_choices(const std::vector<std::string>& choices) {
    std::string text = choices.front();
    for (std::size_t i = 1; i < choices.size(); ++i) text += (i + 1 < choices.size() ? ", " : " or ") + choices[i];
    return text;
}

std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& known) {
    if (name.empty() || name.size() > max_compared_length) return {};
    const std::string lower_name = OIIO::Strutil::lower(std::string(name));
    std::vector<std::pair<std::size_t, std::string>> found;
    for (std::size_t i = 0; i < std::min(known.size(), max_compared); ++i) {
        const std::string& candidate = known[i];
        if (candidate.empty() || candidate.size() > max_compared_length) continue;
        const std::size_t distance = OIIO::Strutil::edit_distance(lower_name, OIIO::Strutil::lower(candidate));
        const bool part = name.size() >= 3 && candidate.size() >= 3 &&
                          (candidate.find(name) != std::string::npos || name.find(candidate) != std::string_view::npos);
        if (part || distance <= max_distance(std::max(name.size(), candidate.size()))) {
            found.emplace_back(distance, candidate);
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    if (found.size() > max_suggested) found.resize(max_suggested);
    std::vector<std::string> names;
    for (const auto& [distance, candidate] : found) names.push_back(candidate);
    return names;
}

std::string close_suggestion(std::string_view name, const std::vector<std::string>& known) {
    const std::vector<std::string> close = close_names(name, known);
    return close.empty() ? "" : fmt::format("; did you mean {}?", join_quoted(close));
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
    const std::string close = close_suggestion(name, known);
    if (!close.empty()) return close;
    if (known.empty() || known.size() > max_listed) return "";
    return fmt::format("; there is {}", join_quoted(known));
}

}  // namespace aleph
