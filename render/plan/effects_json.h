#pragma once
// An effects plan as JSON, in --stats and in `aleph explain --json`.

#include <nlohmann/json_fwd.hpp>

#include "render/plan/effects_plan.h"

namespace aleph {

/// {"effect":NAME,"decision":"simulate|simplify|skip","reason":...,"bound":{"luminance":cd/m2,"thresholds":...}}; a
/// bound is null where none is known.
nlohmann::ordered_json to_json(const PlannedEffect& planned);

/// All effects, in order; an empty list for a plan that was not made: pictures without a scene have none.
nlohmann::ordered_json to_json(const EffectsPlan& plan);

}  // namespace aleph
