// Generators reproduce their files; contents and motion of the scenes pool, pool-still, cornell and room.

#include "scenes/antique-room/antique_room.h"
#include "scenes/art-gallery/gallery.h"
#include "scenes/pool/pool_scene.h"
#include "tests/scenes/authored_scenes.h"

namespace aleph {
namespace {

/// Is a node, or one above it, called `name`?
bool is_below(const Scene& scene, int node, const std::string& name) {
    for (; node != no_index; node = scene.nodes[node].parent)
        if (scene.nodes[node].name == name) return true;
    return false;
}

/// Mean displacement in pixels over the pixels of the room, and their share of the picture.
std::array<double, 2> background_motion(const Scene& scene, int frame) {
    const SeenMotion motion = compute_motion(scene, frame, 640, 480);
    double sum = 0.0, count = 0.0;
    for (std::size_t i = 0; i < motion.hits.size(); ++i) {
        const Hit& hit = motion.hits.pixels[i];
        if (hit.instance == no_index) continue;
        if (!is_below(scene, motion.now.pose.instances[hit.instance].node, "room")) continue;
        sum += glm::length(motion.motion.displacement.pixels[i]);
        count += 1.0;
    }
    return {sum / count, count / static_cast<double>(motion.hits.size())};
}

TEST(GeneratedScenes, TheProgramReproducesTheFiles) {
    const std::size_t pool = 2u + 16u + 9u, art_gallery = 1u + 26u, antique_room = 1u + 13u, boomerang = 1u + 4u;
    const std::size_t materials = 3u;
    expect_generated(pool + art_gallery + antique_room + boomerang + materials);
    expect_same_scene(loaded("pool"), make_pool_scene(true, "textures/"));
    expect_same_scene(loaded("art-gallery"), make_art_gallery("textures/"));
    expect_same_scene(loaded("antique-room"), make_antique_room("textures/"));
    EXPECT_TRUE(loaded("boomerang").source.warnings.empty());
}

TEST(PoolScene, BackgroundMovesByThreePixels) {
    for (const int frame : {0, 10, 20, 30, 60, 88}) {
        const auto [pixels, share] = background_motion(loaded("pool"), frame);
        EXPECT_GT(pixels, 2.6) << frame;
        EXPECT_LT(pixels, 3.4) << frame;
        EXPECT_GT(share, 0.2) << frame;
        RecordProperty("pixels_on_frame_" + std::to_string(frame), std::to_string(pixels));
    }
}

TEST(CornellScene, LoadsAndMoves) {
    const Scene& scene = loaded("cornell");
    EXPECT_TRUE(scene.source.warnings.empty());
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 59}));
    const int sphere = find_named(scene.nodes, "sphere"), block = find_named(scene.nodes, "tall_block");
    const double top = 1.65, radius = 0.45;
    // Free fall: y = y0 - g t^2 / 2 up to the first contact on frame 15.
    for (int frame = 0; frame <= 15; ++frame) {
        const double t = frame / 30.0;
        EXPECT_NEAR(origin_of(pose(scene, t), sphere).y, top + radius + 1.22625 - 0.5 * 9.81 * t * t, 1e-12);
    }
    for (int i = 0; i <= 59 * 8; ++i) EXPECT_GE(origin_of(pose(scene, i / 240.0), sphere).y, top + radius - 1e-12) << i;
    EXPECT_NEAR(origin_of(pose(scene, 39.0 / 30.0), sphere).y, top + radius, 1e-12);
    // 1.5 degrees per frame about y.
    const glm::dvec3 before = pose(scene, 0.0).world[block][0];
    const glm::dvec3 after = pose(scene, 10.0 / 30.0).world[block][0];
    EXPECT_NEAR(glm::dot(before, after), std::cos(15.0 * pi / 180.0), 1e-12);
}

TEST(RoomScene, KeepsTheFilesContent) {
    const Scene& scene = loaded("room");
    std::size_t triangles = 0;
    for (const Mesh& mesh : scene.meshes) triangles += mesh.triangles.size();
    std::size_t with_mesh = 0;
    for (const Node& node : scene.nodes) with_mesh += node.meshes.empty() ? 0 : 1;
    EXPECT_EQ(with_mesh, 58u);
    EXPECT_EQ(triangles, 70'810u);
    EXPECT_EQ(scene.materials.size(), 24u);
    const ScenePose now = pose(scene, 0.0);
    ASSERT_EQ(now.cameras.size(), 1u);
    EXPECT_NEAR(now.cameras[0].fov, pi / 3.0, 1e-9);
    EXPECT_FALSE(is_world_animated(scene));
    const CameraView view = make_camera_view(now.cameras[0], 64, 64);
    for (const Hit& hit : cast_first_hits(scene, {now, view}).pixels) EXPECT_NE(hit.instance, no_index);
}

}  // namespace
}  // namespace aleph
