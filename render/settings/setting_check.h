#pragma once
// Values of settings that are text.

#include <optional>
#include <string>

namespace aleph {

struct PictureSize {
    int width = 0, height = 0;  ///< pixels
};

/// "640x480": two numbers of any range.
std::optional<PictureSize> parse_picture_size(const std::string& text);

}  // namespace aleph
