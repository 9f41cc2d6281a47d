#pragma once
// A rectangle of a picture, and what an image shows of it.

#include <algorithm>

#include "engine/base/image.h"

namespace aleph {

/// Pixels.
struct PictureArea {
    int x = 0, y = 0, width = 0, height = 0;
    bool operator==(const PictureArea&) const = default;
};

/// Returns whether it has pixels, all of them in a picture of this size.
inline bool lies_within(const PictureArea& area, int width, int height) {
    const auto fits = [](int first, int count, int all) { return first >= 0 && count > 0 && count <= all - first; };
    return fits(area.x, area.width, width) && fits(area.y, area.height, height);
}

/// @param area  within the image
template <class T>
Image<T> crop(const Image<T>& image, const PictureArea& area) {
    Image<T> out(area.width, area.height);
    for (int y = 0; y < area.height; ++y) std::copy_n(image.row(area.y + y) + area.x, area.width, out.row(y));
    return out;
}

}  // namespace aleph
