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

/// Time of sample `index`, in frames: an additive sequence over the interval that starts at `shift` of it, in [0,1).
/// Evenly spread for any number of samples, and independent of where the samples lie in their pixels.
double place_in_shutter(const ShutterInterval& shutter, int index, double shift);

}  // namespace aleph
