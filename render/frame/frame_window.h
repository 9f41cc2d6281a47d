#pragma once
// A window of a frame: the pixels that its picture takes samples for, and the images cut to it.

#include "render/frame/frame_output.h"
#include "render/pixels/picture_part.h"
#include "render/settings/settings.h"

namespace aleph {

/// The pixels of a window, and those around it whose samples its own pixels need: to decide when they have enough, and
/// for light that is shared out among pixels (spread_lost_light).
PicturePart choose_window_part(const RenderSettings& settings, double pixels_per_degree, const PictureArea& window);

/// Cuts every image to a window, and counts the errors within it.
void cut_to_window(FrameOutput& output, const PictureArea& window);

}  // namespace aleph
