#include "engine/scene/track.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <type_traits>

#include "engine/base/errors.h"
#include "engine/scene/components.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

template <class T>
T interpolate(const T& a, const T& b, double fraction) {
    if constexpr (std::is_same_v<T, glm::dquat>) {
        return slerp_short(a, b, fraction);
    } else if constexpr (std::is_same_v<T, glm::dmat4>) {
        return interpolate_matrix(a, b, fraction);
    } else {
        return lerp_components(a, b, fraction);
    }
}

/// glTF 2.0, appendix C.5: tangents are per second, so they count times the interval. Written around the first value,
/// so that equal keys without tangents give exactly their value.
template <class T>
T hermite(const T& a, const T& out_tangent, const T& in_tangent, const T& b, double fraction, double interval) {
    const double s = fraction, s2 = s * s, s3 = s2 * s;
    const double to_b = 3.0 * s2 - 2.0 * s3;
    const double leaving = interval * (s3 - 2.0 * s2 + s), arriving = interval * (s3 - s2);
    T result = a;
    for (std::size_t i = 0; i < components(a).size(); ++i) {
        const double from = components(a)[i];
        components(result)[i] = from + (components(b)[i] - from) * to_b + components(out_tangent)[i] * leaving +
                                components(in_tangent)[i] * arriving;
    }
    return result;
}

template <class T>
T cubic_between(const T* key, double fraction, double interval) {
    return hermite(key[1], key[2], key[3], key[4], fraction, interval);
}

/// 1 / |key| without squares that overflow or underflow: by powers of two, which change no bits of others.
double inverse_length(const glm::dquat& key) {
    const int exponent = std::ilogb(std::max({std::abs(key.x), std::abs(key.y), std::abs(key.z), std::abs(key.w)}));
    glm::dquat near_one = key;
    for (double& c : components(near_one)) c = std::scalbn(c, -exponent);
    return std::scalbn(1.0 / glm::length(near_one), -exponent);
}

/// Keys at length 1, their tangents by the same factor. Where the curve passes through zero it has no direction, and
/// the nearer key holds.
template <>
glm::dquat cubic_between(const glm::dquat* key, double fraction, double interval) {
    const glm::dquat a = safe_normalize(key[1]), b = safe_normalize(key[4]);
    const double scale_a = a == key[1] ? 1.0 : inverse_length(key[1]);
    const double scale_b = b == key[4] ? 1.0 : inverse_length(key[4]);
    const glm::dquat curve = hermite(a, key[2] * scale_a, key[3] * scale_b, b, fraction, interval);
    if (!(glm::length(curve) >= 1e-6)) return fraction < 0.5 ? a : b;
    return safe_normalize(curve);
}

template <class T>
const T& as_valid(const T& value) {
    return value;
}
glm::dquat as_valid(const glm::dquat& value) {
    return safe_normalize(value);
}

template <class T>
const char* fault_of_key(const T&) {
    return nullptr;
}
const char* fault_of_key(const glm::dquat& value) {
    const auto is_nothing = [](double c) { return std::abs(c) < std::numeric_limits<double>::min(); };
    return std::ranges::all_of(components(value), is_nothing) ? "its rotation is zero" : nullptr;
}
const char* fault_of_key(const glm::dmat4& m) {
    const bool affine = m[0].w == 0.0 && m[1].w == 0.0 && m[2].w == 0.0 && m[3].w == 1.0;
    return affine ? nullptr : "its matrix is not affine: the last row must be 0 0 0 1";
}

/// Polar decomposition: M = sign * rotation * stretch; sign is -1 where M mirrors, and then goes with the stretch.
struct Polar {
    glm::dquat rotation;
    glm::dmat3 stretch;
    double sign;
    bool singular;
};

Polar decompose_polar(const glm::dmat3& m) {
    // Below this ratio of singular values the rotation is rounding error.
    constexpr double singular_ratio = 1e-12;
    const SingularValues svd = decompose_singular(m);
    const glm::dvec3& sigma = svd.sigma;
    const double largest = std::max({sigma.x, sigma.y, sigma.z});
    if (!(std::min({sigma.x, sigma.y, sigma.z}) > singular_ratio * largest)) return {{}, {}, 1.0, true};

    const glm::dmat3 orthogonal = svd.u * glm::transpose(svd.v);
    const double sign = glm::determinant(orthogonal) < 0.0 ? -1.0 : 1.0;
    const glm::dmat3 scaled(svd.v[0] * sigma.x, svd.v[1] * sigma.y, svd.v[2] * sigma.z);
    return {safe_normalize(glm::quat_cast(orthogonal * sign)), scaled * glm::transpose(svd.v), sign, false};
}

}  // namespace

