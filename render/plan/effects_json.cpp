#include "render/plan/effects_json.h"

#include <nlohmann/json.hpp>

namespace aleph {

using nlohmann::ordered_json;

ordered_json to_json(const PlannedEffect& planned) {
    ordered_json json = {{"effect", planned.name},
                         {"decision", decision_name(planned.decision)},
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
