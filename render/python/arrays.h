#pragma once
// Images as numpy arrays: without a copy where C++ gives them, with one where it takes them.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <glm/vec2.hpp>
#include <string>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"

namespace aleph::python {

namespace py = pybind11;

/// A read-only array that shares the image's memory, (height, width) or with a last axis of `parts` numbers; None for
/// an empty image.
/// @param owner  a Python object that keeps the image alive and does not move it
template <class Number, class Pixel>
py::object share_image(const Image<Pixel>& image, const py::object& owner) {
    if (image.empty()) return py::none();
    static_assert(sizeof(Pixel) % sizeof(Number) == 0);
    constexpr py::ssize_t parts = sizeof(Pixel) / sizeof(Number), size = sizeof(Pixel);
    std::vector<py::ssize_t> shape{image.height, image.width}, strides{size * image.width, size};
    if (parts > 1) {
        shape.push_back(parts);
        strides.push_back(sizeof(Number));
    }
    const auto* const data = reinterpret_cast<const Number*>(image.pixels.data());
    py::array_t<Number> array(shape, strides, data, owner);
    array.attr("flags").attr("writeable") = false;
    return array;
}

/// Linear RGB of an array (height, width, 3): floats, or bytes in sRGB.
/// @throws InputError naming `what` for another shape or type
Image<Rgb> take_color(const py::object& array, const std::string& what);

/// Numbers of an array (height, width).
/// @throws InputError naming `what` for another shape
Image<float> take_numbers(const py::object& array, const std::string& what);

/// Pairs of numbers of an array (height, width, 2).
/// @throws InputError naming `what` for another shape
Image<glm::dvec2> take_vectors(const py::object& array, const std::string& what);

/// An array of one dimension.
template <class Number>
py::array_t<Number> copy_list(const std::vector<Number>& values) {
    return py::array_t<Number>(static_cast<py::ssize_t>(values.size()), values.data());
}

}  // namespace aleph::python
