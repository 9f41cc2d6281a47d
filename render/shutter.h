#pragma once
// The time that a frame's samples are spread over while the shutter is open.

#include <cstdint>
#include <optional>

#include "engine/pose/pose.h"

namespace aleph {

/// In frames; `open` is included, `close` is not unless both are equal.
struct ShutterInterval {
    double open = 0.0, close = 0.0;
};

/// The shutter of a camera at a frame, cut off where another shot begins (Scene::cuts).
/// @return nothing if the shutter opens for no time at the frame itself
std::optional<ShutterInterval> find_shutter(const Scene& scene, const CameraValues& camera, std::int64_t frame);

/// Pixels whose samples have the same times are of one class. With a single class, what moves is seen as many times
/// over as pixels have samples.
inline constexpr int time_classes = 4;

/// Class of a pixel. The four of a 2x2 block differ.
inline int time_class(int x, int y) {
    return (y & 1) * 2 + (x & 1);
}

/// Time of sample `index` of pixels of a class, in frames: additive sequences over the interval that start at `shift`
/// of it, in [0,1). Those of one class, and those of all classes together, are evenly spread for any number of samples.
double place_in_shutter(const ShutterInterval& shutter, int index, int pixel_class, double shift);

}  // namespace aleph
