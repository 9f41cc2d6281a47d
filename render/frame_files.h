#pragma once
// A frame as an EXR file, with channels and attributes, and the statistics of frames as JSON.

#include "engine/image/image_file.h"
#include "engine/scene/scene.h"
#include "render/frame_output.h"
#include "render/settings.h"

namespace aleph {

/// The channels R, G, B, A if the picture was rendered, and with `maps` those of every map that was made.
/// render/README.md describes the channels. forward.v is positive upwards; MotionField of C++ is positive downwards.
ChannelImage make_frame_image(const FrameOutput& output, bool maps, const Scene& scene, const RenderSettings& settings,
                              double exposure);

/// {"frames": [...], "settings": {...}, ...} as text. Times, host and number of threads are only here, so that EXR
/// files do not depend on them.
std::string format_statistics(const std::vector<FrameStatistics>& frames, const Scene& scene,
                              const RenderSettings& settings, double exposure);

}  // namespace aleph
