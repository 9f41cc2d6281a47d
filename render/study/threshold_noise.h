#pragma once
// Noise made from visible thresholds (Yee 2000, 7.1): a picture that errs by what a model of vision says is not seen.

#include <cstdint>
#include <optional>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Uniform random numbers, independent from pixel to pixel and from frame to frame, times the threshold.
struct ThresholdNoise {
    double factor = 1.0;     ///< of the threshold: the largest amplitude
    bool zero_mean = false;  ///< from -1 to 1; else from 0 to 1 as the thesis has it, which brightens the picture
};

/// Names of what variants of a study may have in place of settings.
inline constexpr const char *noise_key = "noise", *zero_mean_noise_key = "zero_mean_noise";

/// The noise that these settings of a variant name; nothing for those of a rendering.
/// @param variant  its name, for messages
/// @throws InputError where other settings are beside it, or the factor is no number from 0 to 1000
std::optional<ThresholdNoise> find_noise(const SettingMap& settings, const std::string& variant);

/// The reference's R, G and B with grey noise. It is not clamped: a display does that.
/// @param threshold  cd/m2, of the reference's size
ChannelImage add_threshold_noise(const ChannelImage& reference, const Image<float>& threshold,
                                 const ThresholdNoise& noise, std::uint32_t seed, std::int64_t frame);

}  // namespace aleph
