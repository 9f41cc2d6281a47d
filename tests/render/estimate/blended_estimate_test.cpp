// The quick estimate through blended surfaces: those before lamps, and those before the camera.

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

/// A floor below a lamp, from straight above.
Scene make_floor(double camera_height) {
    Scene scene;
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(floor_albedo))), glm::dvec3(0.0), z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(intensity), {0.0, lamp_height, 0.0});
    add_camera(scene, {0.0, camera_height, 0.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.4;
    return scene;
}

/// @param share  of the floor's light that reaches the camera
/// @param added  radiance, by what is before the floor
void expect_floor(const Scene& scene, double share, double added = 0.0) {
    const Stage stage(scene, estimate_side, estimate_side);
    RayCounts counts;
    const Image<Rgb> seen =
        compute_estimate(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), {}, counts);
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

}  // namespace
}  // namespace aleph
