#pragma once
// Output of `aleph study`: text and files.

#include <filesystem>
#include <iosfwd>
#include <string>
#include <vector>

#include "render/cli/support/output_path.h"
#include "render/study/effects_ledger.h"
#include "render/study/run_study.h"
#include "render/study/study_files.h"

namespace aleph {

using TableRow = std::vector<std::string>;

/// Prints a table, its first row as the head: the first column left-aligned, the others right-aligned.
void print_rows(const std::vector<TableRow>& rows, bool markdown, std::ostream& out);

/// "pool-study" for pool/scene.json or studies/pool.json, in the current folder.
std::filesystem::path study_folder(const std::filesystem::path& file);

/// The files that write_study may write.
std::vector<OutputFile> study_files(const std::filesystem::path& folder);

/// This process's command line, for the results to say how they were made.
std::string study_command_line();

/// The title, what judges, and a row per variant with the means over its frames.
void print_study(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out);

/// For each scene a table of its variants, the best fixed settings, and what these take beside the study's own
/// variants.
/// @param results  of search_study
void print_search(const PreparedStudy& prepared, const StudyResults& results, bool markdown, std::ostream& out);

/// Prints, scene by scene, what each effect costs and what a viewer misses without it.
void print_ledger(const std::vector<SceneLedger>& ledgers, bool markdown, std::ostream& out);

/// Files that write_study writes beside the usual ones.
struct StudyExtras {
    bool viewer_test = false;         ///< viewer-test.html
    std::vector<std::string> errors;  ///< names of variants, for errors.jpg; empty: those of a ledger, if there is one
};

/// Writes study.json, study.csv and report.html (where the page was built) into the folder of the context, and says
/// which on standard error.
/// @throws OutputError
void write_study(const PreparedStudy& prepared, const StudyResults& results, const StudyContext& context,
                 const StudyExtras& extras, bool quiet);

}  // namespace aleph
