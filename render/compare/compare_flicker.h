#pragma once
// Flicker: how the error of a picture changes from one frame to the next along the motion of what is shown. An error
// that rides with its surface does not flicker, though it changes at every pixel that it passes.

#include "engine/image/image_file.h"
#include "render/compare/compare_threshold.h"

namespace aleph {

/// Surfaces that move by no more than this are at rest, in pixels per frame. Their error is compared in place. Within a
/// hundredth of a pixel at most a hundredth of a neighbouring pixel's error would come in.
constexpr double rest_limit = 0.01;

/// Maps of a frame that the flicker needs (`aleph maps`).
struct FlickerMaps {
    Image<float> u, v;           ///< motion to the next frame, pixels; u to the right, v upwards
    Image<float> valid;          ///< 1 where the motion is valid
    Image<float> object;         ///< number of the instance; empty if the maps have none
    Image<float> threshold;      ///< cd/m2
    bool own_threshold = false;  ///< threshold is that of flicker (`threshold.flicker`), not of lasting errors
};

/// Reads forward.u, forward.v, motion.valid, objectId.X and threshold.flicker or, without it, threshold.Y. Nothing if
/// the maps have no motion or no threshold.
std::optional<FlickerMaps> make_flicker_maps(const ChannelImage& maps);

/// Changes of the error in units of the flicker threshold.
struct FlickerSum {
    ThresholdSum rest, moving;
    std::size_t left_out = 0;  ///< pixels without a valid motion, target, or finite error

    void add(const FlickerSum& other);
};

/// For every pixel with a valid motion whose target lies inside the picture and on the same object: the error of the
/// next frame at the target (bilinear) minus the error of this frame, over this frame's threshold. Targets are rounded
/// to a thousandth of a pixel, so that rounding brings in no neighbour.
/// @param maps          of this frame
/// @param next_objects  of the next frame; empty: every target counts as the same object
/// @throws InputError if the sizes differ
FlickerSum measure_flicker(const LuminanceError& now, const LuminanceError& next, const FlickerMaps& maps,
                           const Image<float>& next_objects);

/// FlickerSum in figures.
struct FlickerFigures {
    ThresholdFigures rest, moving;
    std::size_t left_out = 0;
    bool own_threshold = false;

    std::size_t pixels() const { return rest.pixels + moving.pixels; }
    std::size_t beyond() const { return rest.beyond + moving.beyond; }
    double percent_beyond() const;
};

FlickerFigures summarize(const FlickerSum& sum, bool own_threshold);

}  // namespace aleph
