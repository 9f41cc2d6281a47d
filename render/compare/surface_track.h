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
    Image<float> valid;   ///< 1 where the motion is valid
    Image<float> object;  ///< number of the instance; empty: all are one
};

/// Reads forward.u, forward.v, motion.valid and objectId.X. Without motion nothing moves: u and v are 0.
MotionMaps read_motion(const ChannelImage& maps);

/// Positions of a frame's pixels in another frame, in pixels; x is NaN where the surface point is unknown there: its
/// motion is invalid, it left the picture, or something else is in front of it.
using TrackImage = Image<glm::vec2>;

/// Positions in the next frames, from the nearest on. @param motion  of this frame and the frames after it
/// @param count  frames to go; at most motion.size() - 1
std::vector<TrackImage> track_forward(std::span<const MotionMaps* const> motion, int count);

/// Positions in the frames before, from the nearest on. @param motion  of this frame, then of those before it
std::vector<TrackImage> track_backward(std::span<const MotionMaps* const> motion, int count);

}  // namespace aleph
