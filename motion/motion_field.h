#pragma once
// The motion field: where every pixel's surface point goes from one frame to the next. Double precision.

#include <cstdint>
#include <glm/vec2.hpp>

#include "engine/base/image.h"

namespace aleph {

/// motion.valid; the first that applies of: no counterpart, behind the camera, leaves the screen, hidden.
enum class MotionValidity : std::int8_t {
    valid = 1,
    background = 0,       ///< nothing was hit: rotations of camera and environment alone move it
    behind_camera = -1,   ///< at or behind the other frame's near plane; displacement 0
    leaves_screen = -2,   ///< displacement kept
    no_counterpart = -3,  ///< object not visible in the other frame, topology change, camera cut; displacement 0
    hidden = -4,          ///< something covers it in frame N+1; displacement kept
};

/// The frame that motion from frame N leads to.
enum class OtherFrame : std::uint8_t {
    /// N+1.
    next,
    /// N-1, for the last frame. The displacement leads from N-1 to N, so that constant speed gives the same result as
    /// with the next frame.
    previous,
    /// None: a camera cut lies between, or there is only one frame. Displacement and path length are 0, and every
    /// surface pixel is `no_counterpart`.
    none,
};

/// Number of the other frame; `frame` itself where there is none.
inline std::int64_t other_frame_number(std::int64_t frame, OtherFrame other) {
    if (other == OtherFrame::none) return frame;
    return other == OtherFrame::next ? frame + 1 : frame - 1;
}

/// +1, or -1 where the displacement leads from the other frame to this one.
inline double displacement_sign(OtherFrame other) {
    return other == OtherFrame::previous ? -1.0 : 1.0;
}

struct MotionField {
    /// P' - P in pixels, x right, y down, from frame N to N+1. Both are projections of the surface point; the pixel's
    /// centre is not used. Length at most the image diagonal.
    Image<glm::dvec2> displacement;
    /// Length of the path in pixels: |displacement|, or the sum over sub-frame steps where something turns more than
    /// 20 degrees in the frame. A translation counts from end to end: along a closed path within the frame it has 0.
    /// Not negative.
    Image<double> path_length;
    Image<MotionValidity> validity;
};

/// A field in which nothing moves.
inline MotionField make_motion_field(int width, int height, MotionValidity all) {
    return {Image<glm::dvec2>(width, height, glm::dvec2(0.0)), Image<double>(width, height, 0.0),
            Image<MotionValidity>(width, height, all)};
}

}  // namespace aleph
