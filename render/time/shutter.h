#pragma once
// The time that a frame's samples are spread over while the shutter is open.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "engine/pose/pose.h"

namespace aleph {

/// In frames; `open` is included, `close` is not unless both are equal.
struct ShutterInterval {
    double open = 0.0, close = 0.0;
};

/// Cuts that a camera's keys lead into: it moves from the one shot to the other between the cut's frame and the frame
/// before, as keys on neighbouring frames and sampled cameras do. The shot then ends at the frame before.
/// @param camera  index into ScenePose::cameras, of a frame
std::vector<std::int64_t> find_crossed_cuts(const Scene& scene, const std::function<int(std::int64_t)>& camera);

/// The shutter of a camera at a frame, cut off where another shot begins (Film::cuts).
/// @param shutter  of the camera: open and close, frames relative to the frame
/// @param crossed  find_crossed_cuts
/// @return nothing if the shutter opens for no time at the frame itself
std::optional<ShutterInterval> find_shutter(const Scene& scene, const glm::dvec2& shutter, std::int64_t frame,
                                            const std::vector<std::int64_t>& crossed = {});

/// The time that stands for a whole frame, s: the shutter's centre, or the centre of what a cut leaves of it where
/// its own lies in another shot; the frame's own time if the shutter opens for no time.
double find_shutter_center(const Scene& scene, const glm::dvec2& shutter, std::int64_t frame,
                           const std::vector<std::int64_t>& crossed = {});

/// Pixels whose samples have the same times are of one class. With a single class, what moves is seen as many times
/// over as pixels have samples.
inline constexpr int time_classes = 4;

/// Class of a pixel. The four of a 2x2 block differ.
inline int time_class(int x, int y) {
    return (y & 1) * 2 + (x & 1);
}

}  // namespace aleph
