#pragma once
// Metrics of what viewers see in sequences, by the instrument of compare/visible_difference.h.

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "render/compare/compare_sequence.h"
#include "render/study/run_study.h"

namespace aleph {

/// Makes the two pictures of frame i that are compared: one and its reference.
using FramePictures = std::function<std::pair<ChannelImage, ChannelImage>(std::size_t i)>;

/// The errors of one picture as far as they are seen.
struct VisibleErrors {
    VisibleShares shares;
    std::optional<double> ideal_samples{};  ///< find_ideal_samples, where the picture has samples.Y
};

/// Samples per pixel of an allocation that gives every pixel what its own error asks for: n v^2 where n samples leave
/// an error of v just visible differences, and at least 1. The mean of 99 % of the pixels: the others stay as they are.
/// No renderer knows these errors; it is a lower bound for those who guess them.
/// @param seen     just visible differences
/// @param samples  of the same size, above 0
double find_ideal_samples(const Image<float>& seen, const Image<float>& samples);

/// Errors that are seen, frame by frame. Consecutive frames of a scene are a sequence.
/// @param frames  in order, with their maps
std::vector<VisibleErrors> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures);

/// Adds share_seen, share_flicker, share_lasting and, where they are known, share_noticed and ideal_samples.
void add_visible_metrics(const VisibleErrors& errors, MetricValues& out);

/// Adds seed_seen and seed_flicker to every frame of a variant: the shares in which two renderings that differ in their
/// random numbers alone are seen to differ.
/// @param frames  of the variant, in their order
/// @param other   files of the pictures of the other seed, by frame
void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& other,
                      std::vector<FrameResult>& results);

}  // namespace aleph
