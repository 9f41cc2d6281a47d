// Gathers through panes: what lies behind is gathered as without a pane, and what panes mirror is added.

#include <numbers>

#include "engine/base/sampling.h"
#include "render/cache/gather.h"
#include "render/path/path.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A room in whose middle a sheet stands between the origin and half of the walls.
/// @param ior  of the sheet; 0: there is none
Stage make_divided_room(double ior, const glm::dvec3& color = glm::dvec3(1.0)) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_box({4.0, 3.0, 5.0}, grey));
    add_mesh(scene, make_box({0.5, 2.0, 0.5}, grey), {1.2, -0.5, 0.6});
    add_lamp(scene, 2.0, glm::dvec3(1.0), {0.2, 1.4, 0.0});
    if (ior > 0.0) {
        const int glass = add_lambert(scene, color, glm::dvec3(0.0), true);
        scene.materials[glass].glass.transmission = 1.0;
        scene.materials[glass].gloss = {.metallic = 0.0, .roughness = 0.0, .ior = ior};
        add_mesh(scene, make_quad(5.0, 3.0, glass), {0.5, 0.0, 0.0}, turn_about_y(std::numbers::pi / 2));
    }
    return Stage(std::move(scene));
}

constexpr glm::vec3 middle{0.1f, 0.3f, 0.0f};

IrradianceSample gather_middle(const Stage& stage, std::uint32_t seed, int depth) {
    RayTask task(stage.rays);
    GatherScratch scratch;
    const GatherPattern pattern{choose_strata(256), {seed, 1, 2, 3}};
    const glm::vec3 anchor(stage.shading.anchor);
    return gather_irradiance(stage.lighting(), task, make_point(middle - anchor, {1.0f, 0.0f, 0.0f}), pattern, scratch,
                             {.depth = depth});
}

TEST(ClearSheets, OnesThatMirrorNothingChangeNothing) {
    const Stage open = make_divided_room(0.0), divided = make_divided_room(1.0);
    for (const std::uint32_t seed : {1u, 2u, 3u}) {
        const IrradianceSample expected = gather_middle(open, seed, 4), found = gather_middle(divided, seed, 4);
        EXPECT_NEAR(luminance(found.irradiance), luminance(expected.irradiance),
                    1e-4f * luminance(expected.irradiance));
        EXPECT_NEAR(found.relative_error, expected.relative_error, 0.02f * expected.relative_error);
        EXPECT_NEAR(found.nearest_distance, expected.nearest_distance, 1e-4f);
    }
}

/// A coloured one that mirrors: the mean over gathers against paths that know no gathers.
TEST(ClearSheets, KeepTheMeanOfPaths) {
    const Stage stage = make_divided_room(2.0, {0.8, 0.5, 0.3});
    Mean gathered, followed;
    RayTask task(stage.rays);
    const glm::vec3 anchor(stage.shading.anchor);
    const SurfacePoint point = make_point(middle - anchor, {1.0f, 0.0f, 0.0f});
    for (std::uint32_t seed = 0; seed < 200; ++seed) gathered.add(luminance(gather_middle(stage, seed, 8).irradiance));
    RandomStream random({9, 0, 0, 0});
    for (int i = 0; i < 200'000; ++i) {
        const Ray ray{point.ray_origin(),
                      make_basis(point.normal).to_world(sample_cosine_hemisphere(random.next_2d()))};
        const Rgb light = follow_ray(stage.lighting(), task, ray, start_indirect({0, 8}, Media()), random);
        followed.add(luminance(light) * std::numbers::pi);
    }
    EXPECT_LT(followed.error(), 0.01 * followed.mean());
    EXPECT_NEAR(gathered.mean(), followed.mean(), 4.0 * std::hypot(gathered.error(), followed.error()));
}

}  // namespace
}  // namespace aleph
