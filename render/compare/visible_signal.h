#pragma once
// The steps of visible_difference.h for one band and channel of a frame.

#include "engine/base/pyramid.h"
#include "render/compare/visible_difference.h"

namespace aleph {

/// Image velocity of each pixel, deg/s: from the motion to the next frame or, where that is not valid, from the track
/// to the frame before; else 0.
Image<float> image_velocity(const MotionMaps& motion, const SurfaceTracks& tracks, const ViewingSettings& settings);

/// A band of one frame.
struct BandFrame {
    const Image<float>* error;
    const Image<float>* background;  ///< cd/m2 that the eye is adapted to
};

/// The errors of a band in the frames around, and where its pixels are in them.
struct BandWindow {
    BandFrame current;
    std::vector<BandFrame> next, previous;  ///< from the nearest on
    const SurfaceTracks& tracks;            ///< at least as many
    int level = 0;                          ///< of the band
    int reach = 0;                          ///< of the filter
};

/// Signals in just visible differences before masking, of a band's size.
struct SignalParts {
    Image<float> flicker, lasting;
    Image<float> sensitivity;  ///< to what lasts, 1 / contrast
};

/// Filters the errors over time along the tracks. Where a track ends before the window does, the frames on the other
/// side of the current one stand for those that are missing, and beyond both ends the last one that is known.
/// An error in a frame that is brighter than the current one counts by its contrast there: the eye is adapted to that
/// frame when it sees the error.
/// @param velocity  of the picture's pixels, deg/s
SignalParts filter_band(const BandWindow& window, const VisibleFilter& filter, const Image<float>& velocity);

/// How many times contrast that both pictures have raises the threshold, 1 and up: contrast masking within a channel,
/// (1 + w (k M)^q)^(1/p), with the constants of ColorVideoVDP 0.5.4 (Mantiuk et al. 2024).
/// @param masker  amplitude in cd/m2; M is its contrast times sensitivity
Image<float> masking_elevation(const Image<float>& masker, const Image<float>& background,
                               const Image<float>& sensitivity, int channel);

/// Adds squares of amplitudes to sums over bands and channels, at the picture's size.
/// @param sizes   of all levels
/// @param factor  of the squares; -1 takes off the energy of noise
void add_squares(const SignalParts& parts, const Image<float>& elevation, const BandShape& shape,
                 const std::vector<LevelSize>& sizes, float factor, VisibleMaps& sums);

}  // namespace aleph
