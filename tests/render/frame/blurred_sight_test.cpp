// The quick estimate as an open shutter blurs it, where what it shows at other times is seen through glass, in a medium
// or in a mirror, and is hidden at the shutter's centre.

#include "render/frame/frame_estimate.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int sight_width = 48, sight_height = 32;  // pixels
constexpr double square_way = 2.9;                  // m, while the shutter is open
constexpr double sight_scale = 8.0;                 // pixels per metre
constexpr double square_glow = 0.1, wall_glow = 0.8, interface_share = 0.96;

/// A dim square of 1 m that passes before a bright wall, from left to right through the picture's middle.
Scene make_passing_square() {
    Scene scene;
    add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(square_glow))));
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({0.0, 2.0 / 30.0}, {{-square_way, 0.0, 0.0}, {square_way, 0.0, 0.0}});
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(wall_glow))),
             {0.0, 0.0, -1.0});
    add_flat_view(scene, 0.5 * sight_height / sight_scale, {-0.5, 0.5});
    return scene;
}

/// Clear, smooth and metallic or glass.
int add_clear(Scene& scene, double metallic) {
    const int material = add_lambert(scene, glm::dvec3(1.0), glm::dvec3(0.0), true);
    scene.materials[material].gloss = {.metallic = metallic, .roughness = 0.0};
    scene.materials[material].glass.transmission = 1.0 - metallic;
    return material;
}

/// @param square, wall  radiance that is seen of them
void expect_passing(const Scene& scene, double square, double wall) {
    const Image<Rgb> seen = Sequence(scene, quick_settings(sight_width, sight_height))
                                .render(1, {.frame = false, .maps = true, .progress = {}})
                                .estimate;
    constexpr double half_way = 0.5 * square_way;
    double sum = 0.0, sum_expected = 0.0;
    for (int x = 0; x < sight_width; ++x) {
        const double place = (x + 0.5 - 0.5 * sight_width) / sight_scale;
        const double first = std::max(-half_way, place - 0.5), last = std::min(half_way, place + 0.5);
        const double expected = wall + (square - wall) * std::max(0.0, last - first) / square_way;
        const double found = seen(x, sight_height / 2).x;
        EXPECT_NEAR(found, expected, std::abs(wall - square) / blur_looks + 1e-5) << x;
        sum += found;
        sum_expected += expected;
    }
    EXPECT_NEAR(sum, sum_expected, 0.01 * sum_expected);
}

TEST(BlurredSight, PassesGlass) {
    Scene scene = make_passing_square();
    add_mesh(scene, make_quad(20.0, 20.0, add_clear(scene, 0.0)), {0.0, 0.0, -0.5});
    expect_passing(scene, square_glow, interface_share * wall_glow);
}

TEST(BlurredSight, IsDimmedByTheMediumAroundTheCamera) {
    constexpr double left = 0.9, camera_distance = 5.0;  // of light after a metre; m
    Scene scene = make_passing_square();
    const int fog = add_clear(scene, 0.0);
    scene.materials[fog].glass = {.transmission = 1.0, .thickness = 1.0};
    scene.materials[fog].glass.attenuation_color = glm::dvec3(left);
    scene.materials[fog].glass.attenuation_distance = 1.0;
    add_mesh(scene, make_box(glm::dvec3(50.0), fog));
    expect_passing(scene, square_glow * std::pow(left, camera_distance),
                   wall_glow * std::pow(left, camera_distance + 1.0));
}

TEST(BlurredSight, GoesOnInMirrors) {
    Scene scene = make_passing_square();
    scene.environment.radiance = Track<glm::dvec3>{glm::dvec3(wall_glow)};
    add_mesh(scene, make_quad(20.0, 20.0, add_clear(scene, 1.0)), {0.0, 0.0, -0.5});
    expect_passing(scene, square_glow, wall_glow);
}

}  // namespace
}  // namespace aleph
