#pragma once
// Keyed values: a property's samples under a time sampling, and one answer for every time.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "engine/scene/time_sampling.h"

namespace aleph {

enum class Interpolation {
    step,     ///< the sample at or before the time
    linear,   ///< quaternions: slerp, the short way; matrices: polar decomposition, slerp and lerp
    nearest,  ///< the sample nearest in time, the earlier one in a tie
    cubic,    ///< glTF's CUBICSPLINE: values hold in-tangent, value, out-tangent per key
};

/// A constant has one value and any sampling. Values are never empty in a valid scene.
template <class T>
struct Track {
    TimeSampling sampling;
    Interpolation interpolation = Interpolation::linear;
    std::vector<T> values;

    Track() = default;
    Track(const T& constant) : values{constant} {}  // implicit: `node.scale = dvec3(2)` reads as it should

    /// Keys, not values: a cubic key has three values.
    std::size_t key_count() const { return interpolation == Interpolation::cubic ? values.size() / 3 : values.size(); }
    bool operator==(const Track&) const = default;
};

/// The value at a time: exactly the key's on a key, the first's before and the last's after. Equal neighbours give
/// exactly that value, so what does not move is bit for bit the same at every time.
/// Quaternions come back unit; NaN counts as before the first key. Instantiated for double, dvec3, dquat, dmat4.
template <class T>
T evaluate(const Track<T>& track, double seconds);

/// False only where evaluate gives the same value at every time (one key, or all keys and tangents alike).
template <class T>
bool is_animated(const Track<T>& track);

/// Time of the first and of the last key, s.
template <class T>
double first_time(const Track<T>& track) {
    return sample_time(track.sampling, 0);
}
template <class T>
double last_time(const Track<T>& track) {
    return sample_time(track.sampling, track.key_count() - 1);
}

/// Value of a key: the middle one of a cubic key's three.
template <class T>
const T& key_value(const Track<T>& track, std::size_t key) {
    return track.values[track.interpolation == Interpolation::cubic ? 3 * key + 1 : key];
}

/// What every reader checks before it hands a track on: there are keys, a cubic track has three values each, values
/// are finite, no rotation is zero, matrices are affine (last row 0 0 0 1), and times lie as validate(TimeSampling)
/// wants them (one key: any sampling without times will do). Negative times are fine here.
/// @throws InputError with the index of the first bad key in its reason. Same types as evaluate.
template <class T>
void validate(const Track<T>& track, const std::string& file, const std::string& place);

/// The largest turn between two neighbouring keys, degrees, as the signs of the keys tell it: 0 to 270 degrees is
/// 270, although slerp_short will take the 90 back (HARD_CASES RP-08: readers warn above 170). Keys within 20 degrees
/// of each other count as that near: their signs are an exporter's habit, not a turn.
double largest_turn_degrees(const Track<glm::dquat>& track);

/// The shorter great arc from a to b, in double; a tie (exactly 180 degrees) keeps the sign of b.
/// Accurate for every angle: theta = 2 atan2(|a - b|, |a + b|) (HARD_CASES KF-01 to KF-03).
glm::dquat slerp_short(const glm::dquat& a, const glm::dquat& b, double fraction);

/// Between two affine matrices: M = R S each (polar), R by slerp, S and translation by lerp; exact at the ends.
/// A reflection is factored out once, with the sign of both determinants (HARD_CASES KF-21 to KF-23).
glm::dmat4 interpolate_matrix(const glm::dmat4& a, const glm::dmat4& b, double fraction);

}  // namespace aleph
