#pragma once
// Metrics of what viewers see in sequences, by the instrument of compare/visible_difference.h.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/compare/visible_shares.h"
#include "render/study/run_study.h"

namespace aleph {

/// Makes the two pictures of frame i that are compared: one and its reference.
using FramePictures = std::function<std::pair<ChannelImage, ChannelImage>(std::size_t i)>;

/// Shares of the pixels that show a visible difference, frame by frame. Consecutive frames of a scene are a sequence.
/// @param frames  in order, with their maps
std::vector<VisibleShares> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures);

/// Adds share_seen, share_flicker, share_lasting and, where saliency is known, share_noticed.
void add_visible_metrics(const VisibleShares& shares, MetricValues& out);

/// Adds seed_seen and seed_flicker to every frame of a variant and, as means, to the variant: the shares in which two
/// renderings that differ in their random numbers alone are seen to differ.
/// @param frames      of the variant, in their order
/// @param one,other   files of the pictures of both seeds, by frame
void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& one,
                      const std::vector<std::string>& other, VariantResult& variant);

}  // namespace aleph
