#pragma once

#include "engine/image/image_file.h"

namespace aleph {

/// A picture of one grey.
inline ChannelImage grey_image(int width, int height, float value) {
    ChannelImage image;
    for (const char* name : {"R", "G", "B"}) image.channels.push_back({name, Image<float>(width, height, value)});
    return image;
}

}  // namespace aleph
