// Indirect light of samples at their own times: where it is read from the frame's, and where it must not be.

#include "render/time/shutter_light.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/support/shot_scenes.h"

namespace aleph {
namespace {

/// Answers with the place that it is asked for, from records that reach so far.
struct AskedPlace : CarriedLight {
    std::optional<Rgb> find(const PixelSurface& surface, float, RayTask&, RecordUse* used) const override {
        if (used != nullptr) used->add(1.0f, reach);
        return surface.point.position;
    }
    float reach = 1.0f;
};

/// A floor, over it a plate about the origin (node 1) seen from above, and a box far away (node 2). The camera is
/// node 3.
struct Plate {
    Plate() {
        add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, -0.5, 0.0}, z_to_up);
        add_mesh(scene, make_quad(1.0, 1.0, 0), glm::dvec3(0.0), z_to_up);
        add_mesh(scene, make_box(glm::dvec3(0.2), 0), {8.0, 1.0, 0.0});
        add_camera(scene, {0.0, 5.0, 0.0}, glm::dvec3(0.0), 0.2);
    }
    Scene scene;
};

/// The irradiance of the surface in the middle of the picture, one second after the frame.
std::optional<Rgb> find_middle(const Scene& scene, float accuracy, float reach = 1.0f) {
    const Stage frame(scene), sample(scene, 32, 24, 1.0);
    const SampleHits hits = cast_centers(sample.rays, sample.view, nullptr);
    const PixelSurface surface = make_pixel_surface(sample.shading, sample.view, hits, 16, 12);
    AskedPlace light;
    light.reach = reach;
    RayTask task(frame.rays);
    std::optional<Rgb> found =
        ShutterLight(frame.shading, sample.shading, &light, nullptr, 1.0).find(surface, accuracy, task);
    if (found) *found += glm::vec3(frame.shading.anchor);
    return found;
}

TEST(ShutterLight, RidesWithSurfacesThatMoveLessThanTheirRecordsReach) {
    Plate plate;
    plate.scene.nodes[1].translation = move_between({-0.3, 0.0, 0.0}, glm::dvec3(0.0));
    const std::optional<Rgb> found = find_middle(plate.scene, 0.5f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, -0.3, 0.06) << "where the point was at the frame's own time";
    EXPECT_TRUE(find_middle(plate.scene, 0.5f, 0.31f).has_value());
    EXPECT_FALSE(find_middle(plate.scene, 0.5f, 0.29f).has_value());
}

TEST(ShutterLight, ACameraThatMovesChangesNothing) {
    Plate plate;
    plate.scene.nodes[3].translation = move_between({700.0, 5.0, 0.0}, {0.0, 5.0, 0.0});
    const std::optional<Rgb> found = find_middle(plate.scene, 1e-3f, 1e-3f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, 0.0, 0.06);
}

TEST(ShutterLight, NothingIsKnownOfSurfacesThatTurnOrAppear) {
    const auto turned = [](double degrees) {
        Plate plate;
        const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 0.0, 1.0));
        plate.scene.nodes[1].rotation.values = {z_to_up, turn * z_to_up};
        return find_middle(plate.scene, 0.2f);
    };
    EXPECT_TRUE(turned(10.0).has_value());
    EXPECT_FALSE(turned(25.0).has_value()) << "a record's normal may differ by 16 degrees";

    Plate plate;
    plate.scene.nodes[1].visible.values = {0.0, 1.0};
    plate.scene.nodes[1].visible.interpolation = Interpolation::step;
    EXPECT_FALSE(find_middle(plate.scene, 1.0f).has_value());
}

TEST(ShutterLight, NothingIsKnownBesideThingsThatMoveOrAppear) {
    const auto moved = [](const glm::dvec3& from, const glm::dvec3& to) {
        Plate plate;
        plate.scene.nodes[2].translation = move_between(from, to);
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_FALSE(moved({0.2, 0.1, 0.0}, {2.0, 0.1, 0.0})) << "it leaves the point";
    EXPECT_FALSE(moved({2.0, 0.1, 0.0}, {0.3, 0.1, 0.0})) << "it arrives";
    EXPECT_TRUE(moved({2.0, 0.1, 0.0}, {3.0, 0.1, 0.0})) << "it is small at this distance";
    EXPECT_TRUE(moved({0.3, 0.1, 0.0}, {0.305, 0.1, 0.0})) << "it hardly moves";

    Plate plate;
    plate.scene.nodes[2].translation = glm::dvec3(0.3, 0.1, 0.0);
    EXPECT_TRUE(find_middle(plate.scene, 0.15f).has_value());
    plate.scene.nodes[2].visible.values = {0.0, 1.0};
    plate.scene.nodes[2].visible.interpolation = Interpolation::step;
    EXPECT_FALSE(find_middle(plate.scene, 0.15f).has_value());
}

TEST(ShutterLight, TheBoundHoldsForSpheres) {
    // A sphere that lies wholly above the horizon hides cos / d^2 of the irradiance, by r^2 (closed form).
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-3.0f, 3.0f), up(0.0f, 3.0f), small(0.0f, 1.0f);
    int near = 0;
    for (int i = 0; i < 20000; ++i) {
        const float radius = small(random);
        const glm::vec3 before(at(random), radius + up(random), at(random));
        glm::vec3 after = before + 0.5f * small(random) * glm::vec3(at(random), at(random), at(random));
        after.y = std::max(after.y, radius);
        const glm::vec3 moved(0.2f * at(random), 0.0f, 0.2f * at(random));
        const auto hidden = [&](const glm::vec3& center) {
            const float d = glm::length(center);
            return radius * radius * center.y / (d * d * d);
        };
        const float change = std::abs(hidden(after - moved) - hidden(before));
        const std::vector<ShutterMover> movers{{0, {before, after}, radius, glm::length(after - before)}};
        const float bound = find_hidden_change(movers, glm::vec3(0.0f), moved, 1, HUGE_VALF);
        EXPECT_LE(change, bound + 1e-6f) << i;
        if (change > 0.2f * bound) ++near;
        EXPECT_EQ(find_hidden_change(movers, glm::vec3(0.0f), moved, 0, HUGE_VALF), 0.0f) << "it moves along";
    }
    EXPECT_GT(near, 1000) << "and not by far too much";
}

}  // namespace
}  // namespace aleph
