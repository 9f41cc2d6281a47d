#pragma once
// Long lists of numbers in scene files: points, texture coordinates, indices. Every float is written exactly.

#include <cstddef>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>
#include <nlohmann/json.hpp>
#include <vector>

#include "engine/json/json_ref.h"

namespace aleph {

// A list is flat ([0, 0, 0, 1, 0, 0]) or made of lists of the vector's size ([[0, 0, 0], [1, 0, 0]]).
// @throws InputError with the pointer of an element that is no number, or of a list of the wrong length
template <class Vector>  // vec2, vec3 or vec4
std::vector<Vector> read_vectors(const JsonRef& at);

/// Indices below `count`, flat or in lists of `width`; their number is a multiple of width.
/// @param kind  of the elements, for messages
std::vector<int> read_indices(const JsonRef& at, std::size_t width, std::size_t count, const char* kind);

/// An index below `count`.
int read_index(const JsonRef& at, std::size_t count, const char* kind);

/// A flat list. Each float is the shortest decimal that gives it back.
nlohmann::ordered_json write_floats(const float* first, std::size_t count);
template <class Vector>
nlohmann::ordered_json write_vectors(const std::vector<Vector>& values) {
    return write_floats(values.empty() ? nullptr : &values.front().x, values.size() * Vector::length());
}

/// The double with the shortest decimal of the float: 0.1f becomes 0.1.
double widen(float value);

}  // namespace aleph
