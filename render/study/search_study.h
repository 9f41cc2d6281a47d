#pragma once
// Searches the fixed settings of each scene that cost least for what a viewer sees: which ones it tries, how large it
// renders them in each round, and successive halving towards the front of processor seconds and share_seen.

#include "render/study/pareto.h"
#include "render/study/run_study.h"

namespace aleph {

/// The values that a search tries where a study says nothing else: guide, adapter, accuracy, gather, spp, light_samples
/// and light_step.
StudySearch default_search();

/// Different candidates, all with uniform sampling and no asked error, named "fixed 1", "fixed 2", ... The values of a
/// setting are dealt from a deck that is shuffled anew when it is empty, so that any number of candidates has all
/// values about equally often; more candidates begin with the same ones. Without a guide
/// there is no adapter. If there are fewer combinations than candidates, all of them are tried.
/// @param study  with a search
std::vector<StudyVariant> list_candidates(const Study& study);

/// A round of a search.
struct SearchRound {
    std::size_t candidates = 0;
    int width = 0, height = 0;
    std::vector<int> frames;
};

/// Rounds, each with half the candidates of the one before. Pictures grow from half the size to the study's, frames
/// from three to all of them, both by equal factors. The frames of a round follow each other where they can, so that
/// flicker is seen.
/// @param frames  of the scene, at least one
std::vector<SearchRound> plan_rounds(int rounds, std::size_t candidates, int width, int height,
                                     const std::vector<int>& frames);

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
