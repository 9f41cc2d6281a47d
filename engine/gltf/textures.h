#pragma once
// glTF reader: the textures of materials, and the images that they use.

#include <cstdint>
#include <vector>

#include "engine/gltf/reader.h"

namespace aleph {

/// Reads textures. Only images that a texture uses are decoded, each once.
class GltfTextures {
  public:
    explicit GltfTextures(GltfReader& reader);

    /// The texture of a texture info; none where the owner has no such key.
    /// @param owner  a material, or an extension of one
    TextureRef read(const nlohmann::json& owner, const char* key);

  private:
    TextureRef read(int index, int uv_set);

    GltfReader& reader_;
    std::vector<int> image_of_;  ///< glTF image -> scene image, no_index until needed
    std::uint64_t pixel_bytes_ = 0;
};

}  // namespace aleph
