#pragma once
// Where probes lie: a frame and a block of its picture.

#include <algorithm>
#include <cstdint>
#include <span>

#include "engine/base/image.h"

namespace aleph {

/// A rectangle of a picture, pixels.
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

/// A block of a frame's picture.
struct ProbePlace {
    std::int64_t frame = 0;
    PictureArea block;
    bool operator==(const ProbePlace&) const = default;
};

/// The place of a probe. The picture is divided into blocks of equal size, up to 16 pixels wide and high; frames,
/// columns and rows follow a sequence of low discrepancy (the additive recurrence of Roberts 2018), so that any first
/// probes are spread evenly over all three.
/// @param number  of the probe, from 0 on
/// @param frames  at least one
ProbePlace place_probe(std::size_t number, std::span<const std::int64_t> frames, int width, int height);

}  // namespace aleph
