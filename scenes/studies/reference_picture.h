#pragma once
// Path-traced pictures that judge others: rendered once, kept as files, and refined on demand.

#include <CLI/CLI.hpp>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/settings.h"

namespace aleph {

/// Where reference pictures are kept, since they take minutes, and what they are.
struct ReferencePictureOptions {
    int passes = 16;  ///< renderings that it is the mean of, at least 2
    /// Samples per pixel of the first. Each has one more than the one before (reference_picture.cpp).
    int pass_spp = 32;
    /// "path": traced paths. "gather": no cache, 16 gather rays and 2 samples of every light at every pixel sample,
    /// which have the noise of paths that take several times as long.
    std::string kind = "path";
    std::string folder = "build/references";
};

/// --reference-kind, --reference-passes, --reference-spp, --references.
void add_reference_options(CLI::App& app, ReferencePictureOptions& options);

/// R, G, B and `variance.Y` of a frame without a guide, with random numbers of its own, each sample weighted by a box
/// as wide as a pixel. It is the mean of several renderings, whose differences tell its variance. Bounces, longest
/// path and levels of cages are those of the settings.
/// Reads the file of this scene, frame and size if there is one, and adds the passes that it lacks. The file is written
/// after every pass, so that a run can be stopped and taken up.
/// @param file  of the scene; its bytes are part of the reference's name, those of files that it includes are not
/// @throws InputError if the kept file is not such a reference
ChannelImage load_or_render_reference_picture(const Scene& scene, const RenderSettings& settings, std::int64_t frame,
                                              const std::string& file, const ReferencePictureOptions& options,
                                              bool quiet);

/// Renderings that a reference is the mean of, and the seconds of a processor that they took.
double reference_passes(const ChannelImage& reference);
double reference_seconds(const ChannelImage& reference);

/// Adds a rendering, R, G and B, to a mean of others; variance.Y is the variance of the mean's luminance as their
/// differences tell it, infinite of one rendering.
void add_pass(ChannelImage& mean, const ChannelImage& pass);

/// As it would be with another factor on radiance.
ChannelImage with_exposure(ChannelImage picture, double exposure);

}  // namespace aleph
