#pragma once
// Motion is found between frame N and one other frame. This says which.

#include <cstdint>

namespace aleph {

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

}  // namespace aleph
