#pragma once
// `aleph render --budget SECONDS`: the error whose frames are predicted to take that long.

#include <string>

#include "render/cli/scene_options.h"
#include "render/output/frame_files.h"
#include "render/settings/measure.h"

namespace aleph {

struct Budget {
    BudgetStatistics statistics;
    StageClock clock;  ///< since the command began: loading and choosing count as well
};

/// Measures some of the frames (cost_pilot.h) at falling errors and chooses the error. Beyond the least that a
/// prediction needs, it goes on while all measurements are expected to take at most .15 of the budget, and while the
/// budget is predicted to reach the last error measured.
/// @param prepared  gets the settings of the error
/// @param budget    says what is asked for; gets the rest of its statistics but `took`
void apply_budget(PreparedScene& prepared, const SceneOptions& options, Budget& budget);

/// "budget 60 s: error 1.3 chosen, predicted 55 s (pilot 2.1 s)", before the frames are rendered.
std::string describe_choice(const BudgetStatistics& budget);

/// "budget 60 s: error 1.3 chosen, predicted 55 s, took 58 s", afterwards.
std::string describe_budget(const BudgetStatistics& budget);

}  // namespace aleph
