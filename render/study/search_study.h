#pragma once
// Searches the fixed settings of each scene that cost least for what a viewer sees: successive halving towards the
// front of processor seconds and share_seen.

#include "render/study/pareto.h"
#include "render/study/run_study.h"
#include "render/study/search_candidates.h"

namespace aleph {

/// Renders the candidates of the study in small, keeps the better half by non-dominated sorting, and so on
/// (plan_rounds) until the last round renders what is left as the study asks, beside its variants. A candidate has
/// frames of those scenes alone in which it was left; `on_front` is its place in one of these. Measured seconds decide
/// who is kept, so that another machine may keep others; a search that was stopped goes on with the seconds that it
/// had.
/// @param prepared  with candidates
/// @param folder    as run_study
/// @throws InputError, OutputError
StudyResults search_study(const PreparedStudy& prepared, const std::filesystem::path& folder,
                          const StudyProgress& progress = {});

/// The rounds of the search in a scene.
std::vector<SearchRound> rounds_of(const PreparedStudy& prepared, const PreparedStudyScene& scene);

/// The variants that a scene was rendered in, with means over its frames alone, and its front.
std::vector<VariantResult> variants_of_scene(const StudyResults& results, const std::string& scene);

/// Settings with what they cost and err by.
struct SearchedPoint {
    std::string variant;  ///< its name
    SettingMap settings;
    CostPoint point;
};

/// A variant of the study beside fixed settings.
struct AgainstFixed {
    SearchedPoint own;
    FrontCost fixed;  ///< seconds of the best fixed settings with the same share seen
};

/// The findings of a search for one scene.
struct SceneSearch {
    std::string scene;
    std::vector<SearchedPoint> front;  ///< of fixed settings alone, by ascending seconds
    std::vector<AgainstFixed> against;
};

/// @param prepared  of search_study
/// @param results   its results
std::vector<SceneSearch> summarize_search(const PreparedStudy& prepared, const StudyResults& results);

}  // namespace aleph
