// Samples of pixels before blended surfaces.

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

}  // namespace
}  // namespace aleph
