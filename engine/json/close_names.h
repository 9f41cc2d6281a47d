#pragma once
// "Did you mean": the known names nearest to one that is not known.

#include <string>
#include <string_view>
#include <vector>

namespace aleph {

/// Up to three of the names that are a slip away from `name` (a third of its letters, at least one, are different,
/// missing or swapped) or that contain it or lie in it; nearest first, then as given.
std::vector<std::string> close_names(std::string_view name, const std::vector<std::string>& known);

/// `; did you mean "a" or "b"?`, or nothing where no name is close. Few names are listed in full.
std::string suggestion(std::string_view name, const std::vector<std::string>& known);

}  // namespace aleph
