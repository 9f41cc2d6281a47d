#pragma once
// What a viewer tolerates in consecutive frames, and how they move.

#include <vector>

#include "engine/image/image_file.h"
#include "render/frame/sequence.h"

namespace aleph {

/// The motion, objects and thresholds of the frames, for the guide saliency and the settings' model of vision: the
/// channels of `aleph maps` that comparisons of sequences read.
std::vector<ChannelImage> compute_threshold_maps(const Scene& scene, RenderSettings settings, FrameRange range);

}  // namespace aleph
