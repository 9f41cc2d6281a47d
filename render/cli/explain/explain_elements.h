#pragma once
// Parts of `aleph explain`: single nodes, materials and images as JSON.

#include <nlohmann/json.hpp>

#include "engine/base/bounds.h"
#include "engine/pose/pose.h"
#include "render/surface/node_paths.h"

namespace aleph {

nlohmann::ordered_json to_json(const glm::dvec3& v);
/// null where empty
nlohmann::ordered_json to_json(const Bounds& bounds);

/// Adds the vertices of an instance, shown or hidden, at the time of the pose.
void add_instance(Bounds& bounds, const Scene& scene, const ScenePose& posed_scene, const Instance& instance);

/// Names what deforms a mesh; null if nothing does.
const char* how_it_deforms(const Scene& scene, const Mesh& mesh);

/// Returns whether a mesh of the node has a material that gives light at some time.
bool is_area_light(const Scene& scene, const Node& node);

nlohmann::ordered_json describe_node(const Scene& scene, std::size_t index, const NodePaths& paths);
nlohmann::ordered_json describe_materials(const Scene& scene);
nlohmann::ordered_json describe_images(const Scene& scene);

/// Radiance (or factor on the picture) at the first key, picture and its size, whether the picture turns; null for a
/// scene without an environment.
nlohmann::ordered_json describe_environment(const Scene& scene);

}  // namespace aleph
