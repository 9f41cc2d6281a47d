#pragma once
// Keys of a glTF animation sampler, and the tracks made of them.

#include <string>
#include <vector>

#include "engine/gltf/reader.h"

namespace aleph {

/// A sampler's keys: per key one row of values, or three (in-tangent, value, out-tangent) under CUBICSPLINE.
struct GltfKeys {
    std::vector<double> times;   ///< s
    std::vector<double> values;  ///< row by row
    std::size_t row = 1;         ///< values in a row
    Interpolation interpolation = Interpolation::linear;
    bool is_float = true;  ///< else small integers

    bool is_cubic() const { return interpolation == Interpolation::cubic; }
    std::size_t rows() const { return values.size() / row; }
    /// False for the tangents of cubic keys.
    bool is_value(std::size_t row_index) const { return !is_cubic() || row_index % 3 == 1; }
    /// The key that a row belongs to.
    std::size_t key_of(std::size_t row_index) const { return is_cubic() ? row_index / 3 : row_index; }
};

/// @param place  of the sampler, for errors
/// @param row    values that one key has; 0: the components of the output accessor
/// @throws InputError where times are negative or do not strictly increase
GltfKeys read_keys(GltfReader& reader, const tinygltf::AnimationSampler& sampler, const std::string& place,
                   std::size_t row = 0);

/// Brings values (not tangents) within a property's range. @return whether any was outside
/// @param takes_zero  0 stays, as it has a meaning of its own
bool clamp_keys(GltfKeys& keys, double low, double high, bool takes_zero = false);

/// A track over `keys` whose values are make(row's numbers, row index).
template <class T, class Make>
Track<T> make_track(GltfReader& reader, const GltfKeys& keys, const std::string& place, const Make& make) {
    reader.accessors.charge(keys.times.size() * sizeof(double) + keys.rows() * sizeof(T), place);
    Track<T> track(keys.times, {}, keys.interpolation);
    track.values.reserve(keys.rows());
    for (std::size_t i = 0; i < keys.rows(); ++i) track.values.push_back(make(&keys.values[i * keys.row], i));
    return track;
}

/// The value `column` of each row.
Track<double> number_track(GltfReader& reader, const GltfKeys& keys, const std::string& place, std::size_t column = 0);
/// The first three values of each row.
Track<glm::dvec3> vector_track(GltfReader& reader, const GltfKeys& keys, const std::string& place);
/// Unit quaternions; a cubic key's tangents are scaled as the key is.
/// @param owner  names the node in warnings
Track<glm::dquat> rotation_track(GltfReader& reader, const GltfKeys& keys, const std::string& place,
                                 const std::string& owner);

}  // namespace aleph
