#pragma once
// Rendering one frame in several ways, and measuring it against a dense gather.

#include <filesystem>
#include <string>

#include "render/sequence.h"

namespace aleph {

/// Renders one frame with another guide and accuracy than those of `settings`.
/// @param maps  also return the maps (conspicuity, visibility)
FrameOutput render_variant(const Scene& scene, RenderSettings settings, std::int64_t frame, Guide guide,
                           double accuracy, bool maps = false);

struct ErrorFigures {
    double relative_mse = 0.0;    ///< of luminance: mean of (L - R)^2 / (R^2 + e^2), e = 1 % of the mean of R
    double percent_beyond = 0.0;  ///< share of pixels with display_white |Y - Y_dense| > threshold
};

/// @param threshold  cd/m2; of the `saliency` frame, the same for every variant
ErrorFigures measure_error(const Image<Rgb>& color, const Image<Rgb>& dense, const Image<float>& threshold,
                           double display_white);

/// none, spatial, full or saliency.
std::string guide_name(Guide guide);

/// The frame with irradiance gathered at every pixel. Reads it from `file` if that exists and has the right size;
/// otherwise renders it, and writes it to `file` unless that is empty.
Image<Rgb> load_or_render_dense(const Scene& scene, RenderSettings settings, std::int64_t frame, int gather,
                                const std::filesystem::path& file);

}  // namespace aleph
