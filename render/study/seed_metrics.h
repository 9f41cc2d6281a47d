#pragma once
// Metrics of chance: two renderings of a sequence that differ in their random numbers alone.

#include <string>
#include <vector>

#include "render/study/run_study.h"

namespace aleph {

/// Adds seed_difference to every frame, the percentage of pixels in which two seeds differ by more than one visible
/// threshold of the first viewer; and seed_flicker to every frame whose next one follows in the list, the percentage in
/// which that difference changes by more than the threshold of flicker until then, along the motion
/// (compare_flicker.h). The variant gets the means over these frames.
/// @param frames      of the variant, in their order
/// @param one,other   files of the pictures of both seeds, by frame
void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& one,
                      const std::vector<std::string>& other, VariantResult& variant);

}  // namespace aleph
