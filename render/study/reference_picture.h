#pragma once
// Pictures that judge others: rendered once, kept as files, and refined on demand.

#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/compare/reference_passes.h"
#include "render/pixels/shaded_frame.h"
#include "render/settings/settings.h"

namespace aleph {

/// Where reference pictures are kept, since they take minutes, and what they are.
struct ReferencePictureOptions {
    int passes = 4;  ///< renderings that it is the mean of, at least 2
    /// Samples per pixel of the first. Each has one more than the one before (reference_picture.cpp).
    int pass_spp = 32;
    /// "path": traced paths. "settings": as the settings are.
    std::string kind = "path";
    bool full_light = true;  ///< at least 16 diffuse bounces; else as many as the settings say
    std::string folder;
    std::string name;      ///< of the scene, for the name of the file
    std::string identity;  ///< of what is rendered (hash_scene): another one has another file
};

/// Called as a reference is made, with the renderings that are finished.
using ReferenceProgress = std::function<void(double passes)>;

/// R, G, B, `indirect.R/G/B` unless it is traced, and `variance.Y` of a frame without a guide, with random numbers of
/// its own. It is the mean of several renderings, whose differences tell its variance. Longest path,
/// filter and levels of cages are those of the settings, and bounces but for `full_light`. Reads the file of this scene, frame and size if there is one, and
/// adds the passes that it lacks. The file is written after every pass, so that a run can be stopped and taken up.
/// @throws InputError if the kept file is not such a reference
ChannelImage load_or_render_reference_picture(const Scene& scene, const RenderSettings& settings, std::int64_t frame,
                                              const ReferencePictureOptions& options,
                                              const ReferenceProgress& progress = {});

/// The file that keeps it. Other builds of the program (program_build) have other files.
std::filesystem::path reference_picture_path(const RenderSettings& settings, std::int64_t frame,
                                             const ReferencePictureOptions& options);

/// Names of the channels of indirect light.
inline constexpr std::array<const char*, 3> indirect_channels = {"indirect.R", "indirect.G", "indirect.B"};
/// Adds them, where the frame has them: the part of the picture that surfaces reflect of their indirect irradiance.
void add_indirect(ChannelImage& image, const ShadedFrame& shaded);

}  // namespace aleph
