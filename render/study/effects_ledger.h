#pragma once
// The ledger of effects: what each costs in a scene, and what a viewer would miss without it.

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/study/run_study.h"

namespace aleph {

/// The variants of a study of effects: one with all of them, and for each that the plan of some frame simulates, one
/// without it.
std::vector<StudyVariant> list_ledger_variants(const std::vector<PreparedStudyScene>& scenes, const Study& study);

/// An effect in a scene, as means over its frames.
struct LedgerEntry {
    std::string effect;
    std::string decision;                  ///< of the plan: "simulate", "simplify", "skip", or "mixed"
    double bound = 0.0;                    ///< visible thresholds that the plan leaves out, at most; NaN: not known
    std::optional<MeasuredValue> seconds;  ///< of a processor and a frame, that leaving it out saves
    std::optional<MeasuredValue> seen;     ///< pixels in which a viewer sees an error without it, %
};

struct SceneLedger {
    std::string scene;
    MeasuredValue seconds, seen;       ///< with all effects
    std::vector<LedgerEntry> entries;  ///< of all effects; without measured values for those that no variant lacks
};

/// @param prepared  with Study::effects, which adds the variants that are compared
std::vector<SceneLedger> make_ledger(const PreparedStudy& prepared, const StudyResults& results);

/// [{"scene":...,"seconds":...,"seen":...,"effects":[{"effect":...,"decision":...,"bound":...,"seconds":...,"seen":...}]}]
nlohmann::ordered_json to_json(const std::vector<SceneLedger>& ledger);

}  // namespace aleph
