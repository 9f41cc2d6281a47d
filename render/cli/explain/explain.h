#pragma once
// The description of a scene by `aleph explain`: as JSON, and as text made from that JSON. Metres, seconds, degrees.

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "engine/base/bounds.h"
#include "engine/pose/pose.h"
#include "engine/scene/scene.h"
#include "render/frame/sequence.h"
#include "render/surface/node_paths.h"

namespace aleph {

/// Frames whose plan stands for the shot: all of a short one, else the first, the last, some between, and those that
/// begin shots.
std::vector<int> choose_planned_frames(const Scene& scene);

/// Frames, camera, exposure, environment, counts, bounds, objects, time samplings, materials, images, unused elements,
/// warnings.
/// @param camera  name, or empty for the scene's own choice
/// @param frames  of which the effects plan is made
nlohmann::ordered_json explain_scene(const Scene& scene, const RenderSettings& settings, const std::string& camera,
                                     const std::vector<int>& frames);

/// For each object path at one time: `world` (16 numbers, row by row, v' = M v), `visible`, `bounds` of its own meshes
/// in the world (null without meshes) and, for meshes, `points`: their count and the first six in object space.
nlohmann::ordered_json explain_moment(const Scene& scene, double seconds);

/// @param frames  of which the plan is
std::string plan_text(const nlohmann::ordered_json& plan, const nlohmann::ordered_json& frames);

/// @param max_objects  number of objects listed; 0: all
std::string explain_text(const nlohmann::ordered_json& explained, std::size_t max_objects);

nlohmann::ordered_json to_json(const glm::dvec3& v);
/// null where empty
nlohmann::ordered_json to_json(const Bounds& bounds);

/// Adds the vertices of an instance, shown or hidden, at the time of the pose.
void add_instance(Bounds& bounds, const Scene& scene, const ScenePose& posed_scene, const Instance& instance);

/// The point cache of a mesh or of its cage; no_index if there is none.
int point_cache_of(const Scene& scene, const Mesh& mesh);

/// Names what deforms a mesh; null if nothing does.
const char* how_it_deforms(const Scene& scene, const Mesh& mesh);

nlohmann::ordered_json describe_node(const Scene& scene, std::size_t index, const NodePaths& paths);
nlohmann::ordered_json describe_materials(const Scene& scene);
nlohmann::ordered_json describe_images(const Scene& scene);

/// Radiance (or factor on the picture) at the first key, picture and its size, whether the picture turns; null for a
/// scene without an environment.
nlohmann::ordered_json describe_environment(const Scene& scene);

}  // namespace aleph
