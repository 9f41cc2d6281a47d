// The scene antique-room: only its camera moves, it is closed and glossy, and its generator reproduces the files.

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "scenes/antique-room/antique_room.h"
#include "tests/scenes/authored_scenes.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

TEST(AntiqueRoom, ProgramReproducesTheFiles) {
    expect_generated(program_path("make_antique_room"), 1u + 13u);
    expect_same_scene(loaded("antique-room"), make_antique_room("textures/"));
}

TEST(AntiqueRoom, OnlyTheCameraMoves) {
    const Scene& scene = loaded("antique-room");
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 119}));
    EXPECT_FALSE(is_world_animated(scene));
    const ScenePose first = pose(scene, 0.0), last = pose(scene, 119.0 / 30.0);
    EXPECT_GT(glm::distance(first.cameras[0].position, last.cameras[0].position), 1.5);
    for (const Instance& instance : first.instances)
        EXPECT_TRUE(world_of(first, instance.node) == world_of(last, instance.node));
}

TEST(AntiqueRoom, IsClosedSmallAndGlossy) {
    const Scene& scene = loaded("antique-room");
    EXPECT_LT(folder_size(scenes_folder / "antique-room"), 2'000'000u);
    std::size_t pixels = 0, glossy = 0;
    for (const int frame : {0, 40, 80, 119}) {
        const ScenePose now = pose(scene, frame / 30.0);
        for (const Hit& hit : cast(scene, now, make_camera_view(now.cameras.front(), 160, 120)).pixels) {
            ASSERT_NE(hit.instance, no_index) << frame;
            EXPECT_GT(hit.distance, 0.3) << frame;
            const Instance& instance = now.instances[hit.instance];
            const int material = scene.meshes[instance.mesh].material;
            const MaterialValues& values = now.materials[material];
            ++pixels;
            glossy += values.specular > 0.0f && values.roughness >= 0.1f && values.roughness <= 0.3f ? 1 : 0;
        }
    }
    EXPECT_GT(static_cast<double>(glossy) / static_cast<double>(pixels), 0.3);
}

}  // namespace
}  // namespace aleph
