// Light rays, and the bright surfaces that they find, against closed forms.

#include <numeric>

#include "render/light/bright_surfaces.h"
#include "render/light/light_rays.h"
#include "tests/support/penumbra.h"
#include "tests/support/shaded_lamp.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A face of a cube beside one that shines gets .200044 of its light, the opposite one .199825 (Howell 2010, "A
/// Catalog of Radiation Heat Transfer Configuration Factors", C-11 and C-14).
TEST(BrightSurfaces, AreTheInsideOfAShade) {
    const ShadedLamp lamp;
    EXPECT_EQ(lamp.light_rays, BrightSurfaces::light_rays + BrightSurfaces::more_light_rays);
    double reflected = 0.0;
    int patches = 0;
    for (const Emitter& patch : lamp.surfaces.patches.emitters) {
        if (patch.center.y < 0.5f * ShadedLamp::height) continue;  // of the floor under the opening
        ++patches;
        const glm::vec3 to_axis = glm::vec3(0.0f, patch.center.y, 0.0f) - patch.center;
        EXPECT_GT(glm::dot(patch.shape->triangles.front().normal, to_axis), 0.09f);
        reflected += pi * patch.area * luminance(patch.radiance);
    }
    EXPECT_EQ(patches, 8);
    EXPECT_NEAR(reflected, 0.8 * 4.0 * 0.200044 * 100.0 * pi * ShadedLamp::side * ShadedLamp::side, 0.01 * reflected);
}

/// A lamp close above a wide floor of two triangles.
TEST(BrightSurfaces, ArePartsOfLargeTriangles) {
    constexpr double above = 0.25, radiance = 50.0, albedo = 0.5;  // m, cd/m2
    Scene scene;
    add_mesh(scene, make_quad(6.0, 6.0, add_lambert(scene, glm::dvec3(albedo))), glm::dvec3(0.0), z_to_up);
    add_lamp(scene, ShadedLamp::side, glm::dvec3(radiance), {0.0, above, 0.0});
    const Stage stage(std::move(scene));
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(stage, {{{0.0f, 1.0f, 1.0f}, glm::vec3(0.0f, 0.0f, -1.0f)}}, counts);
    const auto find = [&](double x, double z) {
        RayTask task(stage.rays);
        const glm::vec3 down(0.0f, -1.0f, 0.0f);
        return surfaces.find(task.tracer.intersect({{x, 0.5 * above, z}, down}), down);
    };
    EXPECT_NE(find(0.01, 0.003), no_index);
    EXPECT_EQ(find(2.0, 1.0), no_index);
    EXPECT_EQ(find(-1.0, 2.0), no_index);
    const auto reflect = [&](const glm::vec3& place) {
        double factor = 0.0;
        for (const double x : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                factor +=
                    corner_factor(0.5 * ShadedLamp::side + x * place.x, 0.5 * ShadedLamp::side + z * place.z, above);
            }
        }
        return albedo * radiance * factor;
    };
    double area = 0.0, found = 0.0, expected = 0.0;
    for (const Emitter& patch : surfaces.patches.emitters) {
        const Emitter::Triangle& t = patch.shape->triangles.front();
        constexpr int rows = 16;
        double mean = 0.0;
        for (int i = 0; i < rows * rows; ++i) {
            const glm::vec2 b = sample_triangle({(i / rows + 0.5f) / rows, (i % rows + 0.5f) / rows});
            const glm::vec3 place = t.corner + b.x * t.edge1 + b.y * t.edge2;
            mean += reflect(place) / (rows * rows);
            EXPECT_EQ(find(place.x, place.z), &patch - surfaces.patches.emitters.data());
        }
        EXPECT_NEAR(luminance(patch.radiance), mean, 0.25 * mean);
        area += patch.area;
        found += patch.area * luminance(patch.radiance);
        expected += patch.area * mean;
    }
    EXPECT_NEAR(found, expected, 0.01 * expected);
    EXPECT_GT(found, 0.7 * albedo * radiance * ShadedLamp::side * ShadedLamp::side);
    EXPECT_LT(area, 1.5);
}

