#pragma once
// The origin of results, to recognise those that another run left.

#include <string>
#include <vector>

#include "engine/pose/pose.h"
#include "render/settings/settings.h"

namespace aleph {

/// The EXR attribute, or the text of a PNG file, with the fingerprint of a frame.
inline constexpr const char* fingerprint_key = "aleph:fingerprint";

/// The version and the SHA-1 of the file that holds this code: the program, or the Python module.
/// @throws InputError if the file cannot be read
const std::string& program_build();

/// Everything that the light of a scene depends on.
struct Fingerprint {
    std::string build;    ///< program_build
    std::string scene;    ///< hash_scene, and the cameras
    SettingMap settings;  ///< all of them
};

/// @param shots  list_camera_shots
Fingerprint make_fingerprint(const Scene& scene, const RenderSettings& settings, const std::vector<CameraShot>& shots);

/// JSON in one line: {"build": ..., "scene": ..., "settings": {KEY: TEXT, ...}}.
std::string format_fingerprint(const Fingerprint& fingerprint);

}  // namespace aleph
