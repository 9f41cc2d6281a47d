#pragma once
// What `aleph study` prints and writes.

#include <filesystem>
#include <iosfwd>
#include <string>

#include "render/study/run_study.h"
#include "render/study/study_files.h"

namespace aleph {

/// "pool-study" for pool/scene.json or studies/pool.json, in the current folder.
std::filesystem::path study_folder(const std::filesystem::path& file);

/// This process's command line, for the results to say how they were made.
std::string study_command_line();

/// A row per variant, with the means over its frames.
void print_study(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out);

/// Writes study.json, study.csv, study.png (where gnuplot is installed) and report.html (where the page was built), and
/// says which on standard error.
/// @param viewer_test  also writes viewer-test.html
/// @param errors       name of a variant, for errors.jpg; may be empty
/// @throws OutputError
void write_study(const PreparedStudy& prepared, const StudyResults& results, const StudyContext& context,
                 const std::filesystem::path& folder, bool viewer_test, const std::string& errors, bool quiet);

}  // namespace aleph
