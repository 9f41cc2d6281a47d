#pragma once
// The common part of what writes scenes. Their files are deterministic.

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

/// A scene with 30 frames per second from frame 0 on, rendered with its node "camera", with its images.
/// @param exposure  factor on radiance
/// @param folder  of the textures, relative to the scene file
Scene begin_scene(const std::string& name, int last_frame, double exposure, const std::string& folder,
                  const std::vector<DrawnTexture>& textures);

/// Writes scene.json and the textures (textures/NAME.png) into a folder; creates the folder if needed.
void write_scene(const std::filesystem::path& folder, const Scene& scene, const std::vector<DrawnTexture>& textures);

}  // namespace aleph
