#pragma once
// The results of a study as one HTML file that opens from disk.

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>

#include "render/study/run_study.h"

namespace aleph {

/// The bundled page with places for data; empty where the program was built without it (render/report/README.md).
std::string_view report_template();

/// A report holds at most about so many bytes: what does not fit is left out, the least needed maps of the variants
/// that others beat first.
inline constexpr std::size_t most_report_bytes = 24'000'000;

/// The page of a study.
/// @param page  report_template()
/// @param json  study_json
/// @throws InputError if a picture of a run cannot be read; std::logic_error if the page has no places for data
std::string make_report(std::string_view page, nlohmann::ordered_json json, const StudyResults& results,
                        std::size_t most_bytes = most_report_bytes);

/// How the maps of a report are shown, and the steps from a pixel's motion to its error: what the page lists.
nlohmann::ordered_json report_maps();
nlohmann::ordered_json report_walk(const StudyResults& results);

}  // namespace aleph
