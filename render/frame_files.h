#pragma once
// A frame as files: channels and metadata (DESIGN "Command line", CONVENTIONS 2).

#include "engine/image/image_file.h"
#include "render/sequence.h"

namespace aleph {

/// R, G, B, A of the picture where it was rendered; with `maps` every map's channels as well.
/// Maps that were not made (of geometry and rendering, for frames without a scene) have no channels.
/// forward.u and forward.v are y up; the C++ MotionField is y down.
ChannelImage make_frame_image(const FrameOutput& output, bool maps, const Scene& scene, const RenderSettings& settings,
                              double exposure);

/// {"frames": [...], "settings": {...}, ...} as text. Times, host and threads stand here and nowhere else.
std::string format_statistics(const std::vector<FrameStatistics>& frames, const Scene& scene,
                              const RenderSettings& settings, double exposure);

}  // namespace aleph
