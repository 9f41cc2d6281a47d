#include "render/cli/budget.h"

#include <fmt/format.h>

#include <algorithm>

#include "engine/base/errors.h"
#include "render/cost_pilot.h"
#include "render/measure.h"
#include "render/scene_numbers.h"
#include "render/sequence.h"

namespace aleph {

namespace {

constexpr double pilot_errors[] = {most_budget_error, 4.0, 2.0, 1.0, 0.5, 0.25, least_budget_error};
constexpr double pilot_share = 0.05;  // of the budget
constexpr double pilot_growth = 2.5;  // of a pilot's seconds to the next, at most about that

}  // namespace

double parse_budget(const std::string& text) {
    const double seconds = parse_value<double>(text, "--budget");
    if (!(seconds > 0.0)) throw InputError("--budget", printable(text), "expected seconds above 0");
    return seconds;
}

void refuse_beside_budget(const SceneOptions& options, const std::string& cache) {
    if (options.settings.contains("error")) {
        throw InputError("--budget", "--error", "give one of the two: a budget chooses the error");
    }
    if (!cache.empty()) {
        throw InputError("--budget", "--cache",
                         "give one of the two: light is kept for one error, a budget chooses it");
    }
}

RenderSettings settings_for_error(const Scene& scene, const SceneOptions& options, double error) {
    RenderSettings settings;
    apply_settings(settings, scene.settings, options.scene);
    SettingMap given = options.settings;
    Scene numbers;
    set_scene_numbers(numbers, given, "--set");  // prepare_scene has given them to the scene
    given["error"] = error;
    apply_settings(settings, given, "");
    return settings;
}

BudgetStatistics apply_budget(PreparedScene& prepared, const SceneOptions& options, double budget, double spent) {
    const std::vector<std::int64_t> frames = choose_pilot_frames(prepared.frames);
    const double scale = find_pilot_scale(prepared.settings.width);
    const CostCoefficients coefficients = fitted_coefficients();
    BudgetStatistics result;
    result.asked = budget;
    std::vector<PilotRun> runs;
    CostRatios ratios;
    StageClock clock;
    for (const double error : pilot_errors) {
        double last = 0.0;
        const RenderSettings settings = settings_for_error(prepared.scene, options, error);
        const Pilot pilot = render_pilot(prepared.scene, settings, options.camera, frames, scale);
        clock.add_to(last);
        result.pilot += last;
        runs.push_back(pilot.run);
        ratios = find_cost_ratios(prepared.scene, settings, prepared.frames, frames, pilot.rendered, scale);
        const double left = budget - spent - result.pilot;
        if (predict_seconds(runs, ratios, coefficients, error) > left) break;
        if (result.pilot + pilot_growth * last > pilot_share * budget) break;
    }
    const double before = spent + result.pilot;
    result.error = choose_error(runs, ratios, coefficients, budget - before);
    result.predicted = before + predict_seconds(runs, ratios, coefficients, result.error);
    prepared.settings = settings_for_error(prepared.scene, options, result.error);
    return result;
}

std::string describe_choice(const BudgetStatistics& budget) {
    std::string text = fmt::format(
        "aleph: budget {:g} s: error {:g} chosen, predicted {:.3g} s, of which the pilot took "
        "{:.2g} s\n",
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
