#pragma once
// Pictures that programs draw for their scenes.

#include <filesystem>
#include <glm/gtc/type_precision.hpp>
#include <string>
#include <vector>

#include "engine/base/image.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Eight-bit sRGB.
struct DrawnTexture {
    std::string name;  ///< without folder and ending
    Image<glm::u8vec3> srgb;
};

std::vector<DrawnTexture> join(const std::vector<std::vector<DrawnTexture>>& lists);

/// One PNG each, the same bytes every time. The folder has to exist.
void write_textures(const std::filesystem::path& folder, const std::vector<DrawnTexture>& textures);

/// @param folder  as the scene file is to name it, "textures/"
void add_images(Scene& scene, const std::string& folder, const std::vector<DrawnTexture>& textures);

}  // namespace aleph
