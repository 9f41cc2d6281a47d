#pragma once
// Values of glTF accessors: any component type, normalized or not, packed or interleaved.

#include <cstdint>
#include <vector>

#include "engine/gltf_source.h"

namespace aleph {

/// A file may decode to so many bytes of vertices, indices and keys, and so many more per byte of its buffers: small
/// files can refer to the same data a million times.
inline constexpr std::uint64_t decoded_bytes_base = std::uint64_t{256} << 20;
inline constexpr std::uint64_t decoded_bytes_per_buffer_byte = 8;

class GltfAccessors {
  public:
    /// @param source  validated; must outlive this
    explicit GltfAccessors(const GltfSource& source);

    /// All components in order. Normalized integers become -1 (or 0) to 1, floats convert exactly.
    /// Instantiated for float and double.
    /// @throws InputError where a value is not finite or beyond +-1e18
    template <class T>
    std::vector<T> read(int accessor);

    /// @throws InputError where an index is not below `vertex_count`
    std::vector<std::uint32_t> read_indices(int accessor, std::size_t vertex_count);

    std::size_t count(int accessor) const;
    int components(int accessor) const;  ///< 3 for VEC3

  private:
    /// Accounts for memory before it is taken. @throws InputError beyond the file's allowance
    void charge(std::uint64_t bytes, const std::string& place);

    const GltfSource& source_;
    std::uint64_t bytes_left_ = decoded_bytes_base;
};

}  // namespace aleph
