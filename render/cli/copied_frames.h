#pragma once
// Which frames are copies of others, in words.

#include <string>
#include <vector>

#include "render/frame_output.h"

namespace aleph {

/// Lines such as "aleph: frames 12-30 are copies of frame 11: nothing changes", one for every frame that others copy,
/// in the order of `frames`; a last line counts those beyond the fourth. Empty if no frame is a copy.
std::string describe_copies(const std::vector<FrameStatistics>& frames);

}  // namespace aleph
