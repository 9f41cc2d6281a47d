// Embree refuses an allocation: every step of a RayScene reports it as std::bad_alloc, and none ends the process.

#include <atomic>
#include <new>

#include "engine/rays/state.h"
#include "tests/engine/rays/ray_patterns.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {
namespace {

/// The bytes that Embree may still allocate.
using Budget = std::atomic<std::ptrdiff_t>;

bool spend(void* budget, ssize_t bytes, bool) {
    Budget& left = *static_cast<Budget*>(budget);
    if (bytes <= 0) return true;
    return left.fetch_sub(bytes) >= bytes;
}

RayScene make_rays(const Scene& scene, Budget& budget) {
    auto device = std::make_unique<EmbreeDevice>();
    rtcSetDeviceMemoryMonitorFunction(device->handle(), spend, &budget);
    return make_ray_scene(scene, std::move(device));
}

/// Two sheets: one stands still, one folds.
Scene make_scene() {
    Scene scene = make_sheet_scene(32);
    scene.meshes.push_back(make_sheet(32));
    scene.nodes.emplace_back().meshes = {1};
    scene.nodes.back().transform.translation = glm::dvec3(0.0, 0.0, -1.0);
    add_cache(scene, 1, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, static_cast<float>(sample) * p.x * p.x);
    });
    return scene;
}

TEST(EmbreeMemory, EveryRefusedAllocationIsReported) {
    const Scene scene = make_scene();
    const ScenePose posed = pose(scene, 0.5);
    int refused = 0;
    for (std::ptrdiff_t bytes = 0;; bytes += 4096) {
        Budget budget = bytes;
        try {
            RayScene rays = make_rays(scene, budget);
            rays.update(posed, glm::dvec3(0.0));
            EXPECT_EQ(instance_at(rays, 0.1f, 0.2f), 0);
            break;
        } catch (const std::bad_alloc&) {
            ++refused;
        }
        ASSERT_LT(bytes, 1 << 26);
    }
    EXPECT_GT(refused, 10);
}

TEST(EmbreeMemory, OtherErrorsAreReportedWithEmbreesText) {
    const EmbreeDevice device;
    rtcCommitScene(nullptr);  // without a handle Embree knows no device to report to
    EXPECT_NO_THROW(device.check());
    const EmbreeScene scene = device.make_scene(RTC_SCENE_FLAG_NONE, RTC_BUILD_QUALITY_MEDIUM);
    rtcDetachGeometry(scene.get(), 7);
    try {
        device.check();
        FAIL();
    } catch (const std::runtime_error& error) {
        EXPECT_NE(std::string(error.what()).find("Embree: "), std::string::npos) << error.what();
    }
    EXPECT_NO_THROW(device.check());  // an error is reported once
}

}  // namespace
}  // namespace aleph
