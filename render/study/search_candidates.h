#pragma once
// Which fixed settings a search tries, and how large it renders them in each round.

#include <vector>

#include "render/study/study.h"

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

}  // namespace aleph
