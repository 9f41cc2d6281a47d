#pragma once
// Our keyframed scene file: JSON text to Scene and back. Form and meaning of every key: scenes/scene.schema.json.
// engine/load/load_scene.h is the door for files; this reads no other file, so pictures and includes are only named.

#include <string>
#include <string_view>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Limits of a file, so that a small text cannot ask for all memory.
inline constexpr std::size_t max_scene_nodes = 1000000;
inline constexpr std::size_t max_scene_cages = 4096;

/// A scene without the content of its pictures and includes, and where the text names them.
struct SceneText {
    Scene scene;
    std::vector<std::string> image_places;    ///< JSON pointer per scene.images
    std::vector<std::string> include_places;  ///< JSON pointer per scene.includes
};

/// Nodes without a name get one ("node 3"), so that every node can be named; meshes, materials, lights and cameras that
/// stand in a node take the node's name. Scene::file stays empty.
/// @param file  what errors name
/// @throws InputError with a JSON pointer, or line and column for text that is not JSON
SceneText read_scene_text(std::string_view text, const std::string& file, const LoadLimits& limits = {});

/// The text that read_scene_text turns into an equal scene: every bit of every track. What includes brought is left
/// out.
/// @throws InputError with the element's place where the format cannot say what the scene holds: morph targets and
/// skins, pictures without a path, names that do not tell elements apart, frames per second that disagree, ...
std::string write_scene_text(const Scene& scene, const std::string& file);

/// The scene's own part: without the elements that includes brought, whose numbers follow its own.
/// @throws InputError where an own element follows or refers to an included one
Scene without_includes(const Scene& scene, const std::string& file);

/// A path that a scene file may name: relative, forward slashes, no scheme, no control characters; ".." is allowed.
/// @return what is wrong with it; empty if nothing is
std::string path_fault(std::string_view path);

}  // namespace aleph
