// The scene art-gallery: its contents, and its balls against the laws of free fall.

#include "scenes/art-gallery/gallery.h"
#include "tests/scenes/authored_scenes.h"

namespace aleph {
namespace {

std::string top_of(const Scene& scene, int node) {
    while (scene.nodes[node].parent != no_index) node = scene.nodes[node].parent;
    return scene.nodes[node].name;
}

int find_ball_node(const Scene& scene, std::size_t number) {
    return find_named(scene.nodes, fmt::format("ball_{}", number));
}

std::size_t count_triangles(const Scene& scene) {
    std::size_t count = 0;
    for (const Mesh& mesh : scene.meshes) count += mesh.triangles.size();
    return count;
}

/// Nodes with an emissive material.
std::set<std::string> find_lamps(const Scene& scene) {
    std::set<std::string> lamps;
    for (const Instance& instance : list_instances(scene)) {
        const int material = scene.meshes[instance.mesh].material;
        if (evaluate(scene.materials[material].glow.color, 0.0) != glm::dvec3(0.0))
            lamps.insert(scene.nodes[instance.node].name);
    }
    return lamps;
}

TEST(ArtGallery, HasTheContentsThatTheThesisAsksFor) {
    const Scene& scene = loaded("art-gallery");
    EXPECT_GE(count_triangles(scene), 70'000u);
    EXPECT_EQ(find_lamps(scene).size(), 8u);
    EXPECT_TRUE(scene.lights.empty());
    EXPECT_FALSE(scene.environment.radiance.has_value());
    EXPECT_EQ(frame_range(scene), (FrameRange{0, 749}));
    EXPECT_EQ(scene.film.frame_rate, (FrameRate{30, 1}));
    EXPECT_GE(scene.cages.size(), 6u);
    int tori = 0, lathes = 0;
    for (const Mesh& mesh : scene.meshes) {
        tori += mesh.shape && mesh.shape->kind == Shape::Kind::torus ? 1 : 0;
        lathes += mesh.shape && mesh.shape->kind == Shape::Kind::lathe ? 1 : 0;
    }
    EXPECT_GE(tori, 3);
    EXPECT_GE(lathes, 8);
    // Fourteen pictures with different textures.
    const int pictures = find_named(scene.nodes, "pictures");
    std::set<int> shown;
    for (const Instance& instance : list_instances(scene)) {
        const Node& node = scene.nodes[instance.node];
        if (node.parent == no_index || scene.nodes[node.parent].parent != pictures) continue;
        const int material = scene.meshes[instance.mesh].material;
        shown.insert(scene.materials[material].textures[TextureSlot::base_color].image);
    }
    shown.erase(no_index);
    EXPECT_EQ(shown.size(), 14u);
}

TEST(ArtGallery, OnlyTheExhibitsMove) {
    const Scene& scene = loaded("art-gallery");
    const ScenePose first = pose(scene, 0.0);
    std::set<std::string> moved;
    for (const double seconds : {4.0, 9.1, 17.3, 24.9}) {
        const ScenePose now = pose(scene, seconds);
        for (std::size_t i = 0; i < scene.nodes.size(); ++i)
            if (const std::string top = top_of(scene, static_cast<int>(i)); now.world[i] != first.world[i])
                moved.insert(top == "sculptures" ? scene.nodes[i].name : top);
    }
    EXPECT_EQ(moved, (std::set<std::string>{"balls", "camera_rig", "kinetic", "knot", "mobile", "top_work"}));
}

/// Height of the centre of a ball dropped from rest, by the laws of free fall.
double fallen_height(const BallDrop& drop, double seconds) {
    const double rest = drop.ground + drop.radius, fall = drop.position.y - rest;
    double t = seconds - drop.release;
    if (t <= 0.0) return drop.position.y;
    const double first = std::sqrt(2.0 * fall / gravity);
    if (t <= first) return drop.position.y - 0.5 * gravity * t * t;
    t -= first;
    double speed = drop.restitution * gravity * first;
    while (speed >= drop.settled_speed) {
        const double flight = 2.0 * speed / gravity;
        if (t <= flight) return rest + speed * t - 0.5 * gravity * t * t;
        t -= flight;
        speed *= drop.restitution;
    }
    return rest;
}

TEST(ArtGallery, BallsFallAndBounceByTheLawsOfFreeFall) {
    const Scene& scene = loaded("art-gallery");
    const std::vector<BallDrop> drops = make_ball_drops();
    ASSERT_GE(drops.size(), 6u);
    std::vector<double> highest(drops.size(), 0.0), lowest(drops.size(), 9.0);
    for (int k = 0; k <= 749 * 4; ++k) {
        const double seconds = k / 120.0;
        const ScenePose now = pose(scene, seconds);
        for (std::size_t i = 0; i < drops.size(); ++i) {
            const double y = origin_of(now, find_ball_node(scene, i)).y;
            // Keys are rounded to micrometres, velocities to micrometres per second.
            if (drops[i].velocity == glm::dvec3(0.0)) {
                EXPECT_NEAR(y, fallen_height(drops[i], seconds), 4e-6) << i << " at " << seconds;
            }
            EXPECT_GE(y, drops[i].ground + drops[i].radius - 4e-6) << i << " at " << seconds;
            highest[i] = std::max(highest[i], y);
            lowest[i] = std::min(lowest[i], y);
        }
    }
    int bounced = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) bounced += highest[i] - lowest[i] > 0.5 ? 1 : 0;
    EXPECT_GE(bounced, 8);
}

TEST(ArtGallery, EveryViewIsClosedAndShowsMotion) {
    const Scene& scene = loaded("art-gallery");
    for (int frame = 0; frame < 749; frame += 53) {
        const ScenePose now = pose(scene, frame / 30.0), next = pose(scene, (frame + 1) / 30.0);
        const Image<Hit> hits = cast_first_hits(scene, {now, make_camera_view(now.cameras.front(), 160, 120)});
        int moving = 0;
        for (const Hit& hit : hits.pixels) {
            ASSERT_NE(hit.instance, no_index) << frame;
            const int node = now.instances[hit.instance].node;
            moving += now.world[node] != next.world[node] ? 1 : 0;
            // The camera does not come close to any object.
            EXPECT_GT(hit.distance, 0.3) << frame << " " << scene.nodes[node].name;
        }
        EXPECT_GT(moving, 160 * 120 / 300) << frame;
    }
}

}  // namespace
}  // namespace aleph
