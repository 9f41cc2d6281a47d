#pragma once

#include <vector>

namespace aleph {

struct PixelPlace {
    int x, y;
};

/// The pixels of a picture of this size, row by row.
inline std::vector<PixelPlace> all_pixels(int width, int height) {
    std::vector<PixelPlace> places;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) places.push_back({x, y});
    }
    return places;
}

template <class Picture>
std::vector<PixelPlace> all_pixels(const Picture& picture) {
    return all_pixels(picture.width, picture.height);
}

}  // namespace aleph
