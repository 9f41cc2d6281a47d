#pragma once
// "Did you mean ...?": known names that are close to an unknown one.

#include <string>
#include <string_view>
#include <vector>

namespace aleph {

/// "a, b or c". @param choices  at least one
std::string join_choices(const std::vector<std::string>& choices);

/// Up to three names that differ from `name` by a few letters (a third of them; at least two, one in names of one or
/// two letters; regardless of case), or of which one contains the other. Nearest first, then in the order given.
std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& known);

/// `; did you mean "a" or "b"?`, or nothing where no name is close.
std::string close_suggestion(std::string_view name, const std::vector<std::string>& known);

/// The same. Where no name is close, `; there is "a" or "b"` with up to six names, else nothing.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace aleph
