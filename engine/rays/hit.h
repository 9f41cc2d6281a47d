#pragma once
// A ray, and what it hits first. Single precision, in metres relative to the anchor (ray_scene.h).

#include <glm/vec3.hpp>
#include <limits>

#include "engine/base/index.h"

namespace aleph {

struct Ray {
    glm::vec3 origin{0.0f};     ///< m, relative to the anchor
    glm::vec3 direction{0.0f};  ///< need not be unit; distances are in its length
    float near = 0.0f;
    float far = std::numeric_limits<float>::infinity();
    /// [0,1): chooses, for Tracer::intersect with Blend::random, which of the blended surfaces in its way it shows;
    /// below 0: a hash does.
    float choice = -1.0f;
};

/// The first thing that a ray hits. instance is an index into ScenePose::instances, primitive a triangle of its mesh;
/// the point is (1 - u - v) p0 + u p1 + v p2.
struct Hit {
    int instance = no_index;  ///< no_index: nothing
    int primitive = no_index;
    float u = 0.0f, v = 0.0f;
    float distance = 0.0f;  ///< in lengths of the ray's direction

    bool operator==(const Hit&) const = default;
};

}  // namespace aleph
