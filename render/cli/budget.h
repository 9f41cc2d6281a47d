#pragma once
// `aleph render --budget SECONDS`: the error whose frames are predicted to take that long.

#include <string>
#include <vector>

#include "render/budget/cost_model.h"
#include "render/cli/scene_options.h"
#include "render/output/frame_files.h"

namespace aleph {

/// @throws InputError (--budget) if the error is asked for as well, or a cache file, which is for one error
void refuse_beside_budget(const SceneOptions& options, const std::string& cache);

/// The settings with which the frames would have this error: as --error would set them.
RenderSettings settings_for_error(const Scene& scene, const SceneOptions& options, double error);

/// Measures some of the frames (cost_pilot.h) at falling errors and chooses the error. Beyond the least that a
/// prediction needs, it goes on while all measurements are expected to take at most .15 of the budget, and while the
/// budget is predicted to reach the last error measured.
/// @param spent  seconds since the program began, which count as well
/// @param prepared  gets the settings of the error
/// @return without `took`
BudgetStatistics apply_budget(PreparedScene& prepared, const SceneOptions& options, double budget, double spent);

/// "budget 60 s: error 1.3 chosen, predicted 55 s (pilot 2.1 s)", before the frames are rendered.
std::string describe_choice(const BudgetStatistics& budget);

/// "budget 60 s: error 1.3 chosen, predicted 55 s, took 58 s", afterwards.
std::string describe_budget(const BudgetStatistics& budget);

}  // namespace aleph
