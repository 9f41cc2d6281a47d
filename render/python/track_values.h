#pragma once
// Tracks of a scene as Python sees them: a constant is a number or an array, what is keyed is a KeyedTrack.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <cstring>
#include <glm/mat4x4.hpp>
#include <glm/matrix.hpp>
#include <string>
#include <type_traits>
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

/// Numbers of a value, which lie one behind the other.
template <class T>
inline constexpr std::size_t count = sizeof(T) / sizeof(double);

template <class T>
std::vector<py::ssize_t> axes() {
    if constexpr (std::is_same_v<T, double>) return {};
    if constexpr (std::is_same_v<T, glm::dmat4>) return {4, 4};
    return {count<T>};
}

/// Matrices row by row, or from that; other values are as numpy has them.
template <class T>
T transposed(const T& value) {
    if constexpr (std::is_same_v<T, glm::dmat4>) return glm::transpose(value);
    return value;
}

template <class T>
void put(const T& value, double* out) {
    const T rows = transposed(value);
    std::memcpy(out, &rows, sizeof rows);
}

template <class T>
T take(const double* in) {
    T rows;
    std::memcpy(static_cast<void*>(&rows), in, sizeof rows);
    return transposed(rows);
}

/// @throws InputError with the place, unless the array has these axes; an empty list is a number
py::array_t<double, py::array::c_style> to_doubles(const py::handle& object, const std::vector<py::ssize_t>& axes,
                                                   const std::string& place);

}  // namespace track_parts

/// @param unit  of C++ in one of Python's: pi / 180 for degrees
template <class T>
py::object track_to_python(const Track<T>& track, double unit = 1.0) {
    const std::vector<py::ssize_t> axes = track_parts::axes<T>();
    constexpr std::size_t parts = track_parts::count<T>;
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
    std::vector<py::ssize_t> axes = track_parts::axes<T>();
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
    std::vector<double> in_unit(numbers.data(), numbers.data() + numbers.size());
    for (double& number : in_unit) number *= unit;
    for (std::size_t i = 0; i < in_unit.size(); i += track_parts::count<T>)
        track.values.push_back(track_parts::take<T>(&in_unit[i]));
    validate(track, "", place);
    return track;
}

}  // namespace aleph::python
