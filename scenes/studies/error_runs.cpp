#include "scenes/studies/error_runs.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <tuple>

#include "scenes/studies/cost_curve.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

/// A pixel's light samples are shared out among its spp, and each has at least one: settings with equal samples make
/// the same picture.
int light_samples_each(const RenderSettings& settings) {
    return (settings.light_samples + settings.spp - 1) / settings.spp;
}

RenderSettings fixed_settings(RenderSettings settings, double spp, double light_samples, double accuracy) {
    settings.perception.guide = Guide::none;
    settings.spp = static_cast<int>(spp);
    settings.light_samples = static_cast<int>(light_samples);
    settings.accuracy = accuracy;
    validate(settings);
    return settings;
}

bool reaches(const ErrorRun& run, const std::vector<ShareGoal>& goals) {
    return std::ranges::all_of(
        goals, [&](const ShareGoal& goal) { return run.percent_beyond(goal.thresholds) <= goal.percent; });
}

/// Half a pixel.
double least_percent(const LadderSide& side) {
    return 50.0 / static_cast<double>(std::max<std::size_t>(1, side.runs.front().error.pixels));
}

/// The cheapest run of the side that reaches the goal, or a cost between it and the one before.
std::optional<FixedCost> find_cost(const LadderSide& side, const ShareGoal& goal) {
    if (side.runs.empty()) return std::nullopt;
    std::vector<CostPoint> all, frame_alone;
    for (const ErrorRun& run : side.runs) {
        const double percent = run.percent_beyond(goal.thresholds);
        all.push_back({percent, run.cost.seconds(), run.cost.seconds()});
        frame_alone.push_back({percent, run.cost.seconds(), run.cost.frame_seconds});
    }
    const double least = least_percent(side);
    if (const auto cost = cost_at(all, goal.percent, least)) {
        return FixedCost{side.name, cost->seconds, cost_at(frame_alone, goal.percent, least)->seconds, false};
    }
    if (std::ranges::any_of(all, [&](const CostPoint& point) { return point.percent > goal.percent; }))
        return std::nullopt;
    const auto cheapest = std::ranges::min_element(all, {}, &CostPoint::seconds);
    return FixedCost{side.name, cheapest->seconds,
                     frame_alone[static_cast<std::size_t>(cheapest - all.begin())].seconds, true};
}

}  // namespace

double ErrorRun::percent_beyond(double thresholds) const {
    const auto found = std::ranges::find(error.beyond, thresholds, &BeyondShare::thresholds);
    return found == error.beyond.end() ? 100.0 : found->percent;
}

ErrorRun judge(const JudgedFrame& frame, const std::string& name, const RenderSettings& settings, double asked) {
    return judge(frame, name, render_timed(frame.scene, settings, frame.number, frame.repeats), asked);
}

ErrorRun judge(const JudgedFrame& frame, const std::string& name, TimedFrame timed, double asked) {
    const ChannelImage reference =
        with_exposure(frame.reference, std::get<double>(timed.picture.metadata.at("exposureFactor")));
    ErrorRun run{name, std::move(timed.cost),
                 measure_picture(timed.picture, reference, frame.threshold, frame.multiples), std::nullopt,
                 std::move(timed.statistics)};
    if (!timed.claim.errors.total.empty())
        run.claim = check_claim(timed.picture, reference, frame.threshold, timed.claim, asked);
    return run;
}

std::vector<LadderSide> climb(const JudgedFrame& frame, const Ladder& ladder, const std::vector<ShareGoal>& goals,
                              const std::function<void(const ErrorRun&)>& after) {
    std::map<std::tuple<double, int, int>, ErrorRun> done;
    double best = ladder.most_seconds;
    std::vector<LadderSide> sides;
    for (const double accuracy : ladder.accuracies) {
        for (const double light_samples : ladder.light_samples) {
            LadderSide side{fmt::format("accuracy {:g}, {:g} light samples", accuracy, light_samples), {}};
            for (const double spp : ladder.spps) {
                const RenderSettings settings = fixed_settings(frame.settings, spp, light_samples, accuracy);
                const std::tuple key{accuracy, settings.spp, light_samples_each(settings)};
                if (!done.contains(key)) {
                    done[key] = judge(frame, fmt::format("{:g} spp, {}", spp, side.name), settings);
                    after(done[key]);
                }
                const ErrorRun& run = done[key];
                side.runs.push_back(run);
                if (reaches(run, goals)) best = std::min(best, run.cost.seconds());
                if (reaches(run, goals) || run.cost.seconds() > best) break;
            }
            sides.push_back(std::move(side));
        }
    }
    return sides;
}

std::optional<FixedCost> find_best_fixed(const std::vector<LadderSide>& sides, const ShareGoal& goal) {
    std::optional<FixedCost> best;
    for (const LadderSide& side : sides) {
        const auto cost = find_cost(side, goal);
        if (cost && (!best || cost->seconds < best->seconds)) best = cost;
    }
    return best;
}

}  // namespace aleph
