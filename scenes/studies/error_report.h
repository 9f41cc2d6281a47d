#pragma once
// Tables and JSON of what study_error measured.

#include "scenes/studies/error_runs.h"
#include "scenes/studies/study_table.h"

namespace aleph {

/// The runs with `error` beside the best fixed settings, at one share of pixels beyond.
struct EqualShare {
    std::string frame;
    ShareGoal goal;
    std::string asked;              ///< whose share it is: of "--error 1", or the percentage itself
    std::optional<FrameCost> cost;  ///< of the run with `error`; none for a bare percentage
    std::optional<FixedCost> fixed;
};

/// All of one frame.
struct ErrorStudy {
    JudgedFrame frame;
    PictureError noise;                                ///< of the reference (multiples against itself)
    std::optional<LuminanceDifference> against_paths;  ///< of the reference, if it was compared
    std::vector<ErrorRun> runs;                        ///< with settings as they are, `error` and stopping rules
    std::vector<ErrorRun> fixed;                       ///< the ladder's
    std::vector<EqualShare> shares;
};

/// What the program itself says of its error: the share of pixels beyond, percent. Nothing if it makes no statement.
std::optional<double> claimed_percent(const ErrorRun& run);

void print_references(const std::vector<ErrorStudy>& studies, bool markdown);
StudyTable start_run_table(const std::vector<double>& multiples, bool markdown);
void add_run(const StudyTable& table, const JudgedFrame& frame, const ErrorRun& run);
void print_stages(const std::vector<ErrorStudy>& studies, bool markdown);
/// What the program said of its errors, beside what they were.
void print_claims(const std::vector<ErrorStudy>& studies, bool markdown);
void print_shares(const std::vector<ErrorStudy>& studies, bool markdown);

/// Everything, as JSON.
/// @throws OutputError naming the file
void write_report(const std::string& file, const std::vector<ErrorStudy>& studies);

}  // namespace aleph
