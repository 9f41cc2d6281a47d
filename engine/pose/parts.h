#pragma once
// The parts of a pose, one by one: pose() makes them all, update_pose() those that can change.

#include <cstddef>

#include "engine/pose/pose.h"

namespace aleph {

glm::dquat rotation_at(const AxisRotation& turn, double seconds);

/// Transform and visibility of a node. Those of its parent must be in `posed` already.
void place_node(const Scene& scene, int node, double seconds, ScenePose& posed);

/// Every node's transform and visibility, and nothing else.
ScenePose place_nodes(const Scene& scene, double seconds);

/// no_index: the scene has no such camera. @param camera  index into ScenePose::cameras
int find_camera_node(const Scene& scene, int camera);

/// True where the instance's node is visible and its mesh present, at posed.seconds.
bool is_shown(const Scene& scene, const ScenePose& posed, std::size_t instance);

/// Whatever the sampling of its track.
bool is_always_present(const Mesh& mesh);

MaterialValues pose_material(const Material& material, double seconds);
LightValues pose_light(const Scene& scene, int node, const glm::dmat4& world, double seconds);
CameraValues pose_camera(const Scene& scene, int node, const glm::dmat4& world, double seconds);
void pose_environment(const Environment& environment, double seconds, ScenePose& posed);

}  // namespace aleph
