#include "render/cli/budget.h"

#include <fmt/format.h>

#include "render/budget/cost_pilot.h"
#include "render/frame/sequence.h"

namespace aleph {

namespace {

constexpr double pilot_errors[] = {most_budget_error, 2.0, 1.0, 0.5, 0.25, least_budget_error};
constexpr double pilot_share = 0.15;  // of the budget

/// The settings with which the frames would have this error: as --error would set them.
RenderSettings settings_for_error(Scene& scene, const SceneOptions& options, double error) {
    SettingMap given = options.settings;
    given["error"] = error;
    return join_settings(scene, std::move(given), false);
}

}  // namespace

void apply_budget(PreparedScene& prepared, const SceneOptions& options, Budget& budget) {
    double spent = 0.0;
    StageClock(budget.clock).add_to(spent);
    const CostCoefficients coefficients = fitted_coefficients();
    PilotRequest request{prepared.scene, options.camera, choose_pilot_frames(prepared.frames), {}, {}};
    for (const double error : pilot_errors) {
        request.settings.push_back(settings_for_error(prepared.scene, options, error));
    }
    const auto ratios_of = [&](int rendered) {
        return find_cost_ratios(prepared.scene, request.settings.front(), prepared.frames, request.frames, rendered);
    };
    BudgetStatistics& result = budget.statistics;
    StageClock clock;
    request.go_on = [&](const PilotSeconds& measured, double next) {
        clock.add_to(result.pilot);
        if (result.pilot + next > pilot_share * result.asked) return false;
        if (measured.parts.empty()) return true;
        const double least = measured.parts.back().error;
        const double seconds = predict_seconds(measured, ratios_of(0), coefficients, least).sum();
        return seconds + spent + result.pilot < result.asked;
    };
    const Pilot pilot = run_pilot(request);
    clock.add_to(result.pilot);
    const CostRatios ratios = ratios_of(pilot.rendered);
    const double before = spent + result.pilot;
    result.error = choose_error(pilot.seconds, ratios, coefficients, result.asked - before);
    result.predicted = before + predict_seconds(pilot.seconds, ratios, coefficients, result.error).sum();
    prepared.settings = settings_for_error(prepared.scene, options, result.error);
}

std::string describe_choice(const BudgetStatistics& budget) {
    std::string text =
        fmt::format("aleph: budget {:g} s: error {:g} chosen, predicted {:.3g} s, of which the pilot took {:.2g} s\n",
                    budget.asked, budget.error, budget.predicted, budget.pilot);
    if (budget.predicted > budget.asked) {
        text += fmt::format(
            "aleph: warning: the budget of {:g} s is too small: error {:g}, the largest that a budget chooses, is "
            "predicted to take {:.3g} s; a smaller picture (--size) takes less\n",
            budget.asked, budget.error, budget.predicted);
    }
    return text;
}

std::string describe_budget(const BudgetStatistics& budget) {
    return fmt::format("aleph: budget {:g} s: error {:g} chosen, predicted {:.3g} s, took {:.3g} s\n", budget.asked,
                       budget.error, budget.predicted, budget.took);
}

}  // namespace aleph
