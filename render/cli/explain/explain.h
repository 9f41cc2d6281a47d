#pragma once
// The description of a scene by `aleph explain`: as JSON, and as text made from that JSON. Metres, seconds, degrees.

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/json/load_limits.h"
#include "engine/scene/scene.h"
#include "render/frame/sequence.h"

namespace aleph {

/// The keyed properties of a node and its meshes, of a material, a light, a camera or the environment: name as in scene
/// files, kind of sampling, number of keys, first and last time, interpolation, and `constant` if all keys are equal.
nlohmann::ordered_json list_tracks(const Scene& scene, const Node& node);
nlohmann::ordered_json list_tracks(const Material& material);
nlohmann::ordered_json list_tracks(const Light& light);
nlohmann::ordered_json list_tracks(const Camera& camera);
nlohmann::ordered_json list_environment_tracks(const Scene& scene);

/// Frames whose plan stands for the shot: all of a short one, else the first, the last, some between, and those that
/// begin shots.
std::vector<int> choose_planned_frames(const Scene& scene);

/// The effects plan of these frames, in ascending order: for each effect, frames one after the other with the same
/// decision, with the largest bound and its reason.
nlohmann::ordered_json explain_plan(Sequence& sequence, const std::vector<int>& frames);

/// @param plan    explain_plan
/// @param frames  of which it is
std::string plan_text(const nlohmann::ordered_json& plan, const nlohmann::ordered_json& frames);

/// Frames, camera, exposure, environment, counts, bounds, objects, time samplings, materials, images, unused elements,
/// warnings.
/// @param camera  name, or empty for the scene's own choice
/// @param frames  of which the effects plan is made
nlohmann::ordered_json explain_scene(const Scene& scene, const RenderSettings& settings, const std::string& camera,
                                     const std::vector<int>& frames);

/// For each object path at one time: `world` (16 numbers, row by row, v' = M v), `visible`, `bounds` of its own meshes
/// in the world (null without meshes) and, for meshes, `points`: their count and the first six in object space.
nlohmann::ordered_json explain_moment(const Scene& scene, double seconds);

/// @param max_objects  number of objects listed; 0: all
std::string explain_text(const nlohmann::ordered_json& explained, std::size_t max_objects);

}  // namespace aleph
