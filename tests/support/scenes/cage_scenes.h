#pragma once
// Scenes around one cage, for the tests of its level and motion.

#include <utility>
#include <vector>

#include "engine/surface/limit_surface.h"
#include "tests/support/scenes/subdivision_cages.h"

namespace aleph {

/// Cage 0 with its points as they are at frames 0, 1, ..., tessellated at `level`, under node 0; a camera at the origin
/// of node 1. 30 frames per second.
inline Scene make_cage_scene(TestCage test, const std::vector<std::vector<glm::dvec3>>& points_by_frame, int level) {
    Scene scene;
    PointCache cache;
    cache.sampling.period = 1.0 / 30.0;
    for (const auto& points : points_by_frame) cache.positions.emplace_back(points.begin(), points.end());
    scene.point_caches.push_back(std::move(cache));
    test.cage.points = 0;
    test.cage.level = level;
    scene.cages.push_back(std::move(test.cage));
    Mesh mesh;
    mesh.name = "surface";
    mesh.subdivision.cage = 0;
    scene.meshes.push_back(std::move(mesh));
    Node object{.meshes = {0}};
    Node camera{.camera = 0};
    scene.nodes = {object, camera};
    scene.cameras.resize(1);
    scene.cameras[0].name = "camera";
    tessellate_cage(scene, 0);
    return scene;
}

/// The points as floats hold them.
inline std::vector<glm::dvec3> round_to_float(const std::vector<glm::dvec3>& points) {
    std::vector<glm::dvec3> rounded;
    for (const glm::dvec3& p : points) rounded.emplace_back(glm::vec3(p));
    return rounded;
}

}  // namespace aleph
