// Cameras in a medium whose rays do not all begin in it.

#include <numeric>

#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// To the right of x = 0, up to 1 m before the camera, is a medium that halves light in a metre and does not refract
/// it; behind it a wall of radiance 1. The camera is 5 cm inside.
Scene make_half_medium(const Camera& camera) {
    Scene scene;
    scene.film.exposure = 1.0;
    Material medium{.name = "medium", .base_color = glm::dvec3(1.0)};
    medium.gloss = {.roughness = 0.0, .specular = 0.0, .ior = 1.0};
    medium.glass.transmission = medium.glass.thickness = medium.glass.attenuation_distance = 1.0;
    medium.glass.attenuation_color = glm::dvec3(0.5);
    scene.materials.push_back(medium);
    add_mesh(scene, make_box(glm::dvec3(2.0), 0), {1.0, 0.0, 0.0});
    add_lamp(scene, 40.0, glm::dvec3(1.0), {0.0, 0.0, -5.0}, no_turn);
    add_camera(scene, {0.05, 0.0, 0.0}, {0.05, 0.0, -1.0});
    scene.cameras[0] = camera;
    return scene;
}

FrameOutput render_with(const Scene& scene, Integrator integrator, int width, int spp) {
    RenderSettings settings = quick_settings(width, 6);
    settings.light.integrator = integrator;
    settings.sampling.spp = spp;
    return Sequence(scene, settings).render(0);
}

TEST(MediaBefore, RaysOfAnOrthographicViewBeginInTheirOwn) {
    const Scene scene = make_half_medium({.orthographic = true, .half_height = 0.3});
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        const FrameOutput frame = render_with(scene, integrator, 12, 4);
        for (int x = 0; x < 12; ++x) {
            const double at = 0.05 + (x + 0.5 - 6.0) * 0.1;  // m
            if (std::abs(at) < 0.15) continue;               // the filter is 3 pixels wide and mixes both
            EXPECT_NEAR(frame.shaded.color(x, 3).x, at < 0.0 ? 1.0 : 0.5, 1e-3) << x;
        }
        EXPECT_EQ(frame.statistics.counts.rays.total(), frame.statistics.traced.all);
    }
}

TEST(MediaBefore, TheQuickEstimateOfAnOrthographicViewHasItsOwnToo) {
    const FrameRequest maps_only{.frame = false, .maps = true, .progress = {}};
    const Scene scene = make_half_medium({.orthographic = true, .half_height = 0.3});
    const Image<Rgb> estimate = Sequence(scene, quick_settings(12, 6)).render(0, maps_only).estimate;
    for (int x = 0; x < 12; ++x)
        EXPECT_NEAR(estimate(x, 3).x, 0.05 + (x + 0.5 - 6.0) * 0.1 < 0.0 ? 1.0 : 0.5, 1e-3) << x;
}

TEST(MediaBefore, RaysFromALensBeginInTheirOwn) {
    const Scene scene = make_half_medium({.fov = 1e-4, .aperture = 0.2, .focus_distance = 1e4});  // nearly parallel
    constexpr double h = 0.05 / 0.2;  // the surface's distance from the lens's centre, of its radius
    const double inside = 0.5 + (h * std::sqrt(1.0 - h * h) + std::asin(h)) / std::numbers::pi;
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        const std::vector<Rgb> pixels = render_with(scene, integrator, 6, 64).shaded.color.pixels;
        const float sum = std::transform_reduce(pixels.begin(), pixels.end(), 0.0f, std::plus<>(),
                                                [](const Rgb& pixel) { return pixel.x; });
        EXPECT_NEAR(sum / static_cast<float>(pixels.size()), 1.0 - 0.5 * inside, 2e-3);
    }
}

}  // namespace
}  // namespace aleph
