// The quick estimate through blended surfaces and glass: those before lamps, and those before the camera.

#include "render/estimate/estimate.h"
#include "tests/support/all_pixels.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double lamp_height = 2.0, floor_albedo = 0.6, intensity = 2.0;  // m; cd
constexpr int estimate_side = 8;

int add_blended(Scene& scene, double alpha, const glm::dvec3& emission = glm::dvec3(0.0)) {
    const int material = add_lambert(scene, glm::dvec3(0.0), emission);
    scene.materials[material].opacity = {.alpha = alpha, .mode = Opacity::Mode::blend};
    return material;
}

/// Below a lamp, seen from straight above.
void add_floor(Scene& scene, double camera_height) {
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(floor_albedo))), glm::dvec3(0.0), z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(intensity), {0.0, lamp_height, 0.0});
    add_camera(scene, {0.0, camera_height, 0.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.4;
}

Scene make_floor(double camera_height) {
    Scene scene;
    add_floor(scene, camera_height);
    return scene;
}

Image<Rgb> estimate_floor(const Scene& scene) {
    const Stage stage(scene, estimate_side, estimate_side);
    RayCounts counts;
    return compute_estimate(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), {}, counts);
}

/// @param share  of the floor's light that reaches the camera
/// @param added  radiance, by what is before the floor
void expect_floor(const Scene& scene, double share, double added = 0.0) {
    const Image<Rgb> seen = estimate_floor(scene);
    for (const auto [x, y] : all_pixels(estimate_side, estimate_side)) {
        const double pixel = 0.8 / estimate_side;
        const glm::dvec2 at((x + 0.5) * pixel - 0.4, (y + 0.5) * pixel - 0.4);
        const double square = glm::dot(at, at) + lamp_height * lamp_height;
        const double light = floor_albedo / pi * intensity * lamp_height / (square * std::sqrt(square));
        EXPECT_NEAR(luminance(seen(x, y)), share * light + added, 1e-4 * light) << x << ", " << y;
    }
}

TEST(BlendedEstimate, LampsShineThroughByTheirShare) {
    for (const double alpha : {0.3, 0.5, 0.8}) {
        SCOPED_TRACE(alpha);
        Scene scene = make_floor(0.9);
        add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, alpha)), {0.0, 0.95, 0.0}, z_to_up);
        expect_floor(scene, 1.0 - alpha);
        add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.2)), {0.0, 1.5, 0.0}, z_to_up);
        expect_floor(scene, 0.8 * (1.0 - alpha));
    }
}

TEST(BlendedEstimate, LampsShineThroughBlendedSurfacesAndGlass) {
    Scene scene = make_floor(0.9);
    const int pane = add_lambert(scene, glm::dvec3(1.0), glm::dvec3(0.0), true);
    scene.materials[pane].glass.transmission = 1.0;
    scene.materials[pane].gloss.roughness = 0.0;
    add_mesh(scene, make_quad(20.0, 20.0, pane), {0.0, 1.2, 0.0}, z_to_up);
    expect_floor(scene, 1.0);
    for (const double height : {1.1, 1.6})
        add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.7)), {0.0, height, 0.0}, z_to_up);
    expect_floor(scene, 0.09);
}

TEST(BlendedEstimate, TheCameraSeesBothASurfaceAndWhatIsBehindIt) {
    for (const double alpha : {0.3, 0.5, 0.8}) {
        SCOPED_TRACE(alpha);
        constexpr double glow = 0.05;
        Scene scene = make_floor(1.0);
        add_mesh(scene, make_quad(0.9, 0.9, add_blended(scene, alpha, glm::dvec3(glow))), {0.0, 0.95, 0.0}, z_to_up);
        expect_floor(scene, (1.0 - alpha) * (1.0 - alpha), alpha * glow);
    }
}

TEST(BlendedEstimate, WhatLiesInThePlaneOfABlendedSurfaceIsSeen) {
    Scene scene;
    add_mesh(scene, make_quad(0.9, 0.9, add_blended(scene, 0.3, glm::dvec3(0.05))), glm::dvec3(0.0), z_to_up);
    add_floor(scene, 1.0);
    expect_floor(scene, 0.7, 0.3 * 0.05);
}

/// Clear glass.
/// @param thickness  m; 0: a sheet
int add_glass(Scene& scene, const glm::dvec3& color, double thickness) {
    const int glass = add_lambert(scene, color, glm::dvec3(0.0), true);
    scene.materials[glass].glass.transmission = 1.0;
    scene.materials[glass].glass.thickness = thickness;
    scene.materials[glass].gloss = {.metallic = 0.0, .roughness = 0.0};
    return glass;
}

constexpr double glass_share = 0.96;  // that passes an interface of index 1.5 straight

TEST(BlendedEstimate, TheCameraSeesThroughSheetsOfGlass) {
    for (const double color : {1.0, 0.5}) {
        SCOPED_TRACE(color);
        Scene scene = make_floor(3.0);
        add_mesh(scene, make_quad(2.0, 2.0, add_glass(scene, glm::dvec3(color), 0.0)), {0.0, 2.6, 0.0}, z_to_up);
        expect_floor(scene, color * glass_share);
        add_mesh(scene, make_quad(2.0, 2.0, add_glass(scene, glm::dvec3(1.0), 0.0)), {0.0, 2.5, 0.0}, z_to_up);
        expect_floor(scene, color * glass_share * glass_share);
    }
}

TEST(BlendedEstimate, TheCameraSeesThroughVolumes) {
    constexpr double depth = 0.04, left = 0.5;  // m; share of light that is left after a metre
    Scene scene = make_floor(3.0);
    const int glass = add_glass(scene, glm::dvec3(1.0), depth);
    scene.materials[glass].glass.attenuation_color = glm::dvec3(left);
    scene.materials[glass].glass.attenuation_distance = 1.0;
    add_mesh(scene, make_box({2.0, depth, 2.0}, glass), {0.0, 2.5, 0.0});
    expect_floor(scene, glass_share * glass_share * std::pow(left, depth));
}

TEST(BlendedEstimate, TheCameraSeesThroughRoughGlass) {
    for (const double thickness : {0.0, 0.1}) {
        Scene scene = make_floor(3.0);
        scene.materials[0].unlit = true;
        const int glass = add_glass(scene, glm::dvec3(1.0), thickness);
        scene.materials[glass].gloss.roughness = 0.2;
        add_mesh(scene, thickness > 0.0 ? make_box({4.0, 4.0, thickness}, glass) : make_quad(4.0, 4.0, glass),
                 {0.0, 2.3, 0.0}, z_to_up);
        scene.lights.clear();
        scene.nodes[1].light = no_index;
        const double passed = thickness > 0.0 ? glass_share * glass_share : glass_share;
        for (const Rgb& pixel : estimate_floor(scene).pixels)
            EXPECT_NEAR(luminance(pixel), floor_albedo * passed, 0.01) << thickness;
    }
}

}  // namespace
}  // namespace aleph
