// Indirect light of samples at their own times: where it is read from the frame's, or between two times.

#include "render/time/shutter_light.h"
#include "render/time/shutter_shadows.h"

#include "tests/render/time/plate.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ShutterLight, RidesWithSurfacesThatMoveLessThanTheirRecordsReach) {
    Plate plate;
    plate.scene.nodes[1].transform.translation = move_between({-0.3, 0.0, 0.0}, glm::dvec3(0.0));
    const std::optional<Rgb> found = find_middle(plate.scene, 0.5f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, -0.3, 0.06) << "where the point was at the frame's own time";
    EXPECT_TRUE(find_middle(plate.scene, 0.5f, 0.31f).has_value());
    EXPECT_FALSE(find_middle(plate.scene, 0.5f, 0.29f).has_value());
}

TEST(ShutterLight, ACameraThatMovesChangesNothing) {
    Plate plate;
    plate.scene.nodes[3].transform.translation = move_between({700.0, 5.0, 0.0}, {0.0, 5.0, 0.0});
    const glm::dvec3 away(8.0, 1.0, 0.0);
    plate.scene.nodes[2].transform.translation = Track<glm::dvec3>({0.0, 1.0, 2.0}, {away, away, -away});  // later
    const std::optional<Rgb> found = find_middle(plate.scene, 1e-3f, 1e-3f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, 0.0, 0.06);
    EXPECT_TRUE(find_movers(Stage(plate.scene).shading, Stage(plate.scene, 32, 24, 1.0).shading).empty());
}

TEST(ShutterLight, NothingIsKnownOfSurfacesThatTurnOrAppear) {
    const auto turned = [](double degrees) {
        Plate plate;
        const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 0.0, 1.0));
        plate.scene.nodes[1].transform.rotation.values = {z_to_up, turn * z_to_up};
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
        plate.scene.nodes[2].transform.translation = move_between(from, to);
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_FALSE(moved({0.2, 0.1, 0.0}, {2.0, 0.1, 0.0})) << "it leaves the point";
    EXPECT_FALSE(moved({2.0, 0.1, 0.0}, {0.3, 0.1, 0.0})) << "it arrives";
    EXPECT_TRUE(moved({2.0, 0.1, 0.0}, {3.0, 0.1, 0.0})) << "it is small at this distance";
    EXPECT_TRUE(moved({0.3, 0.1, 0.0}, {0.305, 0.1, 0.0})) << "it hardly moves";

    Plate plate;
    plate.scene.nodes[2].transform.translation = glm::dvec3(0.3, 0.1, 0.0);
    EXPECT_TRUE(find_middle(plate.scene, 0.15f).has_value());
    plate.scene.nodes[2].visible.values = {0.0, 1.0};
    plate.scene.nodes[2].visible.interpolation = Interpolation::step;
    EXPECT_FALSE(find_middle(plate.scene, 0.15f).has_value());
}

TEST(ShutterLight, NothingIsKnownWhereLightsMoveFar) {
    const auto is_known = [](Light::Kind kind, const glm::dvec3& to, double radians) {
        Plate plate;
        add_light(plate.scene, kind, glm::dvec3(5.0), {0.0, 4.0, 0.0}, z_to_up);
        plate.scene.nodes.back().transform.translation = move_between({0.0, 4.0, 0.0}, to);
        const glm::dquat turn = glm::angleAxis(radians, glm::dvec3(0.0, 0.0, 1.0));
        plate.scene.nodes.back().transform.rotation.values = {z_to_up, turn * z_to_up};
        return find_middle(plate.scene, 0.15f).has_value();
    };
    const glm::dvec3 here(0.0, 4.0, 0.0);
    EXPECT_TRUE(is_known(Light::Kind::point, {0.1, 4.0, 0.0}, 1.0)) << "it has no direction";
    EXPECT_FALSE(is_known(Light::Kind::point, {0.5, 4.0, 0.0}, 0.0));
    EXPECT_TRUE(is_known(Light::Kind::spot, here, 0.02));
    EXPECT_FALSE(is_known(Light::Kind::spot, here, 0.2));
    EXPECT_TRUE(is_known(Light::Kind::directional, {50.0, 4.0, 0.0}, 0.02)) << "it has no place";
    EXPECT_FALSE(is_known(Light::Kind::directional, here, 0.2));

    Plate dark;
    add_light(dark.scene, Light::Kind::point, glm::dvec3(0.0), here);
    dark.scene.nodes.back().transform.translation = move_between(here, {2.0, 4.0, 0.0});
    EXPECT_TRUE(find_middle(dark.scene, 0.15f).has_value());

    Plate plate;
    plate.scene.nodes[2].transform.translation = move_between({2.0, 0.1, 0.0}, {3.0, 0.1, 0.0});
    EXPECT_TRUE(find_middle(plate.scene, 0.15f).has_value());
    plate.scene.meshes[2].material = add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(5.0));
    EXPECT_FALSE(find_middle(plate.scene, 0.15f).has_value()) << "a lamp, not a box";
}

