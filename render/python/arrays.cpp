#include "render/python/arrays.h"

#include <fmt/format.h>

#include "engine/base/errors.h"

namespace aleph::python {

namespace {

constexpr py::ssize_t most_pixels = 65536;  // on a side, as in files

[[noreturn]] void refuse_shape(const std::string& what, const char* expected, const py::array& array) {
    throw InputError("", what,
                     fmt::format("expected an array {}, found {} {}", expected,
                                 py::str(py::tuple(array.attr("shape"))).cast<std::string>(),
                                 py::str(array.dtype()).cast<std::string>()));
}

/// @throws InputError unless the array has this many axes and a picture's size
void check_size(const py::array& array, py::ssize_t axes, const std::string& what, const char* expected) {
    const bool fits = array.ndim() == axes && array.shape(0) > 0 && array.shape(1) > 0 &&
                      array.shape(0) <= most_pixels && array.shape(1) <= most_pixels;
    if (!fits) refuse_shape(what, expected, array);
}

template <class Number, class Pixel>
Image<Pixel> copy_pixels(const py::array& array) {
    const py::array_t<Number, py::array::c_style | py::array::forcecast> numbers(array);
    Image<Pixel> image(static_cast<int>(numbers.shape(1)), static_cast<int>(numbers.shape(0)));
    const auto* const data = reinterpret_cast<const Pixel*>(numbers.data());
    image.pixels.assign(data, data + image.size());
    return image;
}

py::array to_array(const py::object& object, const std::string& what) {
    py::array array = py::array::ensure(object);
    const char kind = array ? array.dtype().kind() : 'O';
    if (kind != 'f' && kind != 'i' && kind != 'u' && kind != 'b') {
        PyErr_Clear();
        throw InputError("", what, "expected an array of numbers");
    }
    return array;
}

}  // namespace

Image<Rgb> take_color(const py::object& object, const std::string& what) {
    constexpr const char* expected = "(height, width, 3) of linear floats, or of sRGB bytes";
    const py::array array = to_array(object, what);
    check_size(array, 3, what, expected);
    const bool bytes = array.dtype().kind() == 'u' && array.itemsize() == 1;
    if (array.shape(2) != 3 || !(bytes || array.dtype().kind() == 'f')) refuse_shape(what, expected, array);
    Image<Rgb> image = copy_pixels<float, Rgb>(array);
    if (!bytes) return image;
    for (Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) pixel[c] = srgb_to_linear(pixel[c] / 255.0f);
    }
    return image;
}

Image<float> take_numbers(const py::object& object, const std::string& what) {
    const py::array array = to_array(object, what);
    check_size(array, 2, what, "(height, width)");
    return copy_pixels<float, float>(array);
}

Image<glm::dvec2> take_vectors(const py::object& object, const std::string& what) {
    constexpr const char* expected = "(height, width, 2)";
    const py::array array = to_array(object, what);
    check_size(array, 3, what, expected);
    if (array.shape(2) != 2) refuse_shape(what, expected, array);
    return copy_pixels<double, glm::dvec2>(array);
}

}  // namespace aleph::python
