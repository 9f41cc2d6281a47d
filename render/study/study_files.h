#pragma once
// The results of a study as files: JSON and CSV.

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "render/study/run_study.h"

namespace aleph {

/// Facts that the files state about how the study was made.
struct StudyContext {
    std::string command;  ///< of the user
    std::string date;     ///< "2026-01-31T12:00:00Z" (study_date)
    int threads = 1;
    std::filesystem::path folder;  ///< of the files; those of pictures are told relative to it
};

/// Now, or SOURCE_DATE_EPOCH where the environment has it.
std::string study_date();

/// Everything but the pictures: title, host, build, axes, metrics, and per variant the settings, means, and frames with
/// metrics, stages, rays and effects plan. scenes/studies/README.md describes it.
nlohmann::ordered_json study_json(const PreparedStudy& prepared, const StudyResults& results,
                                  const StudyContext& context);

/// A row per variant and frame: scene, frame, variant, its settings, then every metric with its standard error. Fields
/// with commas, quotes or line ends are quoted (RFC 4180). Numbers have a decimal point in every locale; a value that
/// is not known is empty.
std::string study_csv(const PreparedStudy& prepared, const StudyResults& results);

/// A number with as many significant digits, or as a whole number where it has more digits before the point: 100, not
/// 1e+02.
std::string brief(double value, int digits);

/// Describes the reference and its noise in a sentence.
std::string describe_reference(const PreparedStudy& prepared, const StudyResults& results);

}  // namespace aleph
