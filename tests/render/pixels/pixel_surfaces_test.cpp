// Samples of pixels: before blended surfaces, and over a lens.

#include "render/pixels/pixel_surfaces.h"

#include "tests/support/all_pixels.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(PixelSurfaces, BlendedSurfacesTakeTheirShareOfThePixelsSamples) {
    constexpr int sheets = 3, side = 8;
    Scene scene;
    const int half = add_lambert(scene, glm::dvec3(0.5));
    scene.materials[half].opacity = {.alpha = 0.5, .mode = Opacity::Mode::blend};
    for (int sheet = 0; sheet < sheets; ++sheet) add_mesh(scene, make_quad(9.0, 9.0, half), {0.0, 0.0, -2.0 - sheet});
    add_mesh(scene, make_quad(9.0, 9.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, 0.0, -6.0});
    const Stage stage(std::move(scene), side, side);
    RenderSettings settings = plain_settings(0.0, 1);
    settings.sampling.spp = 64;
    for (const double radius : {0.0, 0.01}) {
        Image<std::array<int, sheets + 1>> counts(side, side, {});
        for (int i = 0; i < settings.sampling.spp; ++i) {
            const SamplePlace place = make_sample_place(settings, {.radius = radius}, true, 0, i);
            const SampleHits sample = cast_sample(stage.rays, stage.view, place, nullptr);
            for (const auto [x, y] : all_pixels(side, side)) ++counts(x, y).at(sample.hits(x, y).instance);
        }
        for (const auto& pixel : counts.pixels) EXPECT_EQ(pixel, (std::array{32, 16, 8, 8}));
    }
}

TEST(PixelSurfaces, SquaresBecomeCirclesOnALens) {
    Scene scene;
    add_camera(scene, {1.0, 2.0, 3.0}, {0.0, 0.5, -1.0});
    const Stage stage(std::move(scene), 16, 12);
    const CameraView& view = stage.view;
    const Lens lens{.radius = 2.0, .focus_distance = 10.0};
    const double half = 1.0 / std::numbers::sqrt2, eighth = std::numbers::pi / 8.0;
    const std::pair<glm::vec2, glm::dvec2> places[] = {{{0.5f, 0.5f}, {0.0, 0.0}},
                                                       {{1.0f, 0.5f}, {1.0, 0.0}},
                                                       {{0.0f, 0.5f}, {-1.0, 0.0}},
                                                       {{0.5f, 1.0f}, {0.0, 1.0}},
                                                       {{1.0f, 1.0f}, {half, half}},
                                                       {{0.75f, 0.25f}, {0.5 * half, -0.5 * half}},
                                                       {{1.0f, 0.75f}, {std::cos(eighth), std::sin(eighth)}},
                                                       {{0.75f, 1.0f}, {std::sin(eighth), std::cos(eighth)}}};
    const CameraRay middle = make_camera_ray(view, 3.0, 9.0);
    const auto focus_of = [&](const CameraRay& ray) {
        const double along = -glm::dot(ray.direction, view.axes[2]);
        return ray.origin + ray.direction * (10.0 / along);
    };
    for (const auto& [u, at] : places) {
        const CameraRay ray = make_lens_ray(view, lens, {3.0, 9.0}, u);
        expect_near(ray.origin, view.position + 2.0 * (view.axes[0] * at.x + view.axes[1] * at.y), 1e-9);
        expect_near(focus_of(ray), focus_of(middle), 1e-9);
    }
}

}  // namespace
}  // namespace aleph
