#pragma once
// What the programs have in common that write scenes into a folder: the same bytes every time.

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "scenes/common/textures.h"

namespace aleph {

/// A scene of 30 frames a second from frame 0 on, seen by its node "camera", with its images.
/// @param exposure  factor on radiance
/// @param folder  of the textures, as the scene file is to name it
Scene begin_scene(const std::string& name, int last_frame, double exposure, const std::string& folder,
                  const std::vector<DrawnTexture>& textures);

/// Writes scene.json, and what textures there are as textures/NAME.png, into a folder that need not exist.
void write_scene(const std::filesystem::path& folder, const Scene& scene, const std::vector<DrawnTexture>& textures);

/// A program that takes the folder to write into as its only argument.
/// @param name  of the program
/// @param writes  what it writes there, for people
/// @return exit code: 0, 1 for an error, 2 for wrong use
int run_generator(int argc, char** argv, const char* name, const char* writes,
                  const std::function<void(const std::filesystem::path&)>& write);

}  // namespace aleph
