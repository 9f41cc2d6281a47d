#pragma once
// Where nodes of a scene are and where they look.

#include "engine/pose/pose.h"
#include "tests/support/test.h"

namespace aleph {

/// The time of a frame, which may lie between two.
inline double frame_seconds(const Scene& scene, double frame) {
    return frame / scene.film.frame_rate.per_second();
}

inline glm::dmat4 world_at(const Scene& scene, const std::string& name, double seconds) {
    return pose(scene, seconds).world[find_named(scene.nodes, name)];
}

/// Unit, along the node's -z.
inline glm::dvec3 view_of(const glm::dmat4& world) {
    return -glm::normalize(glm::dvec3(world[2]));
}

inline glm::dvec3 view_at(const Scene& scene, const std::string& name, double frame) {
    return view_of(world_at(scene, name, frame_seconds(scene, frame)));
}

/// The angle between the node's -z and the way to the target, rad.
inline double miss_angle(const Scene& scene, const std::string& name, const std::string& target, double seconds) {
    const ScenePose posed = pose(scene, seconds);
    const glm::dmat4& eye = posed.world[find_named(scene.nodes, name)];
    const glm::dvec3 way = glm::normalize(glm::dvec3(posed.world[find_named(scene.nodes, target)][3] - eye[3]));
    return 2.0 * std::asin(std::min(1.0, 0.5 * glm::length(way - view_of(eye))));
}

}  // namespace aleph
