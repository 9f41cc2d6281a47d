#pragma once
// The door to scenes in files. Picks the reader by the file's ending; every reader fills the same Scene.

#include <filesystem>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Reads a keyframed scene file (.json), a .gltf or .glb, or an .abc, includes and images with it. An .abc by itself
/// brings its frame rate and range; included, the scene file's count.
/// A glTF or Alembic archive without a camera gets one that frames its bounds over the whole range; a scene without
/// light gets a constant white environment; both are said in Scene::warnings.
/// @throws InputError with file, place and reason; nothing is half loaded
Scene load_scene(const std::filesystem::path& path, const LoadLimits& limits = {});

/// Writes a keyframed scene file; load_scene gives back an equal scene, apart from `file` and `warnings` (of a light or
/// a camera that was added to the first, say: the file holds them). Includes stay includes. In another folder than that
/// of Scene::file the paths of includes and images change accordingly. The file appears whole or not at all.
/// @throws InputError where the scene holds what the file format cannot say, OutputError if writing fails
void save_scene(const Scene& scene, const std::filesystem::path& path);

}  // namespace aleph
