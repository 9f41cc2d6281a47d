#pragma once
// Values of glTF accessors: any component type, normalized or not, packed, interleaved or sparse.

#include <cstdint>
#include <vector>

#include "engine/gltf/source.h"

namespace aleph {

/// Vertices, indices and keys of a file may decode to decoded_bytes_base bytes, and decoded_bytes_per_buffer_byte more
/// for each byte of its buffers. Without a limit a small file that refers to the same data a million times would take
/// all memory.
inline constexpr std::uint64_t decoded_bytes_base = std::uint64_t{256} << 20;
inline constexpr std::uint64_t decoded_bytes_per_buffer_byte = 8;

class GltfAccessors {
  public:
    /// @param source  validated; must outlive this
    explicit GltfAccessors(const GltfSource& source);

    /// All components in order. Normalized integers become -1 (or 0) to 1, floats convert exactly.
    /// Instantiated for float and double.
    /// @throws InputError where a value is not finite or beyond +-max_value
    template <class T>
    std::vector<T> read(int accessor, double max_value = max_json_number);

    /// @param kind  what the indices count, for the message
    /// @throws InputError where an index is not below `limit`
    std::vector<std::uint32_t> read_indices(int accessor, std::size_t limit, const char* kind = "vertex");

    std::size_t count(int accessor) const { return source_.model.accessors[accessor].count; }
    std::size_t components(int accessor) const;  ///< 3 for VEC3
    bool is_float(int accessor) const {
        return source_.model.accessors[accessor].componentType == TINYGLTF_COMPONENT_TYPE_FLOAT;
    }

    /// Counts memory before it is taken. Call it wherever data that was read is copied.
    /// @throws InputError beyond the file's allowance
    void charge(std::uint64_t bytes, const std::string& place);

  private:
    /// Calls store(element, component, value) with values of the component type: first the base values, then the sparse
    /// ones that replace some of them.
    template <class Store>
    void for_each_value(int accessor, const Store& store);
    std::vector<std::uint32_t> read_sparse_indices(int accessor, const nlohmann::json& sparse, std::size_t limit);

    const GltfSource& source_;
    std::uint64_t bytes_left_ = decoded_bytes_base;
};

}  // namespace aleph
