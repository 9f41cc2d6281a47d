#pragma once
// A computed motion as a cubic track: the times of its keys, where it is exact, and a tolerance between them.

#include <functional>
#include <vector>

#include "engine/scene/scene.h"

namespace aleph {

/// The frames that are shown, with those beside them that motion or a shutter reads.
struct BakedFrames {
    FrameRate rate;
    std::int64_t first = 0, last = 0;
};

/// The scene's range (frame_range), and on both sides one frame, or as far as the shutter of a camera is open.
BakedFrames find_baked_frames(const Scene& scene);

/// The frames between the first and the last key of what a motion depends on, outside which it stands still, and the
/// keys that lie between frames. Ascending, at least one. A key within a millionth of a frame of one is on it.
/// @param keys    s, in any order
/// @param charge  called with the number of frames before they are listed
std::vector<double> list_bake_times(const BakedFrames& frames, std::vector<double> keys,
                                    const std::function<void(std::size_t)>& charge);

template <class T>
struct Motion {
    /// The value at a time, s. Rotations have two signs and may be undefined at times: `near` is the value at the key
    /// before or at a neighbour.
    std::function<T(double seconds, const T& near)> value;
    double tolerance = 0.0;  ///< between keys: units of the vector, or the angle of the rotation, rad
};

/// Keys at `times` with exactly the values there. Halves are inserted until the track is within the tolerance at three
/// times between keys; after 12 halvings the motion counts as a jump, without overshoot. Keys of what stands still are
/// left out.
/// @param times   s, ascending, at least one
/// @param first   `near` of the first value
/// @param charge  called with the bytes of every key
template <class T>
Track<T> bake_track(const Motion<T>& motion, const std::vector<double>& times, const T& first,
                    const std::function<void(std::size_t)>& charge);

/// Bytes of a key.
template <class T>
constexpr std::size_t baked_key_bytes = 2 * (3 * sizeof(T) + sizeof(double));  // while the vectors grow

}  // namespace aleph
