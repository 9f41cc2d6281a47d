#pragma once
// Textures drawn by the scene generators.

#include <filesystem>
#include <glm/gtc/type_precision.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/scene/scene.h"

namespace aleph {

/// An 8-bit sRGB picture.
struct DrawnTexture {
    std::string name;  ///< without folder and extension
    Image<glm::u8vec3> srgb;
};

std::vector<DrawnTexture> join(const std::vector<std::vector<DrawnTexture>>& lists);

/// Writes one PNG per texture. The folder must exist.
void write_textures(const std::filesystem::path& folder, const std::vector<DrawnTexture>& textures);

/// @param folder  relative to the scene file: "textures/"
void add_images(Scene& scene, const std::string& folder, const std::vector<DrawnTexture>& textures);

}  // namespace aleph
