#include "engine/json/close_names.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr std::size_t longest_compared = 64;   // bytes; the distance costs their square
constexpr std::size_t most_compared = 100000;  // names
constexpr std::size_t most_listed = 6;

char lower(char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Damerau-Levenshtein distance (swaps of neighbours count one), letters regardless of case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
    std::vector<std::size_t> before(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
    for (std::size_t j = 0; j <= b.size(); ++j) last[j] = j;
    for (std::size_t i = 1; i <= a.size(); ++i) {
        row[0] = i;
        for (std::size_t j = 1; j <= b.size(); ++j) {
            const bool same = lower(a[i - 1]) == lower(b[j - 1]);
            row[j] = std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (same ? 0 : 1)});
            if (i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1])) {
                row[j] = std::min(row[j], before[j - 2] + 1);
            }
        }
        std::swap(before, last);
        std::swap(last, row);
    }
    return last[b.size()];
}

std::string quoted(const std::string& name) {
    return '"' + printable(name, 64) + '"';
}

std::string join(const std::vector<std::string>& names) {
    std::vector<std::string> out;
    for (const std::string& name : names) out.push_back(quoted(name));
    const std::string last = out.back();
    out.pop_back();
    return out.empty() ? last : fmt::format("{} or {}", fmt::join(out, ", "), last);
}

}  // namespace

std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& known) {
    if (name.empty() || name.size() > longest_compared) return {};
    std::vector<std::pair<std::size_t, std::string>> found;
    for (std::size_t i = 0; i < std::min(known.size(), most_compared); ++i) {
        const std::string& candidate = known[i];
        if (candidate.empty() || candidate.size() > longest_compared) continue;
        const std::size_t allowed = std::max<std::size_t>(1, std::max(name.size(), candidate.size()) / 3);
        const std::size_t distance = edit_distance(name, candidate);
        const bool part = name.size() >= 3 && candidate.size() >= 3 &&
                          (candidate.find(name) != std::string::npos || name.find(candidate) != std::string_view::npos);
        if (distance <= allowed || part) found.emplace_back(distance, candidate);
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    std::vector<std::string> names;
    for (const auto& [distance, candidate] : found) {
        if (names.size() == 3) break;
        names.push_back(candidate);
    }
    return names;
}

std::string suggestion(std::string_view name, const std::vector<std::string>& known) {
    const std::vector<std::string> close = close_names(name, known);
    if (!close.empty()) return fmt::format("; did you mean {}?", join(close));
    if (known.empty() || known.size() > most_listed) return "";
    return fmt::format("; there is {}", join(known));
}

}  // namespace aleph