TEST(ShutterLight, NothingIsKnownWhereThingsHideLights) {
    // The light is 9 m away from the point.
    const auto is_known = [](Light::Kind kind, const glm::dvec3& from, const glm::dvec3& to) {
        Plate plate;
        add_light(plate.scene, kind, glm::dvec3(5.0), {8.0, 4.0, 0.0}, z_to_up);
        plate.scene.lights.back().inner_cone.values = plate.scene.lights.back().outer_cone.values = {0.3};
        plate.scene.nodes[2].transform.translation = move_between(from, to);
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_FALSE(is_known(Light::Kind::point, {8.0, 3.8, 0.0}, {8.4, 3.8, 0.0}));
    EXPECT_TRUE(is_known(Light::Kind::point, {8.0, 3.8, 0.0}, {8.005, 3.8, 0.0})) << "it hardly moves";
    EXPECT_TRUE(is_known(Light::Kind::point, {8.0, 2.0, 0.0}, {8.4, 2.0, 0.0})) << "it hides little";
    EXPECT_FALSE(is_known(Light::Kind::spot, {8.0, 3.0, 0.0}, {8.4, 3.0, 0.0})) << "more of a cone";
    EXPECT_TRUE(is_known(Light::Kind::spot, {8.0, 5.0, 0.0}, {8.4, 5.0, 0.0})) << "behind it";
    EXPECT_FALSE(is_known(Light::Kind::spot, {8.36, 3.0, 0.0}, {8.36, 3.0, 0.4})) << "its edge is within the cone";

    const glm::dvec3 high(0.0, 8.0, 0.0), beside(0.2, 8.0, 0.0);
    EXPECT_FALSE(is_known(Light::Kind::directional, high, beside)) << "its shadow is at the point";
    EXPECT_TRUE(is_known(Light::Kind::point, high, beside));
    EXPECT_TRUE(is_known(Light::Kind::directional, {8.0, 3.8, 0.0}, {8.4, 3.8, 0.0}));
    EXPECT_TRUE(is_known(Light::Kind::directional, {0.0, -8.0, 0.0}, {0.2, -8.0, 0.0})) << "it is below";

    const auto of_lamp = [](double size, double way, double from = 8.0, double to = 8.2, double height = 1.0) {
        Plate plate;
        const int dark = add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(5.0));
        const int lamp = add_mesh(plate.scene, make_quad(size, size, dark), {8.0, 1.3, 0.0}, z_to_down);
        plate.scene.nodes[lamp].transform.translation = move_between({8.0, 1.3, 0.0}, {8.0 + way, 1.3, 0.0});
        plate.scene.nodes[2].transform.translation = move_between({from, height, 0.0}, {to, height, 0.0});
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_FALSE(of_lamp(0.2, 0.0));
    EXPECT_FALSE(of_lamp(0.2, 0.0, 8.0, 8.2, 0.75)) << "it is nearer to the lamp's border";
    EXPECT_FALSE(of_lamp(0.2, -0.05, 7.2, 8.0)) << "they meet";
    EXPECT_TRUE(of_lamp(0.2, -0.05, 7.2, 7.3)) << "they do not";
    EXPECT_TRUE(of_lamp(0.2, 0.2)) << "it moves along";
    EXPECT_TRUE(of_lamp(2.0, 0.0)) << "it is large";
}

TEST(ShutterLight, NothingIsKnownBesideThingsThatFade) {
    const auto is_known = [](const Material& material, int mesh, const glm::dvec3& place, bool lamp = false) {
        Plate plate;
        if (lamp) add_light(plate.scene, Light::Kind::point, glm::dvec3(5.0), place + glm::dvec3(0.0, 0.3, 0.0));
        plate.scene.materials.push_back(material);
        plate.scene.meshes[mesh].material = static_cast<int>(plate.scene.materials.size()) - 1;
        plate.scene.nodes[mesh].transform.translation = place;
        return find_middle(plate.scene, 0.15f).has_value();
    };
    const auto fading = [](double to) {
        Material material;
        material.base_color = move_between(glm::dvec3(0.5), glm::dvec3(to));
        return material;
    };
    const glm::dvec3 below(0.0, -0.5, 0.0), beside(0.3, 0.1, 0.0), away(8.0, 1.0, 0.0);
    EXPECT_TRUE(is_known(fading(0.55), 0, below));
    EXPECT_FALSE(is_known(fading(0.7), 0, below));
    EXPECT_FALSE(is_known(fading(0.0), 2, beside));
    EXPECT_TRUE(is_known(fading(0.0), 2, away)) << "it is small at this distance";
    EXPECT_FALSE(is_known(fading(0.7), 1, glm::dvec3(0.0))) << "a mesh may see itself";
    Material cut;
    cut.opacity = {.mode = Opacity::Mode::mask};
    cut.opacity.alpha.values = {0.51, 0.49};
    EXPECT_FALSE(is_known(cut, 2, beside));
    EXPECT_TRUE(is_known(cut, 2, away));
    EXPECT_FALSE(is_known(cut, 2, away, true)) << "it may hide the lamp";
}

TEST(ShutterLight, NothingIsKnownWhereLightsBrightenOrDim) {
    const auto is_known = [](Track<double> Light::*value, double from, double to) {
        Plate plate;
        add_light(plate.scene, Light::Kind::spot, glm::dvec3(5.0), {0.0, 4.0, 0.0}, z_to_down);
        (plate.scene.lights.back().*value).values = {from, to};
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_TRUE(is_known(&Light::intensity, 1.0, 0.9));
    EXPECT_FALSE(is_known(&Light::intensity, 1.0, 0.8));
    EXPECT_FALSE(is_known(&Light::intensity, 0.8, 1.0));
    EXPECT_TRUE(is_known(&Light::outer_cone, 0.5, 0.52));
    EXPECT_FALSE(is_known(&Light::outer_cone, 0.5, 0.6));
    EXPECT_FALSE(is_known(&Light::inner_cone, 0.3, 0.1));
    EXPECT_TRUE(is_known(&Light::range, 10.0, 10.2));
    EXPECT_FALSE(is_known(&Light::range, 10.0, 11.0));
    EXPECT_FALSE(is_known(&Light::range, 10.0, 0.0)) << "0 is without end";

    const auto shines = [](double to, bool around) {
        Plate plate;
        const Track<glm::dvec3> light = move_between(glm::dvec3(0.5), glm::dvec3(to));
        plate.scene.meshes[2].material = add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(0.5));
        if (around)
            plate.scene.environment.radiance = light;
        else
            plate.scene.materials.back().glow.color = light;
        return find_middle(plate.scene, 0.15f).has_value();
    };
    for (const bool around : {false, true}) {
        EXPECT_TRUE(shines(0.55, around));
        EXPECT_FALSE(shines(0.65, around));
    }
}

TEST(ShutterLight, TheBoundHoldsForSpheres) {
    // A sphere that lies wholly above the horizon hides cos / d^2 of the irradiance, by r^2 (closed form).
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-3.0f, 3.0f), height(0.0f, 3.0f), small(0.0f, 1.0f);
    const glm::vec3 place(0.7f, -0.4f, 1.3f);
    int near = 0;
    for (int i = 0; i < 20000; ++i) {
        const float radius = small(random);
        const glm::vec3 before(at(random), radius + height(random), at(random));
        glm::vec3 after = before + 0.5f * small(random) * glm::vec3(at(random), at(random), at(random));
        after.y = std::max(after.y, radius);
        const glm::vec3 moved(0.2f * at(random), 0.0f, 0.2f * at(random));
        const auto hidden = [&](const glm::vec3& center) {
            const float d = glm::length(center);
            return radius * radius * center.y / (d * d * d);
        };
        const float change = std::abs(hidden(after - moved) - hidden(before));
        const std::vector<ShutterMover> movers{
            {0, {place + before, place + after}, radius, glm::length(after - before)}};
        const float bound = find_hidden_change(movers, place, moved, 1, HUGE_VALF);
        EXPECT_LE(change, bound + 1e-6f) << i;
        if (change > 0.2f * bound) ++near;
        EXPECT_EQ(find_hidden_change(movers, place, moved, 0, HUGE_VALF), 0.0f) << "it moves along";
    }
    EXPECT_GT(near, 1000) << "and not by far too much";
}

