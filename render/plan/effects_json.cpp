#include "render/plan/effects_json.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace aleph {

using nlohmann::ordered_json;

namespace {

/// JSON has no infinity.
ordered_json finite_or_null(double value) {
    return std::isfinite(value) ? ordered_json(value) : ordered_json(nullptr);
}

}  // namespace

ordered_json to_json(const PlannedEffect& planned) {
    ordered_json json = {{"effect", planned.name},
                         {"decision", decision_name(planned.decision)},
                         {"reason", planned.reason},
                         {"bound", nullptr}};
    if (planned.bound) {
        json["bound"] = {{"luminance", finite_or_null(planned.bound->luminance)},
                         {"thresholds", finite_or_null(planned.bound->thresholds)}};
    }
    return json;
}

ordered_json to_json(const EffectsPlan& plan) {
    ordered_json list = ordered_json::array();
    for (const PlannedEffect& effect : plan.effects) list.push_back(to_json(effect));
    return list;
}

}  // namespace aleph
