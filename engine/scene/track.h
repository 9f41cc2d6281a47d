#pragma once
// Keyed values: a property's samples, and its value at any time.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <utility>
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
    Track(const T& constant) : values{constant} {}  // implicit, for `node.transform.scale = dvec3(2)`
    /// Keys at these times, s.
    Track(std::vector<double> times, std::vector<T> keys, Interpolation how = Interpolation::linear)
        : sampling{TimeSampling::Kind::acyclic, 0.0, 1.0, std::move(times)},
          interpolation(how),
          values(std::move(keys)) {}

    /// Keys, not values: a cubic key has three values.
    std::size_t key_count() const { return interpolation == Interpolation::cubic ? values.size() / 3 : values.size(); }
    bool operator==(const Track&) const = default;
};

/// Keys of a track, by the name that operation stacks have for theirs (operations.h).
template <class T>
std::size_t sample_count(const Track<T>& track) {
    return track.key_count();
}

/// The value at a time: on a key exactly the key's; before the first key and after the last, theirs. Between equal keys
/// exactly their value, so that what does not move has the same bits at every time.
/// Quaternions come back unit; NaN counts as before the first key. Instantiated for double, dvec3, dquat, dmat4.
template <class T>
T evaluate(const Track<T>& track, double seconds);

/// Value of a key: the middle one of a cubic key's three.
template <class T>
const T& key_value(const Track<T>& track, std::size_t key) {
    return track.values[track.interpolation == Interpolation::cubic ? 3 * key + 1 : key];
}

/// True where keys from the first to the last differ, or a tangent between them is not 0. Same types as evaluate.
template <class T>
bool do_keys_differ(const Track<T>& track, std::size_t first, std::size_t last);

/// False only where evaluate gives the same value at every time (one key, or all keys and tangents alike).
template <class T>
bool is_animated(const Track<T>& track) {
    return track.key_count() > 1 && do_keys_differ(track, 0, track.key_count() - 1);
}

/// Readers call this for every track. There must be keys, three values for each key of a cubic track, finite values, no
/// zero rotation, affine matrices (last row 0 0 0 1), and times that validate(TimeSampling) accepts, but for one key.
/// @throws InputError with the index of the first bad key in its reason. Same types as evaluate.
template <class T>
void validate(const Track<T>& track, const std::string& file, const std::string& place);

/// The largest turn between two neighbouring keys, degrees, by the signs of the quaternions: a turn from 0 to 270
/// degrees counts as 270, although slerp_short takes the 90 degrees back. Readers warn above 170. Keys within 20
/// degrees of each other count as that near: there, exporters choose signs at random.
double largest_turn_degrees(const Track<glm::dquat>& track);

/// The shorter great arc from a to b, in double; a tie (exactly 180 degrees) keeps the sign of b.
/// Accurate for every angle, also near 0 and 180 degrees: theta = 2 atan2(|a - b|, |a + b|).
glm::dquat slerp_short(const glm::dquat& a, const glm::dquat& b, double fraction);

/// Between two affine matrices: M = R S each (polar), R by slerp, S and translation by lerp; exact at the ends. A
/// common reflection is factored out (Shoemake and Duff 1992, "Matrix animation and polar decomposition").
glm::dmat4 interpolate_matrix(const glm::dmat4& a, const glm::dmat4& b, double fraction);

}  // namespace aleph
