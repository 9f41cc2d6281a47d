#pragma once
// Rays for the tests, and scenes of rays with a device of their own.

#include <cstdint>
#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "engine/pose/plan.h"
#include "engine/rays/state.h"

namespace aleph {

/// A ray straight down z at (x, y), from z = 5.
inline Ray ray_down(float x, float y) {
    Ray ray;
    ray.origin = {x, y, 5.0f};
    ray.direction = {0.0f, 0.0f, -1.0f};
    return ray;
}

/// Rays from one origin through random points of a square of the plane z = 0.
inline std::vector<Ray> rays_through_square(std::size_t count, const glm::vec3& origin, float half_size,
                                            std::uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<float> inside(-half_size, half_size);
    std::vector<Ray> rays(count);
    for (Ray& ray : rays) {
        const float x = inside(random), y = inside(random);
        ray.origin = origin;
        ray.direction = glm::vec3(x, y, 0.0f) - origin;
    }
    return rays;
}

/// @param flatten  instances that never move share one tree
inline RayScene make_ray_scene(const Scene& scene, std::unique_ptr<EmbreeDevice> device, bool flatten = true) {
    return RayScene(std::make_unique<RayScene::State>(
        std::make_shared<MeshStructures>(scene, make_pose_plan(scene), std::move(device), flatten)));
}

}  // namespace aleph