TEST(BrightSurfaces, AreMetFromTheirBrightSideOnly) {
    const ShadedLamp lamp;
    const auto find = [&](const glm::vec3& from, const glm::vec3& direction) {
        RayTask task(lamp.gathering.stage.rays);
        return lamp.surfaces.find(task.tracer.intersect({from, direction}), direction);
    };
    const glm::vec3 inside(0.0f, ShadedLamp::height + 0.1f, 0.0f);
    EXPECT_NE(find(inside, {1.0f, 0.0f, 0.0f}), no_index);
    EXPECT_EQ(find(inside + glm::vec3(2.0f, 0.0f, 0.0f), {-1.0f, 0.0f, 0.0f}), no_index);
    EXPECT_EQ(find(inside, {0.0f, -1.0f, 0.0f}), no_index);  // the floor
    EXPECT_EQ(find(inside + glm::vec3(2.0f, 0.0f, 0.0f), up), no_index);
}

TEST(BrightSurfaces, AreNoneWhereNothingStandsOut) {
    for (const bool dark : {false, true}) {
        Scene scene;
        add_small_room(scene, add_lambert(scene, glm::dvec3(0.5)), add_lambert(scene, glm::dvec3(0.5)),
                       glm::dvec3(dark ? 0.0 : 10.0), 1.0);
        const Stage stage(std::move(scene));
        RayCounts counts;
        EXPECT_TRUE(find_bright(stage, make_floor_places(-1.0f), counts).empty());
        EXPECT_EQ(counts.gather, dark ? 0u : BrightSurfaces::light_rays);
        EXPECT_TRUE(find_bright(stage, {}, counts).empty());
    }
}

/// Sunlight through a window, on the floor of a room whose roof it lights as well.
TEST(BrightSurfaces, ArePlacesInSunlightThatFaceTheRoom) {
    Scene scene;
    add_small_room(scene, add_lambert(scene, glm::dvec3(0.5)), add_lambert(scene, glm::dvec3(0.5)), glm::dvec3(0.0),
                   0.1);
    add_mesh(scene, make_quad(2.0, 1.6, add_lambert(scene, glm::dvec3(0.5))), {0.0, 0.2, 1.0},
             turn_about_y(std::numbers::pi));
    add_light(scene, Light::Kind::directional, glm::dvec3(10.0), {}, glm::angleAxis(-0.6, glm::dvec3(1.0, 0.0, 0.0)));
    const Stage stage(std::move(scene));
    RayCounts counts;
    const glm::vec3 forth(0.0f, 0.0f, 1.0f);  // from the glm::vec3(0.0f, 0.0f, -1.0f) wall
    const std::vector<Receiver> places{
        {{-0.9f, -0.9f, -1.0f}, forth}, {{0.9f, 0.9f, -1.0f}, forth}, {{0.0f, -1.0f, 0.9f}, up}};
    const BrightSurfaces surfaces = find_bright(stage, places, counts);
    // Light enters under the window's upper edge, which is .4 m above the floor.
    const double reach = 0.4 / std::tan(0.6);
    double area = 0.0, reflected = 0.0;
    for (const Emitter& patch : surfaces.patches.emitters) {
        const Emitter::Triangle& t = patch.shape->triangles.front();
        EXPECT_GT(t.normal.y, 0.99f);
        EXPECT_NEAR(patch.center.y, -1.0, 1e-5);
        reflected += std::numbers::pi * patch.area * luminance(patch.radiance);
        EXPECT_GT(std::max({t.corner.z, t.corner.z + t.edge1.z, t.corner.z + t.edge2.z}), 1.0 - reach);
        area += patch.area;
    }
    EXPECT_LT(area, 1.5 * 2.0 * reach);  // some are lit in part
    EXPECT_NEAR(reflected, 0.5 * 10.0 * std::sin(0.6) * 2.0 * reach, 0.1 * reflected);
}

constexpr double wall_albedo = 0.4;

/// The inside of a cube with edges of 2 m about the origin.
void add_box(Scene& scene) {
    const Mesh wall = make_quad(2.0, 2.0, add_lambert(scene, glm::dvec3(wall_albedo)));
    for (int i = 0; i < 4; ++i) {
        const double angle = i * std::numbers::pi / 2;
        add_mesh(scene, wall, {-std::sin(angle), 0.0, -std::cos(angle)}, turn_about_y(angle));
    }
    add_mesh(scene, wall, {0.0, -1.0, 0.0}, z_to_up);
    add_mesh(scene, wall, {0.0, 1.0, 0.0}, z_to_down);
}

