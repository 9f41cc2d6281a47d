#pragma once
// Words of "interpolation" whose keys are plain values: their tangents are computed on load, and the track is cubic.

#include <array>

#include "engine/json/json_ref.h"
#include "engine/scene/track.h"

namespace aleph {

enum class Easing {
    smooth,    ///< one curve through all keys, at rest at the first and the last
    ease,      ///< at rest at every key
    ease_in,   ///< leaves every key at rest and arrives at full speed: f + (g - f) u^2 of the way u
    ease_out,  ///< leaves at full speed and arrives at rest: the mirror of ease_in
};
inline constexpr std::array easing_words{"smooth", "ease", "ease_in", "ease_out"};

/// The track with the tangents of the easing that the "interpolation" at `at` names; as it is where that names none,
/// and with a single key. Every component stays between its values at the two keys around it. Quaternions come back
/// unit, each with the sign that is nearer to the key before it.
/// The tangents of `smooth` are those of a parabola through the key and its neighbours, limited as by Steffen 1990,
/// Astronomy and Astrophysics 239, 443 (equations 8 and 11).
/// @param track  valid, linear. Instantiated for double, dvec3 and dquat
/// @throws InputError where keys are so near in time that a file cannot hold their tangents
template <class T>
Track<T> apply_easing(const JsonRef& at, Track<T> track);

}  // namespace aleph
