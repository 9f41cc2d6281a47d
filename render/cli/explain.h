#pragma once
// What `aleph explain` tells of a scene, as JSON; explain_text turns it into what people read. Metres, seconds,
// degrees.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"
#include "render/settings.h"

namespace aleph {

/// "/group/child" per node: names from the root down. Nodes that would share a path get "#2", "#3", ... in node order.
std::vector<std::string> node_paths(const Scene& scene);

/// Every keyed property of a node with what hangs on it, of a material, a light or a camera: name as in scene files,
/// kind of sampling, keys, first and last time, interpolation, and `constant` where all keys are alike.
nlohmann::ordered_json list_tracks(const Scene& scene, const Node& node);
nlohmann::ordered_json list_tracks(const Material& material);
nlohmann::ordered_json list_tracks(const Light& light);
nlohmann::ordered_json list_tracks(const Camera& camera);

/// Frames, camera, exposure, counts, bounds, the tree, time samplings, materials, images, what nothing uses, warnings.
/// @param camera  name, or empty for the scene's own choice
nlohmann::ordered_json explain_scene(const Scene& scene, const RenderSettings& settings, const std::string& camera);

/// Per object path at a time: `world` (16 numbers, row by row, v' = M v), `visible`, `bounds` of its own meshes in the
/// world (null without any) and, for meshes, `points`: how many and the first six in object space.
nlohmann::ordered_json explain_moment(const Scene& scene, double seconds);

/// @param most_objects  lines of the tree; 0: all
std::string explain_text(const nlohmann::ordered_json& explained, std::size_t most_objects);

/// A file that a scene file or glTF names and that is not there.
struct MissingFile {
    std::string file;   ///< that names it
    std::string place;  ///< in that file
    std::string path;   ///< as it is named
};

/// Looks through a scene file or glTF, and through the glTF files it includes, for named files that are not there;
/// loading stops at the first. What cannot be read is left out: loading says why.
/// @param limits  those of the loading that failed: a file that is refused for its size is not parsed here either
std::vector<MissingFile> list_missing_files(const std::filesystem::path& path, const LoadLimits& limits = {});

}  // namespace aleph
