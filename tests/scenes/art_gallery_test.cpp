// The scene art-gallery: its contents, and its motion against the laws of mechanics.

#include "render/frame/sequence.h"
#include "scenes/art-gallery/gallery.h"
#include "tests/scenes/authored_scenes.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

std::string top_of(const Scene& scene, int node) {
    while (scene.nodes[node].parent != no_index) node = scene.nodes[node].parent;
    return scene.nodes[node].name;
}

int find_ball_node(const Scene& scene, std::size_t number) {
    return find_node(scene, fmt::format("ball_{}", number));
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
    const int pictures = find_node(scene, "pictures");
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

TEST(ArtGallery, BallsThatTravelFlyOnParabolasAndRollWithoutSliding) {
    const Scene& scene = loaded("art-gallery");
    const std::vector<BallDrop> drops = make_ball_drops();
    int travelling = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) {
        if (glm::length(drops[i].velocity) == 0.0) continue;
        ++travelling;
        const Node& node = scene.nodes[find_ball_node(scene, i)];
        const Track<glm::dvec3>& path = node.transform.translation;
        ASSERT_EQ(path.interpolation, Interpolation::cubic);
        const std::size_t keys = path.key_count();
        ASSERT_GE(keys, 6u);
        ASSERT_TRUE(node.transform.axis_rotation.has_value());
        for (std::size_t k = 0; k + 1 < keys; ++k) {
            const double from = path.sampling.times[k], to = path.sampling.times[k + 1], h = (to - from) / 8.0;
            const bool flies = path.values[3 * k + 2].y > 0.0;
            for (int part = 1; part < 8; ++part) {
                const double t = from + part * h;
                const glm::dvec3 a =
                    (evaluate(path, t + h) - 2.0 * evaluate(path, t) + evaluate(path, t - h)) / (h * h);
                const double tolerance = 1e-5 / (h * h);
                if (flies) {
                    EXPECT_LT(glm::length(a - glm::dvec3(0.0, -gravity, 0.0)), tolerance) << i << " key " << k;
                }
            }
            // The vertical speed after an impact follows from the restitution.
            if (k > 0 && flies) {
                EXPECT_NEAR(path.values[3 * k + 2].y, -drops[i].restitution * path.values[3 * k].y, 3e-6);
            }
            // The contact point does not slide.
            const glm::dvec3 spin =
                node.transform.axis_rotation->axis * node.transform.axis_rotation->angle.values[3 * k + 2];
            const glm::dvec3 level = path.values[3 * k + 2] * glm::dvec3(1.0, 0.0, 1.0);
            EXPECT_LT(glm::length(level + glm::cross(spin, glm::dvec3(0.0, -drops[i].radius, 0.0))), 3e-6);
        }
    }
    EXPECT_EQ(travelling, 2);
}

TEST(ArtGallery, BallsNeverTouchOneAnother) {
    const Scene& scene = loaded("art-gallery");
    const std::vector<BallDrop> drops = make_ball_drops();
    std::vector<int> nodes;
    for (std::size_t i = 0; i < drops.size(); ++i) nodes.push_back(find_ball_node(scene, i));
    for (int k = 0; k <= 749 * 2; ++k) {
        const ScenePose now = pose(scene, k / 60.0);
        for (std::size_t a = 0; a < drops.size(); ++a) {
            for (std::size_t b = 0; b < a; ++b) {
                EXPECT_GT(glm::distance(origin_of(now, nodes[a]), origin_of(now, nodes[b])),
                          drops[a].radius + drops[b].radius)
                    << a << " and " << b << " at " << k / 60.0;
            }
        }
    }
}

TEST(ArtGallery, TopSpinsAndPrecessesOnItsTip) {
    const Scene& scene = loaded("art-gallery");
    const int top = find_node(scene, "top"), precession = find_node(scene, "top_precession");
    const auto& spin = scene.nodes[top].transform.axis_rotation->angle;
    const auto& turn = scene.nodes[precession].transform.axis_rotation->angle;
    const auto rate = [](const Track<double>& angle, double t) {
        return (evaluate(angle, t + 0.01) - evaluate(angle, t - 0.01)) / 0.02;
    };
    const glm::dvec3 tip = origin_of(pose(scene, 0.0), top);
    for (const double t : {0.5, 6.0, 12.0, 20.0, 24.5}) {
        const glm::dmat4 world = pose(scene, t).world[top];
        EXPECT_LT(glm::distance(glm::dvec3(world[3]), tip), 1e-12);
        const double lean = std::acos(world[1].y) * 180.0 / pi;
        EXPECT_GT(lean, 8.5) << t;
        EXPECT_LT(lean, 20.5) << t;
        // Under a constant torque the precession rate is inversely proportional to the spin.
        EXPECT_NEAR(rate(turn, t) * rate(spin, t), rate(turn, 0.5) * rate(spin, 0.5),
                    0.01 * rate(turn, 0.5) * rate(spin, 0.5));
    }
    EXPECT_NEAR(rate(spin, 0.02), 2.0 * pi * 2.3, 0.02);
    EXPECT_LT(rate(spin, 24.9), 2.0 * pi * 1.3);
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

TEST(ArtGallery, KineticWorkBleedsColour) {
    // Indirect light on the white parts has the colour of the vanes near them.
    const Scene& scene = loaded("art-gallery");
    const std::int64_t frame = 395;
    RenderSettings settings;
    settings.picture.width = 96;
    settings.picture.height = 72;
    settings.sampling.spp = 1;
    settings.cache.gather = 128;
    settings.guide.estimate = EstimateKind::flat;
    settings.perception.guide = Guide::none;
    const FrameOutput with = Sequence(scene, settings).render(frame);
    settings.light.bounces = 0;
    const FrameOutput without = Sequence(scene, settings).render(frame);
    const ScenePose now = pose(scene, scene.film.frame_rate.seconds_of(frame));
    double reddest = 0.0, least_red = 9.0;
    for (std::size_t i = 0; i < with.hits.size(); ++i) {
        const Hit& hit = with.hits.pixels[i];
        const Instance& instance = now.instances[hit.instance];
        const int material = scene.meshes[instance.mesh].material;
        if (scene.materials[material].name != "kinetic_white") continue;
        const Rgb bounced = with.shaded.color.pixels[i] - without.shaded.color.pixels[i];
        if (bounced.g < 0.02f) continue;
        reddest = std::max(reddest, static_cast<double>(bounced.r / bounced.g));
        least_red = std::min(least_red, static_cast<double>(bounced.r / bounced.g));
    }
    RecordProperty("reddest", std::to_string(reddest));
    RecordProperty("least_red", std::to_string(least_red));
    EXPECT_GT(reddest, 2.0);
    EXPECT_LT(least_red, 1.3);  // far from the red vane
}

}  // namespace
}  // namespace aleph
