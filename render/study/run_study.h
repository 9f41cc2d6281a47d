#pragma once
// Runs a study: references and thresholds of its frames, then every variant that is not finished yet.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/study/measure_run.h"
#include "render/study/prepared_study.h"

namespace aleph {

struct StudyResults {
    std::vector<VariantResult> variants;
    std::vector<JudgingFrame> frames;
    std::vector<StudyJudge> judges;   ///< beside the thresholds of the viewers; nothing of them is run
    std::size_t made = 0, found = 0;  ///< runs that were rendered, and those that were finished before
};

/// Called as the study goes on: the share that is done, 0 to 1, and what is being done.
using StudyProgress = std::function<void(double share, const std::string& what)>;

/// Every variant is rendered once before any is repeated, so that a machine that gets slower slows all of them.
/// @param folder  keeps references and finished runs (RunStore); those of an earlier call are not made again
/// @throws InputError, OutputError
StudyResults run_study(const PreparedStudy& prepared, const std::filesystem::path& folder,
                       const StudyProgress& progress = {});

/// A part of a study's references and runs: every count-th from the index-th on, from 0.
struct StudyPart {
    std::size_t index = 0, count = 1;
};

/// References and runs that a study needs, and those of them that its folder has.
struct StudyCount {
    std::size_t references = 0, runs = 0, finished_references = 0, finished_runs = 0;

    bool is_finished() const { return finished_references == references && finished_runs == runs; }
};

/// Counts what run_study would find. It must use as many threads.
/// @throws InputError
StudyCount count_finished(const PreparedStudy& prepared, const std::filesystem::path& folder);

/// Makes what belongs to a part and is not finished, and compares nothing. Once all parts are there, run_study finds
/// them; it must use as many threads.
/// @throws InputError, OutputError
void make_part(const PreparedStudy& prepared, const std::filesystem::path& folder, const StudyPart& part,
               const StudyProgress& progress = {});

}  // namespace aleph
