#pragma once
// Pictures that judge others: rendered once, kept as files, and refined on demand. Noise made from visible thresholds,
// which is added to them (Yee 2000, 7.1): a picture that errs by what a model of vision says is not seen.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>

#include "engine/image/image_file.h"
#include "render/compare/reference_passes.h"
#include "render/study/prepared_study.h"

namespace aleph {

struct ReferencePicture {
    ChannelImage picture;
    std::filesystem::path file;  ///< that keeps it; other builds of the program (program_build) have other files
};

/// Called as a reference is made, with the renderings that are finished.
using ReferenceProgress = std::function<void(double passes)>;

/// R, G, B, `indirect.R/G/B` unless it is traced, and `variance.Y` of a frame without a guide, with random numbers of
/// its own. It is the mean of the passes of Study::reference, whose differences tell its variance. Longest path, filter
/// and levels of cages are those of the settings; there are at least 16 diffuse bounces unless the study names them.
/// Reads the file of this scene, frame and size if there is one, and adds the passes that it lacks. The file is written
/// after every pass, so that a run can be stopped and taken up.
/// @param folder  that keeps references, since they take minutes
/// @throws InputError if the kept file is not such a reference
ReferencePicture find_or_make_reference(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                                        const std::filesystem::path& folder, const ReferenceProgress& progress);

/// Returns whether find_or_make_reference would find the picture with all of its passes.
/// @throws InputError if the kept file is not such a reference
bool is_reference_finished(const PreparedStudyScene& scene, const Study& study, std::int64_t frame,
                           const std::filesystem::path& folder);

/// Channels of the part of a picture that surfaces reflect of their indirect irradiance: indirect.R and so on.
inline constexpr const char* indirect_layer = "indirect.";

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
