#pragma once
// Pictures and maps inside the report page: compressed text, as many as fit.

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"

namespace aleph {

enum class LayerType {
    f16,  ///< half precision: what is looked at; above 65504 it is that
    f32,  ///< what is read
};

/// The values of a layer as base64 of a zlib stream: little endian, channel after channel, row 0 on top; the bytes are
/// sorted by significance, the least first, which makes them a quarter to a half shorter.
/// @param channels  of one size
std::string encode_layer(const std::vector<const Image<float>*>& channels, LayerType type);

/// The layers of a page, up to a size.
class ReportLayers {
  public:
    /// @param most_bytes  of all layers together
    explicit ReportLayers(std::size_t most_bytes) : left_(most_bytes) {}

    /// Adds a layer if it fits. @return what the page's data say of it, or null
    nlohmann::ordered_json add(const std::vector<const Image<float>*>& channels, LayerType type);

    std::size_t left_out() const { return left_out_; }
    /// The elements of the page, in the order in which they were added.
    const std::string& elements() const { return elements_; }

  private:
    std::size_t left_, count_ = 0, left_out_ = 0;
    std::string elements_;
};

}  // namespace aleph
