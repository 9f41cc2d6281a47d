#pragma once
// Rays for the tests, and scenes of rays with a device of their own.

#include "engine/pose/plan.h"
#include "engine/pose/pose.h"
#include "engine/rays/state.h"
#include "tests/support/test.h"

namespace aleph {

/// A ray straight down z at (x, y), from z = 5.
inline Ray ray_down(float x, float y) {
    return {.origin = {x, y, 5.0f}, .direction = {0.0f, 0.0f, -1.0f}};
}

/// The rays of a scene as posed, relative to the origin of the world.
inline RayScene place(const Scene& scene, double seconds = 0.0) {
    RayScene rays(scene);
    rays.update(pose(scene, seconds), glm::dvec3(0.0));
    return rays;
}

/// In packets, or one by one.
inline std::vector<Hit> trace(const RayScene& scene, const std::vector<Ray>& rays, bool in_packets = true,
                              Blend blend = Blend::cutout) {
    std::vector<Hit> hits(rays.size());
    Tracer tracer(scene, blend);
    if (in_packets) {
        tracer.intersect(rays, hits);
    } else {
        std::ranges::transform(rays, hits.begin(), [&](const Ray& ray) { return tracer.intersect(ray); });
    }
    return hits;
}

/// 1 for each ray that meets something.
inline std::vector<std::uint8_t> find_blocked(const RayScene& scene, const std::vector<Ray>& rays,
                                              Blend blend = Blend::cutout) {
    std::vector<std::uint8_t> blocked(rays.size());
    Tracer tracer(scene, blend);
    std::ranges::transform(rays, blocked.begin(), [&](const Ray& ray) { return tracer.occluded(ray); });
    return blocked;
}

/// The instance that a ray meets, which must be the same alone and in packets, and for occlusion.
inline int instance_at(const RayScene& scene, float x, float y) {
    Tracer tracer(scene);
    const std::vector<Ray> rays(17, ray_down(x, y));
    const int alone = tracer.intersect(rays[0]).instance;
    EXPECT_EQ(tracer.occluded(rays[0]), alone != no_index);
    for (const Hit& hit : trace(scene, rays)) EXPECT_EQ(hit.instance, alone);
    return alone;
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
