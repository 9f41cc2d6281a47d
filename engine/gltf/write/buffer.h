#pragma once
// The binary chunk of a .glb, with the views and accessors that describe it, and the file that is made of them.

#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace aleph {

using OrderedJson = nlohmann::ordered_json;

/// Bytes of keys and shapes that are made for a file and are not in the scene. A small scene may have long ranges.
inline constexpr std::uint64_t max_made_bytes = std::uint64_t{64} << 20;

class GlbBuffer {
  public:
    enum class Target { none = 0, vertices = 34962, triangles = 34963 };

    /// @param file  what errors name
    explicit GlbBuffer(std::string file) : file_(std::move(file)) {}

    // Each returns the index of a new accessor, or of an equal one in the case of times.
    /// @param type  of the elements: "SCALAR", "VEC3", ...
    int add_floats(std::span<const float> values, const char* type, Target target = Target::none,
                   bool with_bounds = false);
    int add_times(const std::vector<float>& seconds);
    int add_indices(std::span<const std::uint32_t> indices, std::size_t vertices);
    int add_bytes(std::span<const std::uint8_t> values);
    int add_shorts(std::span<const std::uint16_t> values, const char* type, Target target);
    /// Elements that are all zero take no bytes.
    int add_zeros(std::size_t count, const char* type, bool with_bounds = false);

    /// The index of a new view of these bytes.
    int add_view(const void* data, std::size_t size, Target target = Target::none);

    /// Called before keys or shapes are made that the scene does not hold.
    /// @throws InputError beyond max_made_bytes
    void charge(std::uint64_t bytes, const std::string& place);

    /// The whole file. Leaves this empty.
    /// @param document  without buffers, views and accessors
    std::string take_file(OrderedJson document);

  private:
    int add_accessor(int view, int component_type, std::size_t count, const char* type);

    std::string file_;
    std::string bytes_;
    OrderedJson views_ = OrderedJson::array(), accessors_ = OrderedJson::array();
    std::map<std::vector<float>, int> times_;
    std::uint64_t made_bytes_ = 0;
};

/// Components of an accessor's elements: 3 for "VEC3".
std::size_t component_count(std::string_view type);

}  // namespace aleph
