// Generators reproduce their files; contents and motion of the scenes pool, pool-still, cornell and room.

#include "scenes/antique-room/antique_room.h"
#include "scenes/art-gallery/gallery.h"
#include "scenes/pool/pool_scene.h"
#include "tests/scenes/authored_scenes.h"
#include "tests/support/first_hits.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

int find_ball(const Scene& scene, int number) {
    return find_node(scene, fmt::format("ball_{:02}", number));
}

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

TEST(GeneratedScenes, AreSmall) {
    EXPECT_LT(folder_size(scenes_folder / "pool"), 2'500'000u);
    EXPECT_LT(folder_size(scenes_folder / "art-gallery"), 3'500'000u);
    EXPECT_LT(folder_size(scenes_folder / "antique-room"), 2'000'000u);
    EXPECT_LT(std::filesystem::file_size(scenes_folder / "pool/scene.json"), 1'500'000u);
    EXPECT_LT(std::filesystem::file_size(scenes_folder / "art-gallery/scene.json"), 1'000'000u);
}

TEST(PoolScene, SixteenBallsOverNinetyFrames) {
    const Scene& scene = loaded("pool");
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 89}));
    const PoolSettings settings;
    const ScenePose first = pose(scene, 0.0), last = pose(scene, scene.film.frame_rate.seconds_of(89));
    for (int i = 0; i < 16; ++i) {
        const int node = find_ball(scene, i);
        EXPECT_GT(glm::distance(origin_of(first, node), origin_of(last, node)), settings.radius) << i;
        EXPECT_NEAR(origin_of(last, node).y, cloth_height + settings.radius, 1e-6) << i;
    }
}

