#pragma once
// Where the surface point of each pixel is in the frames around it, from the motion of every frame to the next.

#include <glm/vec2.hpp>
#include <span>
#include <vector>

#include "engine/image/image_file.h"

namespace aleph {

/// Motion of a frame's pixels to the next frame.
struct MotionMaps {
    Image<float> u, v;    ///< pixels; u to the right, v upwards
    Image<float> valid;   ///< MotionValidity
    Image<float> object;  ///< number of the instance; empty: all are one
};

/// Returns whether the point seen in a pixel is at the place that the motion leads to: of a surface, or of the
/// background, which moves as well.
inline bool moves_as_told(float valid) {
    return valid == 1.0f || valid == 0.0f;
}

/// Reads forward.u, forward.v, motion.valid and objectId.X. Without motion nothing moves: u and v are 0.
MotionMaps read_motion(const ChannelImage& maps);

/// Positions of a frame's pixels in another frame, in pixels; x is NaN where the surface point is unknown there: its
/// motion is invalid, it left the picture, or something else is in front of it.
using TrackImage = Image<glm::vec2>;

/// Positions in the next frames and in those before, from the nearest on.
struct SurfaceTracks {
    std::vector<TrackImage> after, before;
};

/// @param motion  of consecutive frames
/// @param own     index of the frame whose pixels are followed
SurfaceTracks track_surfaces(std::span<const MotionMaps* const> motion, std::size_t own);

}  // namespace aleph
