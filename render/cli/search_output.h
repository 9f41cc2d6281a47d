#pragma once
// What a search found, as text.

#include <iosfwd>

#include "render/study/run_study.h"

namespace aleph {

/// For each scene a table of its variants, the best fixed settings, and what these take beside the study's own
/// variants.
/// @param results  of search_study
void print_search(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out);

}  // namespace aleph