/// Light that each instance reflects on the side that its normal points to, lm.
std::vector<double> add_light_rays(Scene scene, const BoundingSphere& target = {{}, 2.0f}, std::size_t rays = 40000) {
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
    add_mesh(scene, make_quad(2.0, 2.0, add_lambert(scene, glm::dvec3(wall_albedo))), {0.3, 0.0, 0.0}, z_to_up);
    return scene;
}

TEST(LightRays, OfAPointLightAreAsManyInAllDirections) {
    Scene scene;
    add_box(scene);
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.0, 0.0, 0.0});
    const std::vector<double> walls = add_light_rays(std::move(scene));
    ASSERT_EQ(walls.size(), 6u);
    for (const double wall : walls) EXPECT_NEAR(wall, wall_albedo * 3.0 * 4.0 * std::numbers::pi / 6.0, 0.02 * wall);
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
        const double expected = wall_albedo * 3.0 * 2.0 * std::numbers::pi * (full + fading / 3.0);
        EXPECT_NEAR(walls.front(), expected, 0.01 * expected);  // it shines along -z
        EXPECT_EQ(std::accumulate(walls.begin() + 1, walls.end(), 0.0), 0.0);
    }
}

/// A lamp of two sides as far from the floor as from the ceiling.
TEST(LightRays, LeaveBothSidesOfALamp) {
    Scene scene;
    add_box(scene);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(500.0), true);
    add_mesh(scene, make_quad(0.1, 0.1, lamp), glm::dvec3(0.0), z_to_up);
    const std::vector<double> walls = add_light_rays(std::move(scene));
    const double expected = wall_albedo * 500.0 * 0.01 * std::numbers::pi;  // of each side
    EXPECT_NEAR(std::accumulate(walls.begin(), walls.end(), 0.0), 2.0 * expected, 0.01 * expected);
    EXPECT_NEAR(walls[4], walls[5], 0.03 * expected);
}

/// A cube in the middle of the box, and a sun that is shut out.
TEST(LightRays, LeaveAllTrianglesOfALamp) {
    Scene scene;
    add_box(scene);
    add_mesh(scene, make_box(glm::dvec3(0.1), add_lambert(scene, glm::dvec3(0.0), glm::dvec3(500.0))));
    add_light(scene, Light::Kind::directional, glm::dvec3(5.0), {});
    const std::vector<double> walls = add_light_rays(std::move(scene));
    const double expected = wall_albedo * 500.0 * 0.01 * std::numbers::pi;
    for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(walls[i], expected, 0.05 * expected) << i;
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
    const double expected = wall_albedo * (500.0 * 0.01 * std::numbers::pi + 0.55 * 4.0 * std::numbers::pi);
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
        for (const BoundingSphere target : {BoundingSphere{{}, 2.0f}, BoundingSphere{{0.5f, 0.5f, 0.0f}, 3.0f}}) {
            Scene scene = make_square();
            add_light(scene, Light::Kind::directional, glm::dvec3(3.0), {},
                      glm::angleAxis(-angle, glm::dvec3(1.0, 0.0, 0.0)));
            const double expected = wall_albedo * 3.0 * 4.0 * std::sin(angle);
            EXPECT_NEAR(add_light_rays(std::move(scene), target).front(), expected, 0.03 * expected);
        }
    }
}

TEST(LightRays, OfTheSkyComeFromAllAround) {
    for (const bool picture : {false, true}) {
        Scene scene = make_square();
        if (picture) add_surroundings(scene, Image<Rgb>(8, 4, Rgb(1.0f)));
        scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(3.0));
        const double expected = wall_albedo * std::numbers::pi * 3.0 * 4.0;
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
    const double expected = wall_albedo * 3.0 * 4.0 * 0.96;
    EXPECT_NEAR(add_light_rays(std::move(scene)).front(), expected, 0.01 * expected);
}

}  // namespace
}  // namespace aleph
