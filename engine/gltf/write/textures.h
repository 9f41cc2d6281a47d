#pragma once
// glTF writer: textures of materials, their samplers and images.

#include <map>
#include <utility>

#include "engine/gltf/write/writer.h"

namespace aleph {

class TextureWriter {
  public:
    explicit TextureWriter(GltfWriter& writer) : writer_(writer) {}

    /// Writes the texture of a slot, if the material has one.
    /// @param owner  the object that has textures of that kind
    /// @param scale  of a normal map
    void write(OrderedJson& owner, const char* key, const Material& material, TextureSlot slot, double scale = 1.0);

  private:
    int write_image(int image, bool is_color);
    int write_sampler(const TextureRef& texture);
    int write_texture(int image, int sampler);

    GltfWriter& writer_;
    std::map<std::pair<int, bool>, int> images_;  ///< scene image, and whether its floats are encoded as colours
    std::map<OrderedJson, int> samplers_;
    std::map<std::pair<int, int>, int> textures_;
};

}  // namespace aleph
