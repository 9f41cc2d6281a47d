#pragma once
// Rectangles of a picture.

#include <algorithm>

#include "engine/base/image.h"

namespace aleph {

/// Pixels.
struct PictureArea {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const PictureArea&) const = default;
};

template <class T>
Image<T> crop(const Image<T>& image, const PictureArea& area) {
    Image<T> out(area.width, area.height);
    for (int y = 0; y < area.height; ++y) std::copy_n(image.row(area.y + y) + area.x, area.width, out.row(y));
    return out;
}

}  // namespace aleph
