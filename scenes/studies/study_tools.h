#pragma once
// What the experiments share: rendering variants, measuring them against a dense gather, drawing them side by side.

#include <filesystem>
#include <string>
#include <vector>

#include "render/sequence.h"

namespace aleph {

/// One variant of a frame with what the experiments ask about it.
struct Variant {
    std::string name;
    FrameOutput output;
};

/// Renders one frame with the given guide and accuracy, everything else as in `settings`.
/// @param maps  keep the maps (conspicuity, visibility) for pictures
FrameOutput render_variant(const Scene& scene, RenderSettings settings, std::int64_t frame, Guide guide,
                           double accuracy, bool maps = false);

struct ErrorFigures {
    double relative_mse = 0.0;    ///< of luminance: mean of (L - R)^2 / (R^2 + e^2), e = 1 % of the mean of R
    double percent_beyond = 0.0;  ///< share of pixels with display_white |Y - Y_dense| > threshold
};

/// @param threshold  cd/m2; of the `saliency` frame, the same for every variant
ErrorFigures measure_error(const Image<Rgb>& color, const Image<Rgb>& dense, const Image<float>& threshold,
                           double display_white);

/// Text of a guide: none, spatial, full, saliency.
std::string guide_name(Guide guide);

/// A dense gather of the frame: read from `file` if that exists and has the right size, else rendered (and kept there
/// if `file` is not empty).
Image<Rgb> load_or_render_dense(const Scene& scene, RenderSettings settings, std::int64_t frame, int gather,
                                const std::filesystem::path& file);

/// One captioned picture of a sheet: 8-bit display values in [0,1].
struct Panel {
    std::string caption;
    Image<Rgb> display;
};

Panel color_panel(const std::string& caption, const Image<Rgb>& linear);
/// A map through a perceptually uniform colour scale, `low` to `high`; logarithmic if asked.
Panel map_panel(const std::string& caption, const Image<float>& map, double low, double high, bool logarithmic = false);
/// Where irradiance was computed: single pixels, drawn a little larger so that they survive scaling.
Panel records_panel(const std::string& caption, const Image<float>& records);

/// Draws panels in rows of `columns`, each `width` pixels wide, with captions; writes a PNG, or a JPEG where the
/// path ends in .jpg.
void write_sheet(const std::filesystem::path& path, const std::vector<Panel>& panels, int columns, int width);

}  // namespace aleph
