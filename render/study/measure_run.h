#pragma once
// The errors of pictures, by the metrics of a study: by thresholds, and as viewers see them in sequences by the
// instrument of compare/visible_difference.h.

#include <array>
#include <filesystem>
#include <functional>
#include <span>

#include "engine/image/image_file.h"
#include "perception/vision/band_frequencies.h"
#include "render/study/study_results.h"

namespace aleph {

/// How noisy the reference itself is: the share that noise alone makes beyond the threshold, percent, and the 99th
/// percentile of its standard error in thresholds, both of the first viewer.
struct ReferenceQuality {
    double share_by_noise = 0.0, percentile_99 = 0.0;
};

/// A frame with what its pictures are judged by.
struct JudgingFrame {
    std::string scene;
    std::int64_t frame = 0;
    ReferenceQuality quality;
    std::filesystem::path reference;  ///< the file
    /// Maps of `aleph maps`, for the first viewer, with band.0 to .6, R_i of (5.3), and elevation.0 to .6, f_i of
    /// (5.9).
    ChannelImage maps;
    std::array<double, band_count> frequencies{};  ///< of the bands, cycles per degree
    std::vector<Image<float>> thresholds;          ///< cd/m2, of each viewer
};

/// The metrics of errors; those that do not apply (indirect light of a traced picture) are absent.
/// @param picture     R, G, B, and indirect.R/G/B where it has them
/// @param truth       the same, and variance.Y
/// @param thresholds  cd/m2, of each viewer
/// @throws InputError if sizes differ
MetricValues measure_errors(const ChannelImage& picture, const ChannelImage& truth,
                            const std::vector<Image<float>>& thresholds, const std::vector<Metric>& metrics);

/// @param threshold  of the first viewer
ReferenceQuality measure_reference(const ChannelImage& reference, const Image<float>& threshold);

/// Makes the two pictures of frame i that are compared: one and its reference, which gets the exposure of the first.
using FramePictures = std::function<std::pair<ChannelImage, ChannelImage>(std::size_t i)>;

/// Samples per pixel of an allocation that gives every pixel what its own error asks for: n v^2 where n samples leave
/// an error of v just visible differences, and at least 1. The mean of 99 % of the pixels: the others stay as they are.
/// No renderer knows these errors; it is a lower bound for those who guess them.
/// @param seen     just visible differences
/// @param samples  of the same size, above 0
double find_ideal_samples(const Image<float>& seen, const Image<float>& samples);

/// share_seen, share_flicker, share_lasting and, where they are known, share_noticed and ideal_samples
/// (find_ideal_samples, of pictures with samples.Y), frame by frame. Consecutive frames of a scene are a sequence.
/// @param frames  in order, with their maps
std::vector<MetricValues> measure_visible(std::span<const JudgingFrame> frames, const FramePictures& pictures);

/// Adds seed_seen and seed_flicker to every frame of a variant: the shares in which two renderings that differ in their
/// random numbers alone are seen to differ.
/// @param frames  of the variant, in their order
/// @param other   files of the pictures of the other seed, by frame
void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& other,
                      std::vector<FrameResult>& results);

}  // namespace aleph
