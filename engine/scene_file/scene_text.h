#pragma once
// The text of a keyframed scene file (JSON) to Scene and back. Every key is described in scenes/scene.schema.json.
// No other file is read: images and includes have paths only. To load files: engine/load/load_scene.h.

#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"

namespace aleph {

// Limits of a file: a small text must not take all memory.
inline constexpr std::size_t max_scene_nodes = 1000000;
inline constexpr std::size_t max_scene_cages = 4096;

/// A scene without the content of its images and includes, and the places of their paths in the text.
struct SceneText {
    Scene scene;
    std::vector<std::string> image_places;    ///< JSON pointer per scene.images
    std::vector<std::string> include_places;  ///< JSON pointer per scene.source.includes
};

/// A node without the key "name" is called "node 3". Meshes, materials, lights and cameras that are defined in a node
/// get the node's name. SceneSource::file stays empty.
/// @param file  its name in errors
/// @throws InputError with a JSON pointer, or line and column for text that is not JSON
SceneText read_scene_text(std::string_view text, const std::string& file, const LoadLimits& limits = {});

/// The text from which read_scene_text makes an equal scene: every bit of every track. Elements of includes are left
/// out.
/// @throws InputError with the element's place if it refers to one of an include, or the format cannot hold it: morph
/// targets, skins, images without a path, two elements of one name, ...
std::string write_scene_text(const Scene& scene, const std::string& file);

/// The scene without the elements of includes. In each list these come after the scene's own elements.
/// @throws InputError if an own element comes after an included one
Scene without_includes(const Scene& scene, const std::string& file);

/// Checks a path in a scene file: relative, forward slashes, no scheme, no control characters; ".." is allowed.
/// @return the fault; empty if there is none
std::string path_fault(std::string_view path);

}  // namespace aleph
