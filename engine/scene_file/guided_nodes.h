#pragma once
// Nodes that look at something or follow a path: "look_at" and "follow_path", which become keys of their rotation and
// translation when all nodes are read.

#include <string>
#include <utility>
#include <vector>

#include "engine/json/json_ref.h"
#include "engine/scene/scene.h"
#include "engine/scene_file/path_curve.h"

namespace aleph {

struct SceneReader;

/// The node's -z points at another node, or at a point of the world.
struct LookAt {
    int node = no_index;
    std::string place;     ///< JSON pointer
    std::string target{};  ///< name of a node; empty: the point
    Track<glm::dvec3> point{glm::dvec3(0.0)};
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< world
};

/// The node moves along a curve in its parent's coordinates.
struct FollowPath {
    int node = no_index;
    std::string place;  ///< JSON pointer
    PathCurve curve;
    bool closed = false;
    Track<double> at;              ///< share of the curve's length
    bool align = false;            ///< -z points along the curve
    glm::dvec3 up{0.0, 1.0, 0.0};  ///< in the parent's coordinates
};

struct GuidedNodes {
    std::vector<LookAt> looks;
    std::vector<FollowPath> paths;
    std::vector<std::pair<int, int>> copies;  ///< nodes made by "instance", and their originals
};

/// Reads the two keys of a node, if it has them.
/// @param node  its index
/// @throws InputError where they exclude each other or another key
void read_guides(SceneReader& reader, const JsonRef& at, int node);

/// Largest angle by which a baked rotation may differ from the exact one between its keys, rad.
inline constexpr double baked_rotation_tolerance = 1e-6;
/// Largest distance of a baked translation from the exact one between its keys, as a share of the path's length.
inline constexpr double baked_path_tolerance = 1e-7;

/// Replaces the rotations and translations of guided nodes by keys: one at every frame of the scene's range (and of one
/// frame or the shutter on both sides) in which what they depend on moves, and between them where the tolerances ask
/// for more. At frames they are exact. Copies of these nodes get the same keys.
/// @throws InputError for cycles, for a node that never has a direction, and for more keys or more work than the limits
void bake_guided_nodes(SceneReader& reader);

}  // namespace aleph
