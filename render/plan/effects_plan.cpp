#include "render/plan/effects_plan.h"

#include <nlohmann/json.hpp>

#include "render/plan/effect_table.h"

namespace aleph {

using nlohmann::ordered_json;

namespace {

PlannedEffect decide(const EffectRow& row, Planning& frame) {
    Finding found = row.find(frame);
    const auto& cheaper = found.cheaper;
    if (cheaper && frame.may_leave_out(row.effect.id) && cheaper->bound->thresholds <= frame.left) {
        frame.left -= cheaper->bound->thresholds;
        found.planned = *cheaper;
    }
    found.planned.name = row.effect.name;
    return found.planned;
}

/// --plan off simulates what the plan would leave out; --force and --forbid have the last word.
void override_by_user(const RenderSettings& settings, Effect effect, PlannedEffect& planned) {
    const bool off = settings.effects.plan == EffectsPlanning::off;
    if (settings.effects.forbid.contains(effect)) {
        planned = {
            .decision = Decision::skip, .reason = "forbidden", .bound = {}, .by_user = true, .name = planned.name};
    } else if (planned.decision != Decision::simulate && (off || settings.effects.force.contains(effect))) {
        planned = {.reason = off ? "the plan is off" : "forced", .name = planned.name};
    }
}

}  // namespace

EffectSet EffectsPlan::left_out() const {
    EffectSet set;
    for (std::size_t i = 0; i < effects.size(); ++i) {
        if (effects[i].decision == Decision::skip && effects[i].leaves_out()) set.add(static_cast<Effect>(i));
    }
    return set;
}

double EffectsPlan::left_out_thresholds() const {
    double sum = 0.0;
    for (const PlannedEffect& effect : effects) {
        if (effect.decision != Decision::simulate && !effect.by_user && effect.bound) sum += effect.bound->thresholds;
    }
    return sum;
}

EffectsPlan plan_effects(const Scene& scene, const RenderSettings& settings, const PlanInput& input,
                         const std::optional<VisibleFrame>& visible, const EffectTable& table) {
    Planning frame{scene, settings, input, visible, planned_thresholds(settings), {}};
    for (const EffectRow& row : table) frame.plan.effects.push_back(decide(row, frame));
    // Afterwards, because effects are found as if those before them were not overridden.
    for (const EffectRow& row : table) override_by_user(settings, row.effect.id, frame.plan.of(row.effect.id));
    return std::move(frame.plan);
}

void remove_forbidden(const EffectSet& forbidden, Scene& scene, const EffectTable& table) {
    for (const EffectRow& row : table) {
        if (row.remove != nullptr && forbidden.contains(row.effect.id)) row.remove(scene);
    }
}

RenderSettings without_forbidden(RenderSettings settings, const EffectTable& table) {
    for (const EffectRow& row : table) {
        if (row.turn_off != nullptr && settings.effects.forbid.contains(row.effect.id)) row.turn_off(settings);
    }
    return settings;
}

ordered_json to_json(const PlannedEffect& planned) {
    constexpr const char* decisions[] = {"simulate", "simplify", "skip"};
    ordered_json json = {{"effect", planned.name},
                         {"decision", decisions[static_cast<int>(planned.decision)]},
                         {"reason", planned.reason},
                         {"bound", nullptr}};
    if (planned.bound) {
        json["bound"] = {{"luminance", planned.bound->luminance}, {"thresholds", planned.bound->thresholds}};
    }
    return json;
}

ordered_json to_json(const EffectsPlan& plan) {
    ordered_json list = ordered_json::array();
    for (const PlannedEffect& effect : plan.effects) list.push_back(to_json(effect));
    return list;
}

}  // namespace aleph
