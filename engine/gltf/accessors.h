#pragma once
// Values of glTF accessors: any component type, normalized or not, packed, interleaved or sparse.

#include <cstdint>
#include <vector>

#include "engine/gltf/source.h"

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

    /// @param kind  what the indices count, for the message
    /// @throws InputError where an index is not below `limit`
    std::vector<std::uint32_t> read_indices(int accessor, std::size_t limit, const char* kind = "vertex");

    std::size_t count(int accessor) const;
    int components(int accessor) const;  ///< 3 for VEC3
    bool is_float(int accessor) const;

    /// Accounts for memory before it is taken, by whoever multiplies what was read.
    /// @throws InputError beyond the file's allowance
    void charge(std::uint64_t bytes, const std::string& place);

  private:
    /// Calls store(element, component, value) with the component type's own values: the base, then what is sparse.
    template <class Store>
    void for_each_value(int accessor, const Store& store);
    std::vector<std::uint32_t> read_sparse_indices(int accessor, const nlohmann::json& sparse, std::size_t limit);

    const GltfSource& source_;
    std::uint64_t bytes_left_ = decoded_bytes_base;
};

}  // namespace aleph
