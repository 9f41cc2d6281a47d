// Speed of pixels that show a thing at rest behind one that moves: errors are seen as well as on the slower.

#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

enum class Sheet { wall, blended, glass, mirror };

/// A sheet that slides by 1 m in a frame before a wall at rest.
Image<float> find_speed_before_wall(Sheet kind, double alpha = 1.0) {
    Scene scene;
    const int sheet = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    Material& material = scene.materials[sheet];
    if (kind == Sheet::glass) {
        material.glass.transmission = 1.0;
        material.gloss = {.metallic = 0.0, .roughness = 0.0};
    }
    if (kind == Sheet::mirror) material.gloss = {.metallic = 1.0, .roughness = 0.0};
    if (kind == Sheet::blended) material.opacity = {.alpha = alpha, .mode = Opacity::Mode::blend};
    add_mesh(scene, make_quad(30.0, 10.0, sheet));
    scene.nodes[0].transform.translation =
        Track<glm::dvec3>({0.0, 1.0 / 30.0}, {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)});
    add_mesh(scene, make_quad(30.0, 10.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, 0.0, -1.0});
    add_camera(scene, {0.0, 0.0, 4.0}, glm::dvec3(0.0));
    const FrameRequest maps_only{.frame = false, .maps = true, .progress = {}};
    return Sequence(std::move(scene), quick_settings(16, 12)).render(0, maps_only).velocity;
}

TEST(SeenThrough, PixelsAreAsFastAsTheSlowestThingThatTheyShow) {
    EXPECT_GT(find_speed_before_wall(Sheet::wall)(8, 6), 1.0f);
    EXPECT_GT(find_speed_before_wall(Sheet::blended, 0.95)(8, 6), 1.0f);  // next to nothing is seen behind it
    for (const double alpha : {0.2, 0.6, 0.8}) EXPECT_EQ(find_speed_before_wall(Sheet::blended, alpha)(8, 6), 0.0f);
    EXPECT_EQ(find_speed_before_wall(Sheet::glass)(8, 6), 0.0f);
    EXPECT_EQ(find_speed_before_wall(Sheet::mirror)(8, 6), 0.0f);  // its picture rests
}

}  // namespace
}  // namespace aleph
