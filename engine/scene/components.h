#pragma once
// The numbers that a keyed value is made of.

#include <cmath>
#include <cstddef>
#include <glm/gtc/type_ptr.hpp>
#include <span>
#include <type_traits>

namespace aleph {

/// The parts of a double, a vector, a quaternion (x, y, z, w) or a matrix (column by column), all of doubles.
template <class T>
auto components(T& value) {
    using Number = std::conditional_t<std::is_const_v<T>, const double, double>;
    constexpr std::size_t count = sizeof(T) / sizeof(double);
    if constexpr (count == 1) {
        return std::span<Number, count>(&value, count);
    } else {
        return std::span<Number, count>(glm::value_ptr(value), count);
    }
}

/// Each component by itself.
template <class T>
T lerp_components(const T& a, const T& b, double fraction) {
    T result = a;
    for (std::size_t i = 0; i < components(a).size(); ++i)
        components(result)[i] = std::lerp(components(a)[i], components(b)[i], fraction);
    return result;
}

}  // namespace aleph