TEST(ShutterLight, BetweenTwoTimesLampsThatMoveStraightErrByTheSecondOrder) {
    // A lamp of irradiance 1 / d^2, interpolated between two places of it (closed form).
    std::mt19937 random(6);
    std::uniform_real_distribution<float> at(-1.0f, 1.0f), share(0.0f, 1.0f);
    int near = 0, known = 0, once = 0;
    for (int i = 0; i < 20000; ++i) {
        const glm::vec3 before(at(random), 2.0f + at(random), at(random)),
            after = before + 0.5f * glm::vec3(at(random), at(random), at(random));
        const float weight = share(random), off = i % 4 == 0 ? 0.1f : 0.0f;
        const glm::vec3 now = glm::mix(before, after, weight) + off * glm::vec3(at(random), at(random), at(random));
        const auto mover = [&](const glm::vec3& key) {
            return ShutterMover{.centers = {key, now}, .moved = glm::distance(key, now), .shines = true, .light = 0};
        };
        std::vector<ShutterMover> from{mover(before)}, to{mover(after)};
        const auto bound = [&] {
            return (1.0f - weight) * find_light_change(from, glm::vec3(0.0f), glm::vec3(0.0f)) +
                   weight * find_light_change(to, glm::vec3(0.0f), glm::vec3(0.0f));
        };
        if (bound() < 0.1f) ++once;
        find_bends(from, to, weight);
        const auto light = [](const glm::vec3& lamp) { return 1.0f / glm::dot(lamp, lamp); };
        const float error = std::abs((1.0f - weight) * light(before) + weight * light(after) - light(now)) / light(now);
        if (bound() < 0.1f) {
            ++known;
            EXPECT_LE(error, 1.5f * bound() + 1e-5f) << i;
        }
        if (error > 0.2f * bound()) ++near;
    }
    EXPECT_GT(known, 2 * once);
    EXPECT_GT(near, 1000) << "and not by far too much";
}

