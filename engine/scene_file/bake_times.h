#pragma once
// Times at which the keys of a computed motion lie.

#include <functional>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// The frames that are shown, with those beside them that motion or a shutter reads.
struct BakedFrames {
    FrameRate rate;
    std::int64_t first = 0, last = 0;
};

/// The scene's range (frame_range), and on both sides one frame, or as far as the shutter of a camera is open.
BakedFrames find_baked_frames(const Scene& scene);

/// The frames between the first and the last key of what a motion depends on, outside which it stands still, and the
/// keys that lie between frames. Ascending, at least one. A key within a millionth of a frame of one is on it.
/// @param keys    s, in any order
/// @param charge  called with the number of frames before they are listed
std::vector<double> list_bake_times(const BakedFrames& frames, std::vector<double> keys,
                                    const std::function<void(std::size_t)>& charge);

}  // namespace aleph
