// The quick estimate of mirrors: they show what they reflect.

#include <numbers>

#include "render/estimate/estimate.h"
#include "render/estimate/sight_line.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int mirror_side = 4;  // pixels
constexpr double near_radiance = 0.3, far_radiance = 0.7, metal_color = 0.8, dielectric_reflects = 0.04;

/// Radiance of what the camera sees, which looks down from a height of 3 m.
/// @param spread  by which pixels may differ
Rgb estimate_below(Scene& scene, double spread = 1e-5, const EstimateOptions& options = {}) {
    add_camera(scene, {0.0, 3.0, 0.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.2;
    const Stage stage(scene, mirror_side, mirror_side);
    RayCounts counts;
    const Image<Rgb> seen =
        compute_estimate(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), options, counts);
    for (const Rgb& pixel : seen.pixels) EXPECT_NEAR(pixel.x, seen(1, 1).x, spread);
    return seen(1, 1);
}

/// A sheet that faces up at a height.
void add_sheet(Scene& scene, double height, int material) {
    add_mesh(scene, make_quad(8.0, 8.0, material), {0.0, height, 0.0}, z_to_up);
}

/// Shows its radiance and lights nothing.
int add_unlit(Scene& scene, double radiance) {
    const int material = add_lambert(scene, glm::dvec3(radiance), glm::dvec3(0.0), true);
    scene.materials[material].unlit = true;
    return material;
}

int add_smooth(Scene& scene, double color, double metallic, double transmission) {
    const int material = add_lambert(scene, glm::dvec3(color), glm::dvec3(0.0), true);
    scene.materials[material].gloss = {.metallic = metallic, .roughness = 0.0};
    scene.materials[material].glass.transmission = transmission;
    return material;
}

TEST(MirrorEstimate, ShowsWhatIsReflected) {
    Scene scene;
    add_sheet(scene, 0.0, add_smooth(scene, metal_color, 1.0, 0.0));
    add_sheet(scene, 4.0, add_unlit(scene, far_radiance));
    EXPECT_NEAR(estimate_below(scene).x, metal_color * far_radiance, 1e-5);
}

/// Not the highlights that its lobe would have beside it.
TEST(MirrorEstimate, ShowsALampOnce) {
    Scene scene;
    add_sheet(scene, 0.0, add_smooth(scene, metal_color, 1.0, 0.0));
    add_lamp(scene, 8.0, glm::dvec3(far_radiance), {0.0, 4.0, 0.0}, z_to_down);
    EXPECT_NEAR(estimate_below(scene).x, metal_color * far_radiance, 1e-5);
}

TEST(MirrorEstimate, ShowsTheSurroundings) {
    Scene scene;
    add_sheet(scene, 0.0, add_smooth(scene, metal_color, 1.0, 0.0));
    scene.environment.radiance = Track<glm::dvec3>{glm::dvec3(far_radiance)};
    EXPECT_NEAR(estimate_below(scene).x, metal_color * far_radiance, 1e-5);
}

TEST(MirrorEstimate, BlendedMirrorsShowBothSides) {
    Scene scene;
    const int mirror = add_smooth(scene, metal_color, 1.0, 0.0);
    scene.materials[mirror].opacity = {.alpha = 0.6, .mode = Opacity::Mode::blend};
    add_sheet(scene, 1.0, mirror);
    add_sheet(scene, 0.0, add_unlit(scene, near_radiance));
    add_sheet(scene, 4.0, add_unlit(scene, far_radiance));
    EXPECT_NEAR(estimate_below(scene).x, 0.4 * near_radiance + 0.6 * metal_color * far_radiance, 1e-5);
}

/// The Lambert layer shows itself, and the gloss above it what is reflected.
TEST(MirrorEstimate, PolishedFloorsReflect) {
    Scene scene;
    add_sheet(scene, 0.0, add_smooth(scene, 0.0, 0.0, 0.0));
    add_sheet(scene, 4.0, add_unlit(scene, far_radiance));
    EXPECT_NEAR(estimate_below(scene).x, dielectric_reflects * far_radiance, 1e-5);
}

/// A ceiling that lights from below reach beside the metal: without it the metal would have the threshold of darkness.
TEST(MirrorEstimate, RoughMetalShowsWhatItReflects) {
    constexpr double irradiance = 3.0, albedo = 0.5;
    const auto estimate_at = [&](double roughness) {
        Scene scene;
        const int metal = add_smooth(scene, metal_color, 1.0, 0.0);
        scene.materials[metal].gloss.roughness = roughness;
        add_mesh(scene, make_quad(1.0, 1.0, metal), {0.0, 0.0, 0.0}, z_to_up);
        add_mesh(scene, make_quad(60.0, 60.0, add_lambert(scene, glm::dvec3(albedo))), {0.0, 4.0, 0.0}, z_to_down);
        const glm::dvec3 upwards = glm::normalize(glm::dvec3(1.0, 1.0, 0.0));
        add_light(scene, Light::Kind::directional, glm::dvec3(irradiance / upwards.y), glm::dvec3(0.0),
                  glm::quatLookAt(upwards, {0.0, 0.0, 1.0}));
        return estimate_below(scene, 1e-3).x;
    };
    const double shown = metal_color * albedo * irradiance / std::numbers::pi;
    EXPECT_NEAR(estimate_at(0.0), shown, 1e-5);
    EXPECT_NEAR(estimate_at(0.3), shown, 0.03 * shown);
    EXPECT_NEAR(estimate_at(0.6), shown, 0.2 * shown);  // microfacets hide each other, and the lobe is a few lines
}

/// By points on lamps or by rays of the lobe, whatever is more likely to find them.
TEST(MirrorEstimate, RoughMetalShowsLampsAndSurroundingsOnce) {
    constexpr double shown = metal_color * far_radiance;
    for (const double roughness : {0.15, 0.3, 0.5}) {
        Scene lamp, surroundings;
        for (Scene* scene : {&lamp, &surroundings}) {
            const int metal = add_smooth(*scene, metal_color, 1.0, 0.0);
            scene->materials[metal].gloss.roughness = roughness;
            add_sheet(*scene, 0.0, metal);
        }
        add_lamp(lamp, 60.0, glm::dvec3(far_radiance), {0.0, 4.0, 0.0}, z_to_down);
        surroundings.environment.radiance = Track<glm::dvec3>{glm::dvec3(far_radiance)};
        EXPECT_NEAR(estimate_below(lamp, 0.02).x, shown, 0.15 * shown) << roughness;
        EXPECT_NEAR(estimate_below(surroundings, 1e-3).x, shown, 0.15 * shown) << roughness;
    }
}

/// Points on lights do not find the surroundings by way of a mirror: what it shows is not weighted against them.
TEST(MirrorEstimate, RoughMetalShowsMirrors) {
    const auto estimate_with = [&](double side) {
        Scene scene;
        const int metal = add_smooth(scene, metal_color, 1.0, 0.0);
        scene.materials[metal].gloss.roughness = 0.9;
        add_mesh(scene, make_quad(1.0, 1.0, metal), {0.0, 0.0, 0.0}, z_to_up);
        const int mirror = add_smooth(scene, 1.0, 1.0, 0.0);
        const glm::dquat sideways = glm::angleAxis(glm::radians(45.0), glm::dvec3(0.0, 0.0, 1.0)) * z_to_down;
        add_mesh(scene, make_quad(side, side, mirror), {0.0, 4.0, 0.0}, sideways);
        scene.environment.radiance = Track<glm::dvec3>{glm::dvec3(far_radiance)};
        return estimate_below(scene, 0.1).x;
    };
    const float shown = estimate_with(1e-3);
    EXPECT_NEAR(estimate_with(60.0), shown, 0.1 * shown);
}

/// A line of sight that has met a mirror keeps what it shows.
TEST(MirrorEstimate, MirrorsAboveRoughMetalAreKept) {
    Scene scene;
    const int mirror = add_smooth(scene, metal_color, 1.0, 0.0), metal = add_smooth(scene, metal_color, 1.0, 0.0);
    scene.materials[mirror].opacity = {.alpha = 0.6, .mode = Opacity::Mode::blend};
    scene.materials[metal].gloss.roughness = 0.3;
    add_sheet(scene, 1.0, mirror);
    add_sheet(scene, 0.0, metal);
    add_sheet(scene, 4.0, add_unlit(scene, far_radiance));
    EXPECT_NEAR(estimate_below(scene).x, 0.6 * metal_color * far_radiance, 1e-5);
}

/// Rooms of metal would cost a line of sight up to 16 surfaces, each eight times.
TEST(MirrorEstimate, OneRoughReflectionIsFollowed) {
    Scene scene;
    const int metal = add_smooth(scene, metal_color, 1.0, 0.0);
    scene.materials[metal].gloss.roughness = 0.3;
    add_sheet(scene, 0.0, metal);
    add_mesh(scene, make_quad(60.0, 60.0, metal), {0.0, 4.0, 0.0}, z_to_down);
    add_camera(scene, {0.0, 3.0, 0.0}, glm::dvec3(0.0));
    const Stage stage(scene, mirror_side, mirror_side);
    RayCounts counts;
    compute_estimate(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), {}, counts);
    constexpr int pixels = mirror_side * mirror_side;
    EXPECT_GT(counts.primary, 0u);
    EXPECT_LE(counts.primary, 2u * pixels * SightLine::spread_lines);
}

