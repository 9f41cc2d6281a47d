#pragma once
// A frame as an EXR file, with channels and attributes, and the statistics of frames as JSON.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/frame/frame_output.h"
#include "render/settings/settings.h"

namespace aleph {

/// Seconds that all frames were to take (`aleph render --budget`), and those that they took: of a clock, those before
/// the first frame included.
struct BudgetStatistics {
    double asked = 0.0;
    double error = 0.0;  ///< that was chosen, thresholds
    double predicted = 0.0;
    double took = 0.0;   ///< 0 until the last frame is written
    double pilot = 0.0;  ///< part of predicted and took
};

/// An estimated share, 0 to 1, and the ends of its interval at 95 %.
struct VerifiedShare {
    double share = 0.0, low = 0.0, high = 1.0;
};

/// Findings where pictures were checked by references (`aleph render --verify`).
struct VerifiedStatistics {
    double error = 1.0;         ///< just visible differences: what was asked for
    VerifiedShare beyond;       ///< pixels that differ by more than that
    VerifiedShare seen;         ///< by at least one
    VerifiedShare flicker;      ///< the same, by what changes from frame to frame
    VerifiedShare lasting;      ///< and by what is the same in the frames around
    std::size_t blocks = 0;     ///< of pixels that were checked
    std::size_t frames = 0;     ///< that they are in
    std::size_t window = 1;     ///< frames that a block was judged over, at most
    std::size_t unsettled = 0;  ///< blocks whose reference was still noisy at the limit of its samples
    std::optional<double> estimated = std::nullopt;  ///< share of the pixels beyond, as rendering estimated it
    double seconds = 0.0;                            ///< that it took, of a clock
};

/// The channels R, G, B, A if the picture was rendered, and with `maps` those of every map that was made.
/// README.md describes the channels. forward.v is positive upwards; MotionField of C++ is positive downwards.
ChannelImage make_frame_image(const FrameOutput& output, bool maps, const Scene& scene, const RenderSettings& settings,
                              double exposure);

/// Where the images of a window lie (ChannelImage::whole).
std::optional<PictureArea> find_whole(const FrameOutput& output);

/// Adds the channels R, G and B with a prefix; none of an empty picture.
void add_color(ChannelImage& file, const std::string& prefix, const Image<Rgb>& color);
/// The channels R, G and B alone.
ChannelImage make_color_image(const Image<Rgb>& color);

/// One element of "frames" in the statistics as text, so that a growing file need not format all of them again.
/// @param fingerprint  of the frame's file; empty: it has none
std::string format_frame_statistics(const FrameStatistics& frame, const std::string& fingerprint = "");

/// The text of an element of "frames", indented as it stands there.
std::string indent_row(const std::string& json);

/// {"frames": [...], "settings": {...}, ...} as text. Times, host and number of threads are only here, so that EXR
/// files do not depend on them.
/// @param frames  what format_frame_statistics returned for each frame, joined by ",\n"
std::string format_statistics(std::string_view frames, const Scene& scene, const RenderSettings& settings,
                              double exposure, const std::optional<BudgetStatistics>& budget = std::nullopt,
                              const std::optional<VerifiedStatistics>& verified = std::nullopt);

/// How much a pixel needs samples, for renderers that take such a picture: 1 over the Aleph map, so that 1 is where
/// viewers are strictest and no value is 0.
Image<float> make_importance(const Image<float>& aleph);

// Cryptomatte: names of objects as numbers in pictures, with a manifest that tells the names (Friedman and Jones 2015,
// specification 1.2.0).

/// MurmurHash3_x86_32 with seed 0 (Austin Appleby, public domain).
std::uint32_t murmur_hash(std::string_view text);

/// The hash of a name as a float: the same bits, but never NaN, infinite or denormal.
float cryptomatte_id(std::string_view name);

/// "cryptomatte/<7 hexadecimal digits of the layer's hash>/", with which the layer's attributes begin.
std::string cryptomatte_prefix(std::string_view layer);

}  // namespace aleph
