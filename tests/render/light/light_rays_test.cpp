// Light rays against closed forms.

#include "render/light/light_rays.h"

#include <numeric>

#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double albedo = 0.4;

/// The inside of a cube with edges of 2 m about the origin.
void add_box(Scene& scene) {
    const Mesh wall = make_quad(2.0, 2.0, add_lambert(scene, glm::dvec3(albedo)));
    for (int i = 0; i < 4; ++i) {
        const double angle = i * std::numbers::pi / 2;
        add_mesh(scene, wall, {-std::sin(angle), 0.0, -std::cos(angle)}, turn_about_y(angle));
    }
    add_mesh(scene, wall, {0.0, -1.0, 0.0}, z_to_up);
    add_mesh(scene, wall, {0.0, 1.0, 0.0}, z_to_down);
}

/// Light that each instance reflects on the side that its normal points to, lm.
std::vector<double> add_light_rays(Scene scene, const LightTarget& target = {{}, 2.0f}, std::size_t rays = 40000) {
    const Stage stage(std::move(scene));
    RayCounts counts;
    std::vector<double> sums(stage.shading.instances.size());
    const std::vector<LitPlace> places = cast_light_rays(stage.lighting(), target, rays, counts);
    EXPECT_EQ(places.size(), rays);
    EXPECT_GE(counts.gather, rays);
    for (const LitPlace& place : places) {
        if (place.instance != no_index && !place.behind) sums[place.instance] += place.reflected;
    }
    return sums;
}

Scene make_square() {
    Scene scene;
    add_mesh(scene, make_quad(2.0, 2.0, add_lambert(scene, glm::dvec3(albedo))), {0.3, 0.0, 0.0}, z_to_up);
    return scene;
}

TEST(LightRays, OfAPointLightAreAsManyInAllDirections) {
    Scene scene;
    add_box(scene);
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.0, 0.0, 0.0});
    const std::vector<double> walls = add_light_rays(std::move(scene));
    ASSERT_EQ(walls.size(), 6u);
    for (const double wall : walls) EXPECT_NEAR(wall, albedo * 3.0 * 4.0 * std::numbers::pi / 6.0, 0.02 * wall);
}

/// Its light falls with the square of the cosine between its cones: a third of the solid angle between them counts.
TEST(LightRays, OfASpotHaveItsLight) {
    for (const double inner : {0.2, 0.5}) {
        SCOPED_TRACE(inner);
        constexpr double outer = 0.5;
        Scene scene;
        add_box(scene);
        add_light(scene, Light::Kind::spot, glm::dvec3(3.0), {0.2, 0.0, -0.1});
        scene.lights.back().inner_cone = Track<double>(inner);
        scene.lights.back().outer_cone = Track<double>(outer);
        const std::vector<double> walls = add_light_rays(std::move(scene));
        const double full = 1.0 - std::cos(inner), fading = std::cos(inner) - std::cos(outer);
        const double expected = albedo * 3.0 * 2.0 * std::numbers::pi * (full + fading / 3.0);
        EXPECT_NEAR(walls.front(), expected, 0.01 * expected);  // it shines along -z
        EXPECT_EQ(std::accumulate(walls.begin() + 1, walls.end(), 0.0), 0.0);
    }
}

/// Halves of the rays go by power and to each lamp alike: neither changes what they bring.
TEST(LightRays, OfSeveralLightsBringTheLightOfEach) {
    Scene scene;
    add_box(scene);
    add_lamp(scene, 0.1, glm::dvec3(500.0), {0.0, 0.5, 0.0});
    add_light(scene, Light::Kind::point, glm::dvec3(0.05), {0.0, 0.0, 0.0});
    add_light(scene, Light::Kind::point, glm::dvec3(0.5), {0.0, 0.1, 0.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(5.0), {});  // shut out
    const std::vector<double> walls = add_light_rays(std::move(scene));
    const double expected = albedo * (500.0 * 0.01 * std::numbers::pi + 0.55 * 4.0 * std::numbers::pi);
    // The lamp itself is black, and stops a little of the points' light.
    EXPECT_NEAR(std::accumulate(walls.begin(), walls.end(), 0.0), expected, 0.01 * expected);
}

TEST(LightRays, BringNothingBeyondARange) {
    Scene scene;
    add_box(scene);
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.0, 0.0, 0.0});
    scene.lights.back().range = Track<double>(0.9);
    for (const double wall : add_light_rays(std::move(scene))) EXPECT_EQ(wall, 0.0);
}

TEST(LightRays, OfTheSunCrossTheTarget) {
    for (const double angle : {0.4, 1.3}) {
        for (const LightTarget target : {LightTarget{{}, 2.0f}, LightTarget{{0.5f, 0.5f, 0.0f}, 3.0f}}) {
            Scene scene = make_square();
            add_light(scene, Light::Kind::directional, glm::dvec3(3.0), {},
                      glm::angleAxis(-angle, glm::dvec3(1.0, 0.0, 0.0)));
            const double expected = albedo * 3.0 * 4.0 * std::sin(angle);
            EXPECT_NEAR(add_light_rays(std::move(scene), target).front(), expected, 0.03 * expected);
        }
    }
}

TEST(LightRays, OfTheSkyComeFromAllAround) {
    for (const bool picture : {false, true}) {
        Scene scene = make_square();
        if (picture) add_surroundings(scene, Image<Rgb>(8, 4, Rgb(1.0f)));
        scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(3.0));
        const double expected = albedo * std::numbers::pi * 3.0 * 4.0;
        EXPECT_NEAR(add_light_rays(std::move(scene)).front(), expected, 0.03 * expected);
    }
}

/// A sheet reflects 4 % of light that meets it along its normal.
TEST(LightRays, PassSheetsOfGlass) {
    Scene scene = make_square();
    Material glass{.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}};
    scene.materials.push_back(glass);
    add_mesh(scene, make_quad(8.0, 8.0, static_cast<int>(scene.materials.size()) - 1), {0.0, 1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::directional, glm::dvec3(3.0), {}, z_to_up);  // along -z of its node
    const double expected = albedo * 3.0 * 4.0 * 0.96;
    EXPECT_NEAR(add_light_rays(std::move(scene)).front(), expected, 0.01 * expected);
}

TEST(LightRays, AreNoneInTheDark) {
    const Stage stage(make_square());
    RayCounts counts;
    EXPECT_TRUE(cast_light_rays(stage.lighting(), {{}, 2.0f}, 1000, counts).empty());
    EXPECT_EQ(counts.gather, 0u);
}

}  // namespace
}  // namespace aleph
