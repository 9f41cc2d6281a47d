// The effects plan of a shot.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "engine/pose/pose.h"
#include "render/cli/explain/explain.h"
#include "render/plan/effect_table.h"

namespace aleph {

using nlohmann::ordered_json;

namespace {

constexpr std::int64_t few_frames = 8;
constexpr std::size_t most_shots = 12;

/// The plan of one effect over frames that were looked at one after the other.
struct PlannedFrames {
    int first = 0, last = 0;
    PlannedEffect planned;
};

/// The larger bound, with its reason: where one is not known, neither is their maximum.
void join(PlannedFrames& frames, int frame, const PlannedEffect& planned) {
    frames.last = frame;
    std::optional<EffectBound>& bound = frames.planned.bound;
    if (!bound || (planned.bound && planned.bound->thresholds <= bound->thresholds)) return;
    frames.planned = planned;
}

std::string bound_text(const ordered_json& bound) {
    if (bound.is_null()) return "not known";
    const auto number = [](const ordered_json& value) {
        const double known = value.get<double>();
        return std::isfinite(known) ? fmt::format("{:.2g}", known) : std::string("not known");
    };
    if (bound["luminance"] == 0.0) return "0";
    return fmt::format("{} cd/m2, {} thresholds", number(bound["luminance"]), number(bound["thresholds"]));
}

}  // namespace

std::vector<int> choose_planned_frames(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    std::set<int> frames;
    const std::int64_t length = range.last - range.first, steps = length < few_frames ? length : 4;
    for (std::int64_t i = 0; i <= steps; ++i) {
        const std::int64_t offset = steps == 0 ? 0 : length / steps * i + length % steps * i / steps;
        frames.insert(static_cast<int>(range.first + offset));
    }
    for (const std::int64_t cut : scene.film.cuts) {
        if (frames.size() < most_shots && cut >= range.first && cut <= range.last) frames.insert(static_cast<int>(cut));
    }
    return {frames.begin(), frames.end()};
}

ordered_json explain_plan(Sequence& sequence, const std::vector<int>& frames) {
    std::vector<std::vector<PlannedFrames>> shot;
    for (const int frame : frames) {
        const EffectsPlan plan = sequence.plan(frame);
        shot.resize(plan.effects.size());
        for (std::size_t i = 0; i < plan.effects.size(); ++i) {
            const PlannedEffect& planned = plan.effects[i];
            if (!shot[i].empty() && shot[i].back().planned.decision == planned.decision) {
                join(shot[i].back(), frame, planned);
            } else {
                shot[i].push_back({frame, frame, planned});
            }
        }
    }
    ordered_json list = ordered_json::array();
    for (const std::vector<PlannedFrames>& effect : shot) {
        for (const PlannedFrames& part : effect) {
            ordered_json item = to_json(part.planned);
            item["frames"] = {part.first, part.last};
            list.push_back(std::move(item));
        }
    }
    return list;
}

std::string plan_text(const ordered_json& plan, const ordered_json& frames) {
    if (plan.empty()) return {};
    std::string text = fmt::format("\neffects plan, of frame{} {}\n", frames.size() == 1 ? "" : "s", frames.dump());
    text += fmt::format("  {:<18} {:<11} {:<9} {} [at most]\n", "effect", "frames", "", "reason");
    std::string before;
    for (const ordered_json& item : plan) {
        const std::string effect = item["effect"], reason = item["reason"], decision = item["decision"];
        const int first = item["frames"][0], last = item["frames"][1];
        text +=
            fmt::format("  {:<18} {:<11} {:<9} {}", effect == before ? "" : effect,
                        first == last ? fmt::format("{}", first) : fmt::format("{}-{}", first, last), decision, reason);
        if (decision != "simulate") text += fmt::format(" [{}]", bound_text(item["bound"]));
        text += '\n';
        before = effect;
    }
    return text;
}

}  // namespace aleph
