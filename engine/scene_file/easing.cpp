// Words of "interpolation" whose keys are plain values: their tangents are computed on load, and the track is cubic.

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <type_traits>

#include "engine/scene/components.h"
#include "engine/scene/transforms.h"
#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

enum class Easing {
    smooth,    ///< one curve through all keys, at rest at the first and the last
    ease,      ///< at rest at every key
    ease_in,   ///< leaves every key at rest and arrives at full speed: f + (g - f) u^2 of the way u
    ease_out,  ///< leaves at full speed and arrives at rest: the mirror of ease_in
};
inline constexpr std::array easing_words{"smooth", "ease", "ease_in", "ease_out"};

/// Slope at a key between two intervals. No steeper than twice the flatter of them, so that the curve stays monotone;
/// 0 where the key is an extreme.
double limited_slope(double before, double length_before, double after, double length_after) {
    if (!(before > 0.0 && after > 0.0) && !(before < 0.0 && after < 0.0)) return 0.0;
    const double share = length_after / (length_before + length_after);
    const double parabola = before * share + after * (1.0 - share);
    return 2.0 * std::copysign(std::min({std::abs(before), std::abs(after), 0.5 * std::abs(parabola)}), before);
}

/// Neighbours with the signs between which there is no turn of more than 180 degrees.
void align_signs(std::vector<glm::dquat>& values) {
    for (glm::dquat& value : values) value = safe_normalize(value);
    for (std::size_t i = 1; i < values.size(); ++i) {
        if (glm::dot(values[i], values[i - 1]) < 0.0) values[i] = -values[i];
    }
}

template <class T>
Track<T> with_tangents(Track<T> track, Easing easing) {
    const std::size_t keys = track.values.size();
    std::vector<T>& values = track.values;
    if constexpr (std::is_same_v<T, glm::dquat>) align_signs(values);
    const auto length = [&](std::size_t i) {
        return sample_time(track.sampling, i + 1) - sample_time(track.sampling, i);
    };
    const auto slope = [&](std::size_t i) { return (values[i + 1] - values[i]) / length(i); };
    Track<T> cubic;
    cubic.sampling = track.sampling;
    cubic.interpolation = Interpolation::cubic;
    cubic.values.reserve(3 * keys);
    for (std::size_t i = 0; i < keys; ++i) {
        const bool inner = i > 0 && i + 1 < keys;
        T in = values[i] - values[i], out = in;
        if (easing == Easing::smooth && inner) {
            const T before = slope(i - 1), after = slope(i);
            for (std::size_t k = 0; k < components(in).size(); ++k)
                components(in)[k] =
                    limited_slope(components(before)[k], length(i - 1), components(after)[k], length(i));
            out = in;
        }
        if (easing == Easing::ease_in && i > 0) in = slope(i - 1) * 2.0;
        if (easing == Easing::ease_out && i + 1 < keys) out = slope(i) * 2.0;
        cubic.values.insert(cubic.values.end(), {in, values[i], out});
    }
    return cubic;
}

/// Keys that are near in time and far apart have tangents that a file cannot hold.
template <class T>
void check_tangents(const JsonRef& at, const Track<T>& track) {
    for (std::size_t i = 0; i < track.values.size(); ++i) {
        for (const double component : components(track.values[i])) {
            if (std::abs(component) <= max_json_number) continue;
            at.fail(fmt::format("key {}: its tangent {} is beyond {}; the keys are too near in time", i / 3, component,
                                max_json_number));
        }
    }
}

}  // namespace

template <class T>
Track<T> apply_easing(const JsonRef& at, Track<T> track) {
    const std::string word = at.find_string("interpolation").value_or("");
    const auto found = std::find(easing_words.begin(), easing_words.end(), word);
    if (found == easing_words.end() || track.values.size() < 2) return track;
    Track<T> eased = with_tangents(std::move(track), static_cast<Easing>(found - easing_words.begin()));
    check_tangents(at, eased);
    return eased;
}

template Track<double> apply_easing(const JsonRef&, Track<double>);
template Track<glm::dvec3> apply_easing(const JsonRef&, Track<glm::dvec3>);
template Track<glm::dquat> apply_easing(const JsonRef&, Track<glm::dquat>);

}  // namespace aleph