TEST(PoolScene, FramesShowTheSimulationsOwnStates) {
    // Keys at 120 Hz, the strike on frame 5: every frame is on a key, rounded to a micrometre.
    const Scene& scene = loaded("pool");
    const PoolSettings settings;
    const PoolRun run = simulate_pool(make_rack(settings), settings, 3.0, 120.0);
    const int node = find_node(scene, "ball_15");
    for (const int frame : {5, 12, 30, 89}) {
        const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
        const PoolBall& ball = run.samples[(frame - 5) * 4][15];
        EXPECT_LT(glm::distance(origin_of(now, node), ball.position + glm::dvec3(0.0, cloth_height, 0.0)), 1e-6);
        const glm::dvec3 mark = glm::dmat3(now.world[node]) * glm::dvec3(1.0, 0.0, 0.0);
        EXPECT_LT(glm::distance(mark, ball.orientation * glm::dvec3(1.0, 0.0, 0.0)), 5e-6);
    }
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

TEST(PoolScene, StillCameraMovesNothingButTheGame) {
    const Scene& scene = loaded("pool-still");
    EXPECT_EQ(background_motion(scene, 40)[0], 0.0);
    const SeenMotion motion = compute_motion(scene, 16, 320, 240);
    double fastest = 0.0;
    for (const glm::dvec2& d : motion.motion.displacement.pixels) fastest = std::max(fastest, glm::length(d));
    EXPECT_GT(fastest, 5.0);
    EXPECT_EQ(scene.meshes, loaded("pool").meshes);
    ASSERT_EQ(scene.images.size(), loaded("pool").images.size());
    for (std::size_t i = 0; i < scene.images.size(); ++i)
        EXPECT_EQ(scene.images[i].bytes, loaded("pool").images[i].bytes);
}

TEST(PoolScene, BallsFillThePictureOfAClosedRoom) {
    const Scene& scene = loaded("pool");
    for (const int frame : {0, 12, 20, 40, 89}) {
        const SeenMotion motion = compute_motion(scene, frame, 320, 240);
        std::set<int> seen;
        for (const Hit& hit : motion.hits.pixels) {
            ASSERT_NE(hit.instance, no_index) << frame;
            const int node = motion.now.pose.instances[hit.instance].node;
            if (is_below(scene, node, "balls")) seen.insert(node);
        }
        EXPECT_GE(seen.size(), 10u) << frame;
    }
}

/// The number of balls that are completely inside the picture (aspect ratio 4 : 3).
int whole_balls(const Scene& scene, int frame) {
    const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
    const CameraView view = make_camera_view(now.cameras.front(), 640, 480);
    int count = 0;
    for (int i = 0; i < 16; ++i) {
        const int node = find_ball(scene, i);
        const glm::dvec3 seen = to_camera(view, origin_of(now, node));
        const glm::dvec2 at = project_camera_point(view, seen);
        const double radius = view.pixels_per_unit * PoolSettings{}.radius / -seen.z;
        if (-seen.z > 0.1 && at.x > radius && at.x < 640 - radius && at.y > radius && at.y < 480 - radius) ++count;
    }
    return count;
}

TEST(PoolScene, TheBreakStaysInThePicture) {
    for (int frame = 0; frame <= 60; ++frame) EXPECT_EQ(whole_balls(loaded("pool"), frame), 16) << frame;
    for (int frame = 61; frame <= 89; ++frame) EXPECT_GE(whole_balls(loaded("pool"), frame), 13) << frame;
    for (int frame = 0; frame <= 89; ++frame) EXPECT_GE(whole_balls(loaded("pool-still"), frame), 14) << frame;
}

TEST(PoolScene, CameraMovesSmoothly) {
    // From frame to frame, the speeds of position and view direction change by less than a tenth of their maximum.
    const Scene& scene = loaded("pool");
    std::vector<glm::dvec3> places, gazes;
    for (int frame = 0; frame <= 89; ++frame) {
        const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
        const CameraView view = make_camera_view(now.cameras.front(), 640, 480);
        places.push_back(view.position);
        gazes.push_back(view.axes[2]);
    }
    for (const auto& values : {places, gazes}) {
        double fastest = 0.0, jolt = 0.0;
        for (std::size_t i = 1; i + 1 < values.size(); ++i) {
            fastest = std::max(fastest, glm::distance(values[i + 1], values[i]));
            jolt = std::max(jolt, glm::length(values[i + 1] - 2.0 * values[i] + values[i - 1]));
        }
        EXPECT_GT(fastest, 1e-3);
        EXPECT_LT(jolt, 0.1 * fastest);
    }
}

TEST(PoolScene, CueIsGoneOnceTheBallsSpread) {
    for (const char* name : {"pool", "pool-still"}) {
        const Scene& scene = loaded(name);
        for (const int frame : {0, 12, 45, 60, 89}) {
            const SeenMotion motion = compute_motion(scene, frame, 320, 240);
            int pixels = 0;
            for (const Hit& hit : motion.hits.pixels)
                if (is_below(scene, motion.now.pose.instances[hit.instance].node, "cue")) ++pixels;
            EXPECT_EQ(pixels > 20, frame < 30) << name << " " << frame;
            EXPECT_EQ(pixels == 0, frame >= 30) << name << " " << frame;
        }
    }
}

TEST(PoolScene, CueTouchesOnlyTheCueBall) {
    const Scene& scene = loaded("pool");
    const PoolSettings settings;
    const int cue = find_node(scene, "cue");
    double nearest_to_cue_ball = 1.0;
    for (int i = 0; i <= 89 * 4; ++i) {
        const ScenePose now = pose(scene, i / 120.0);
        const glm::dmat4& world = now.world[cue];
        const glm::dvec3 tip = world[3], along = world[1];
        for (int ball = 0; ball < 16; ++ball) {
            const int node = find_ball(scene, ball);
            const glm::dvec3 center = origin_of(now, node);
            const double place = glm::clamp(glm::dot(center - tip, along), 0.0, 1.455);
            const double gap = glm::distance(center, tip + place * along) - settings.radius;
            if (ball == cue_ball) {
                nearest_to_cue_ball = std::min(nearest_to_cue_ball, gap);
            } else {
                EXPECT_GT(gap, 0.0125) << "ball " << ball << " at " << i / 120.0;
            }
        }
    }
    EXPECT_NEAR(nearest_to_cue_ball, 0.0, 1e-5);
}

TEST(CornellScene, LoadsAndMoves) {
    const Scene& scene = loaded("cornell");
    EXPECT_TRUE(scene.source.warnings.empty());
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 59}));
    const int sphere = find_node(scene, "sphere"), block = find_node(scene, "tall_block");
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

TEST(CornellScene, BoxFacesInwardsAndFillsThePicture) {
    const Scene& scene = loaded("cornell");
    const ScenePose now = pose(scene, 0.0);
    const CameraView view = make_camera_view(now.cameras.front(), 160, 120);
    std::set<std::string> seen;
    for (const Hit& hit : cast_first_hits(scene, {now, view}).pixels)
        if (hit.instance != no_index) seen.insert(scene.nodes[now.instances[hit.instance].node].name);
    EXPECT_EQ(seen.size(), 9u);  // all nodes except the camera
    for (const char* name : {"floor", "ceiling", "back_wall", "left_wall", "right_wall", "lamp"}) {
        // The front of the quad faces the middle of the box.
        const glm::dmat4& world = now.world[find_node(scene, name)];
        EXPECT_GT(glm::dot(glm::dvec3(world[2]), glm::dvec3(0.0, 2.75, 0.0) - glm::dvec3(world[3])), 2.7) << name;
    }
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
