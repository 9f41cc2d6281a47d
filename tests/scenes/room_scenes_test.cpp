// The scenes antique-room and boomerang: only the camera of the one moves, and it is closed and glossy; the other moves
// as its README says.

#include "scenes/boomerang/boomerang_scene.h"
#include "tests/scenes/authored_scenes.h"

namespace aleph {
namespace {

TEST(AntiqueRoom, OnlyTheCameraMoves) {
    const Scene& scene = loaded("antique-room");
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 119}));
    EXPECT_FALSE(is_world_animated(scene));
    const ScenePose first = pose(scene, 0.0), last = pose(scene, 119.0 / 30.0);
    EXPECT_GT(glm::distance(first.cameras[0].position, last.cameras[0].position), 1.5);
    for (const Instance& instance : first.instances)
        EXPECT_TRUE(first.world[instance.node] == last.world[instance.node]);
}

TEST(AntiqueRoom, IsClosedAndGlossy) {
    const Scene& scene = loaded("antique-room");
    std::size_t pixels = 0, glossy = 0;
    for (const int frame : {0, 40, 80, 119}) {
        const ScenePose now = pose(scene, frame / 30.0);
        for (const Hit& hit : cast_first_hits(scene, {now, make_camera_view(now.cameras.front(), 160, 120)}).pixels) {
            ASSERT_NE(hit.instance, no_index) << frame;
            EXPECT_GT(hit.distance, 0.3) << frame;
            const Instance& instance = now.instances[hit.instance];
            const int material = scene.meshes[instance.mesh].material;
            const MaterialValues& values = now.materials[material];
            ++pixels;
            glossy += values.gloss.specular > 0.0f && values.gloss.roughness >= 0.1f && values.gloss.roughness <= 0.3f
                          ? 1
                          : 0;
        }
    }
    EXPECT_GT(static_cast<double>(glossy) / static_cast<double>(pixels), 0.3);
}

struct Moving {
    double boomerang_share = 0.0, fastest = 0.0, background = 0.0;
};

Moving measure(int frame) {
    constexpr int width = 320, height = 240;  // half the size that the README speaks of
    const Scene& scene = loaded("boomerang");
    const auto [now, other, hits, field] = compute_motion(scene, frame, width, height);
    Moving moving;
    int background = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        EXPECT_NE(hits.pixels[i].instance, no_index);  // a closed room
        if (hits.pixels[i].instance == no_index) continue;
        const auto& instance = now.pose.instances[hits.pixels[i].instance];
        const double speed = 2.0 * glm::length(field.displacement.pixels[i]);
        if (scene.nodes[instance.node].name == "boomerang") {
            moving.boomerang_share += 1.0 / static_cast<double>(hits.size());
            moving.fastest = std::max(moving.fastest, speed);
        } else {
            moving.background += speed;
            ++background;
        }
    }
    moving.background /= background;
    return moving;
}

TEST(BoomerangScene, FliesInFrontOfAWallThatHardlyMoves) {
    for (const int frame : {0, 20, 40, 60, 80, 88}) {
        SCOPED_TRACE(frame);
        const Moving moving = measure(frame);
        EXPECT_GT(moving.boomerang_share, 0.008);
        EXPECT_GT(moving.fastest, 10.0);
        EXPECT_LT(moving.fastest, 53.0);  // the reach of image-based motion
        if (frame < boomerang_still_until) {
            EXPECT_EQ(moving.background, 0.0);
        } else {
            EXPECT_GT(moving.background, 0.5);
            EXPECT_LT(moving.background, 2.0);
        }
    }
}

}  // namespace
}  // namespace aleph