template <class T>
T evaluate(const Track<T>& track, double seconds) {
    const std::size_t keys = track.key_count();
    if (keys <= 1) return as_valid(key_value(track, 0));
    const SampleSpan span = find_samples(track.sampling, keys, seconds);
    if (span.floor == span.ceil || track.interpolation == Interpolation::step)
        return as_valid(key_value(track, span.floor));
    if (track.interpolation == Interpolation::nearest)
        return as_valid(key_value(track, nearest_sample(track.sampling, keys, seconds)));
    if (track.interpolation == Interpolation::linear)
        return interpolate(track.values[span.floor], track.values[span.ceil], span.fraction);
    const double interval = sample_time(track.sampling, span.ceil) - sample_time(track.sampling, span.floor);
    return cubic_between(&track.values[3 * span.floor], span.fraction, interval);
}

template <class T>
bool do_keys_differ(const Track<T>& track, std::size_t first, std::size_t last) {
    for (std::size_t key = first + 1; key <= last; ++key)
        if (key_value(track, key) != key_value(track, first)) return true;
    if (track.interpolation != Interpolation::cubic) return false;
    const auto is_zero = [](double c) { return c == 0.0; };
    for (std::size_t i = 3 * first + 2; i + 2 < 3 * (last + 1); ++i)
        if (i % 3 != 1 && !std::ranges::all_of(components(track.values[i]), is_zero)) return true;
    return false;
}

template <class T>
void validate(const Track<T>& track, const std::string& file, const std::string& place) {
    const bool cubic = track.interpolation == Interpolation::cubic;
    if (track.values.empty()) throw InputError(file, place, "it has no keys");
    if (cubic && track.values.size() % 3 != 0)
        throw InputError(
            file, place,
            fmt::format("{} values: a cubic key has three (in-tangent, value, out-tangent)", track.values.size()));
    const std::size_t keys = track.key_count();
    if (keys > 1 || !track.sampling.times.empty()) validate(track.sampling, keys, file, place);
    for (std::size_t i = 0; i < track.values.size(); ++i)
        for (const double c : components(track.values[i]))
            if (!std::isfinite(c))
                throw InputError(file, place, fmt::format("key {}: it holds {}", cubic ? i / 3 : i, c));
    for (std::size_t i = 0; i < keys; ++i)
        if (const char* fault = fault_of_key(key_value(track, i)))
            throw InputError(file, place, fmt::format("key {}: {}", i, fault));
}

#define ALEPH_INSTANTIATE_TRACK(T)                                           \
    template T evaluate(const Track<T>&, double);                            \
    template bool do_keys_differ(const Track<T>&, std::size_t, std::size_t); \
    template void validate(const Track<T>&, const std::string&, const std::string&);
ALEPH_INSTANTIATE_TRACK(double)
ALEPH_INSTANTIATE_TRACK(glm::dvec3)
ALEPH_INSTANTIATE_TRACK(glm::dquat)
ALEPH_INSTANTIATE_TRACK(glm::dmat4)
#undef ALEPH_INSTANTIATE_TRACK

double largest_turn_degrees(const Track<glm::dquat>& track) {
    constexpr double degrees_per_radian = 180.0 / std::numbers::pi;
    double largest = 0.0;
    for (std::size_t i = 1; i < track.key_count(); ++i) {
        const glm::dquat a = safe_normalize(key_value(track, i - 1)), b = safe_normalize(key_value(track, i));
        // Half the turn is the angle between the quaternions.
        const double turn = 4.0 * std::atan2(glm::length(a - b), glm::length(a + b)) * degrees_per_radian;
        const double shorter = std::min(turn, 360.0 - turn);
        largest = std::max(largest, shorter <= 20.0 ? shorter : turn);
    }
    return largest;
}

glm::dquat slerp_short(const glm::dquat& from, const glm::dquat& to, double fraction) {
    const glm::dquat a = safe_normalize(from);
    glm::dquat b = safe_normalize(to);
    if (glm::dot(a, b) < 0.0) b = -b;
    if (a == b) return a;
    const double theta = 2.0 * std::atan2(glm::length(a - b), glm::length(a + b));  // at most pi / 2 after the flip
    const double sine = std::sin(theta);
    if (!(sine > 0.0)) return a;
    return safe_normalize(a * (std::sin((1.0 - fraction) * theta) / sine) + b * (std::sin(fraction * theta) / sine));
}

glm::dmat4 interpolate_matrix(const glm::dmat4& a, const glm::dmat4& b, double fraction) {
    if (fraction <= 0.0 || a == b) return a;
    if (fraction >= 1.0) return b;
    glm::dmat4 result = lerp_components(a, b, fraction);
    if (glm::dmat3(a) == glm::dmat3(b)) return result;  // a pure move, exactly

    const Polar from = decompose_polar(glm::dmat3(a)), to = decompose_polar(glm::dmat3(b));
    // On the way into or out of a mirror the object has to pass through flat: it does so without a turn.
    if (from.singular || to.singular || from.sign != to.sign) return result;
    const glm::dmat3 rotation = glm::mat3_cast(slerp_short(from.rotation, to.rotation, fraction));
    const glm::dmat3 linear = rotation * lerp_components(from.stretch, to.stretch, fraction) * from.sign;
    for (int column = 0; column < 3; ++column) result[column] = glm::dvec4(linear[column], 0.0);
    return result;
}

}  // namespace aleph
