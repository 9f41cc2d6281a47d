#pragma once
// Meshes whose surface cannot see itself.

#include <glm/vec3.hpp>

#include "engine/scene/mesh.h"

namespace aleph {

struct ConvexMesh {
    bool convex = false;                 ///< closed, or flat, and all of it lies on one side of each of its triangles
    bool flat = false;                   ///< in one plane
    glm::dvec3 point{0.0}, normal{0.0};  ///< of that plane, object space; the normal is unit
};

/// Meshes of more than 200,000 triangles are not looked at, and count as not convex.
ConvexMesh find_convex(const Mesh& mesh);

}  // namespace aleph
