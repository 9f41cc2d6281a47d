#pragma once
// A function of time as a cubic track: exact at given times, within a tolerance between them.

#include <functional>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "engine/scene/track.h"

namespace aleph {

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
