#pragma once
// Tracks of a scene as Python sees them: a constant is a number or an array, what is keyed is a KeyedTrack.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <vector>

#include "engine/base/errors.h"
#include "engine/scene/track.h"

namespace aleph::python {

namespace py = pybind11;

/// Keys with their values, which do not change: an array (keys, ...), of a cubic track (keys, 3, ...) with in-tangent,
/// value and out-tangent. Quaternions are x, y, z, w; matrices (4, 4) act on column vectors.
struct KeyedTrack {
    TimeSampling sampling;
    Interpolation interpolation = Interpolation::linear;
    py::array_t<double> values;
};

namespace track_parts {

/// Axes of a value.
inline std::vector<py::ssize_t> axes(const double&) {
    return {};
}
inline std::vector<py::ssize_t> axes(const glm::dvec3&) {
    return {3};
}
inline std::vector<py::ssize_t> axes(const glm::dquat&) {
    return {4};
}
inline std::vector<py::ssize_t> axes(const glm::dmat4&) {
    return {4, 4};
}

inline void put(const double& value, double* out) {
    *out = value;
}
inline void put(const glm::dvec3& value, double* out) {
    for (int i = 0; i < 3; ++i) out[i] = value[i];
}
inline void put(const glm::dquat& value, double* out) {
    out[0] = value.x, out[1] = value.y, out[2] = value.z, out[3] = value.w;
}
inline void put(const glm::dmat4& value, double* out) {
    for (int i = 0; i < 16; ++i) out[i] = value[i % 4][i / 4];
}

inline void take(const double* in, double& value) {
    value = *in;
}
inline void take(const double* in, glm::dvec3& value) {
    value = {in[0], in[1], in[2]};
}
inline void take(const double* in, glm::dquat& value) {
    value = glm::dquat(in[3], in[0], in[1], in[2]);
}
inline void take(const double* in, glm::dmat4& value) {
    for (int i = 0; i < 16; ++i) value[i % 4][i / 4] = in[i];
}

inline py::ssize_t count(const std::vector<py::ssize_t>& axes) {
    py::ssize_t product = 1;
    for (const py::ssize_t axis : axes) product *= axis;
    return product;
}

/// @throws InputError with the place, unless the array has these axes; an empty list is a number
py::array_t<double, py::array::c_style> to_doubles(const py::handle& object, const std::vector<py::ssize_t>& axes,
                                                   const std::string& place);

}  // namespace track_parts

/// @param unit  of C++ in one of Python's: pi / 180 for degrees
template <class T>
py::object track_to_python(const Track<T>& track, double unit = 1.0) {
    const std::vector<py::ssize_t> axes = track_parts::axes(T{});
    const auto parts = static_cast<std::size_t>(track_parts::count(axes));
    std::vector<double> numbers(track.values.size() * parts);
    for (std::size_t i = 0; i < track.values.size(); ++i) track_parts::put(track.values[i], &numbers[i * parts]);
    for (double& number : numbers) number /= unit;
    if (track.values.size() == 1 && axes.empty()) return py::float_(numbers.front());
    std::vector<py::ssize_t> shape = axes;
    if (track.values.size() == 1) return py::array_t<double>(shape, numbers.data());
    if (track.interpolation == Interpolation::cubic) shape.insert(shape.begin(), 3);
    shape.insert(shape.begin(), static_cast<py::ssize_t>(track.key_count()));
    py::array_t<double> values(shape, numbers.data());
    values.attr("flags").attr("writeable") = false;
    return py::cast(KeyedTrack{track.sampling, track.interpolation, std::move(values)});
}

/// @param place  in messages: "node 'ball': translation"
/// @throws InputError
template <class T>
Track<T> track_from_python(const py::handle& object, const std::string& place, double unit = 1.0) {
    std::vector<py::ssize_t> axes = track_parts::axes(T{});
    const auto parts = static_cast<std::size_t>(track_parts::count(axes));
    Track<T> track;
    py::object values = py::reinterpret_borrow<py::object>(object);
    if (py::isinstance<KeyedTrack>(object)) {
        const auto& keyed = object.cast<const KeyedTrack&>();
        track.sampling = keyed.sampling;
        track.interpolation = keyed.interpolation;
        values = keyed.values;
        if (keyed.interpolation == Interpolation::cubic) axes.insert(axes.begin(), 3);
        axes.insert(axes.begin(), keyed.values.ndim() > 0 ? keyed.values.shape(0) : 0);
    }
    const auto numbers = track_parts::to_doubles(values, axes, place);
    track.values.resize(static_cast<std::size_t>(numbers.size()) / parts);
    for (std::size_t i = 0; i < track.values.size(); ++i) {
        std::vector<double> value(numbers.data() + i * parts, numbers.data() + (i + 1) * parts);
        for (double& number : value) number *= unit;
        track_parts::take(value.data(), track.values[i]);
    }
    validate(track, "", place);
    return track;
}

}  // namespace aleph::python
