#pragma once
// Numbers, and tracks from keys.

#include <cmath>
#include <numbers>
#include <vector>

#include "engine/scene/track.h"

namespace aleph {

inline constexpr double pi = std::numbers::pi;

/// Rounds to a millionth, for example to a micrometre: precise enough, and short in a file.
inline double to_millionth(double value) {
    return std::round(value * 1e6) / 1e6;
}
inline glm::dvec3 to_millionth(const glm::dvec3& v) {
    return {to_millionth(v.x), to_millionth(v.y), to_millionth(v.z)};
}

inline glm::dquat to_millionth(const glm::dquat& q) {
    return {to_millionth(q.w), to_millionth(q.x), to_millionth(q.y), to_millionth(q.z)};
}

/// A key of a cubic track. Velocities are per second; at an impact those before and after the key differ.
template <class T>
struct MotionKey {
    double seconds = 0.0;
    T before{};  ///< velocity before the key
    T value{};
    T after{};  ///< velocity after the key
};

template <class T>
Track<T> cubic_track(const std::vector<MotionKey<T>>& keys) {
    Track<T> track({}, {}, Interpolation::cubic);
    for (const MotionKey<T>& key : keys) {
        track.sampling.times.push_back(key.seconds);
        for (const T& value : {key.before, key.value, key.after}) track.values.push_back(to_millionth(value));
    }
    return track;
}

/// A smooth track through values: at rest at both ends; at every other key, the mean of the velocities before and
/// after.
template <class T>
Track<T> eased_track(const std::vector<double>& seconds, const std::vector<T>& values) {
    std::vector<MotionKey<T>> keys;
    for (std::size_t i = 0; i < values.size(); ++i) {
        T velocity{};
        if (i > 0 && i + 1 < values.size()) {
            velocity = 0.5 * ((values[i] - values[i - 1]) / (seconds[i] - seconds[i - 1]) +
                              (values[i + 1] - values[i]) / (seconds[i + 1] - seconds[i]));
        }
        keys.push_back({seconds[i], velocity, values[i], velocity});
    }
    return cubic_track(keys);
}

/// Constant velocity: two keys.
template <class T>
Track<T> even_track(double from, double to, const T& first, const T& last) {
    return {{from, to}, {to_millionth(first), to_millionth(last)}};
}

}  // namespace aleph
