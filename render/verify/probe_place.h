#pragma once
// Where probes lie: a frame and a block of its picture.

#include <cstdint>
#include <span>

#include "render/verify/picture_area.h"

namespace aleph {

/// A block of a frame's picture.
struct ProbePlace {
    std::int64_t frame = 0;
    PictureArea block;
    bool operator==(const ProbePlace&) const = default;
};

/// The place of a probe. The picture is divided into blocks of equal size, up to 16 pixels wide and high; frames, columns and
/// rows follow a sequence of low discrepancy (the additive recurrence of Roberts 2018), so that any first probes are spread
/// evenly over all three.
/// @param number  of the probe, from 0 on
/// @param frames  at least one
ProbePlace place_probe(std::size_t number, std::span<const std::int64_t> frames, int width, int height);

}  // namespace aleph