TEST(ShutterLight, BetweenTwoTimesALampThatGoesThereAtOnceIsNotKnown) {
    ShutterMover there{.centers = {{0.0f, 2.0f, 0.0f}, {0.0f, 2.0f, 0.0f}}, .shines = true, .light = 0};
    ShutterMover far = there;
    far.centers[0] = {1.0f, 2.0f, 0.0f};
    far.moved = 1.0f;
    std::vector<ShutterMover> from, to{far};  // at rest since the first
    find_bends(from, to, 0.5f);
    EXPECT_NEAR(to[0].bend, 0.5f, 1e-6f);
    EXPECT_GT(find_light_change(to, glm::vec3(0.0f), glm::vec3(0.0f)), 0.5f);
}

TEST(ShutterLight, BetweenTwoTimesBrightnessIsComparedWithTheLine) {
    const auto dims = [](std::vector<double> seconds, std::vector<double> values) {
        Plate plate;
        add_light(plate.scene, Light::Kind::point, glm::dvec3(5.0), {0.0, 4.0, 0.0}, z_to_down);
        plate.scene.lights.back().intensity = Track<double>(std::move(seconds), std::move(values));
        const Stage before(plate.scene), after(plate.scene, 32, 24, 1.0), sample(plate.scene, 32, 24, 0.25);
        return find_dimming(before.shading, after.shading, 0.25f, sample.shading);
    };
    EXPECT_NEAR(dims({0.0, 1.0}, {0.0, 2.0}), 0.0f, 1e-6f);
    EXPECT_NEAR(dims({0.0, 0.25, 1.0}, {2.0, 1.0, 2.0}), 0.5f, 1e-6f);
}

/// The sun shines down: what moves counts by how far its shadow is from the point, and not above its own height.
TEST(ShutterLight, ShadowsOfTheSunCountByTheirDistance) {
    Plate plate;
    add_light(plate.scene, Light::Kind::directional, glm::dvec3(5.0), glm::dvec3(0.0), z_to_up);
    const Stage stage(plate.scene);
    const auto find = [&](const glm::vec3& from, const glm::vec3& to, float faded = 0.0f, const glm::vec3& moved = {}) {
        const ShutterMover mover{
            .instance = 2, .centers = {from, to}, .radius = 0.2f, .moved = glm::length(to - from), .faded = faded};
        return find_sunlight_change(stage.shading, {mover}, {0.1f, 0.2f, 0.3f}, moved, no_index, HUGE_VALF);
    };
    const auto expect = [](float distance, float way) { return 0.04f / (distance * distance) * 3.0f * way / distance; };
    EXPECT_NEAR(find({2.1f, 9.2f, 0.3f}, {2.6f, 9.2f, 0.3f}), expect(2.0f, 0.5f), 1e-6f);
    EXPECT_NEAR(find({2.6f, 9.2f, 0.3f}, {2.1f, 9.2f, 0.3f}), expect(2.0f, 0.5f), 1e-6f);
    EXPECT_NEAR(find({0.1f, -3.8f, 0.3f}, {0.1f, -4.8f, 0.3f}), expect(4.0f, 1.0f), 1e-6f) << "below the point";
    const glm::vec3 beside(2.1f, 9.2f, 0.3f);
    EXPECT_NEAR(find(beside, beside, 0.5f), 0.01f * 0.5f, 1e-6f) << "it fades";
    EXPECT_NEAR(find(beside, beside, 0.0f, {1.0f, 0.0f, 0.0f}), 0.04f, 1e-6f) << "the point comes to half the distance";
}

}  // namespace
}  // namespace aleph
