#pragma once
// Where the errors of variants lie: a sheet of their frames.

#include <filesystem>
#include <string>
#include <vector>

#include "render/study/run_study.h"

namespace aleph {

/// @throws InputError (--errors) if no variant has this name
void check_variant_name(const PreparedStudy& prepared, const std::string& variant);

/// A row per frame: for each variant its picture, and for each viewer the error of its luminance in visible thresholds,
/// .1 to 10.
/// @param path      PNG, or JPEG if it ends in .jpg
/// @param variants  names of variants (check_variant_name)
/// @throws OutputError
void write_error_sheet(const std::filesystem::path& path, const PreparedStudy& prepared, const StudyResults& results,
                       const std::vector<std::string>& variants);

}  // namespace aleph
