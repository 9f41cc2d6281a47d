#pragma once
// Numbers of a scene that are given like settings: exposure and the viewing conditions.

#include <string>

#include "engine/scene/scene.h"

namespace aleph {

/// Moves exposure and the viewing conditions (viewing.pixels_per_degree, ...) from the map to the scene: --set and
/// studies take them, but they are no render settings.
/// @param source  where the map comes from, for messages: "--set"
/// @throws InputError for a number that is out of range, and for keys that are unknown settings too
void set_scene_numbers(Scene& scene, SettingMap& settings, const std::string& source);

}  // namespace aleph