/// A flat estimate has no points on lights that would find the rest of the surroundings.
TEST(MirrorEstimate, FlatMetalHasAllOfTheSurroundings) {
    Scene scene;
    const int metal = add_smooth(scene, metal_color, 1.0, 0.0);
    scene.materials[metal].gloss.roughness = 0.3;
    add_sheet(scene, 0.0, metal);
    scene.environment.radiance = Track<glm::dvec3>{glm::dvec3(far_radiance)};
    const EstimateOptions flat{.kind = EstimateKind::flat};
    EXPECT_NEAR(estimate_below(scene, 1e-3, flat).x, metal_color, 0.1 * metal_color);  // surroundings are 1 there
}

/// Light of one bounce is gathered where the mirror shows it.
TEST(MirrorEstimate, NodesLieOnWhatMirrorsShow) {
    Scene scene;
    add_sheet(scene, 0.0, add_smooth(scene, metal_color, 1.0, 0.0));
    add_mesh(scene, make_quad(8.0, 8.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, 4.0, 0.0}, z_to_down);
    add_camera(scene, {0.0, 3.0, 0.0}, glm::dvec3(0.0));
    const Stage stage(scene, 32, 32);
    RayCounts counts;
    EstimateNodes nodes =
        gather_estimate(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), nullptr, counts);
    EXPECT_GT(nodes.node(0, 0).surface.footprint, 0.0f);
    EXPECT_NEAR(nodes.node(0, 0).surface.normal.y, -1.0f, 1e-6f);
    EXPECT_TRUE(nodes.node(0, 0).known);
}

}  // namespace
}  // namespace aleph
