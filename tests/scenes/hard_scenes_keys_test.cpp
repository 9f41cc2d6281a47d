// The scenes of scenes/hard about keys and transforms look and move as scenes/hard/README.md expects.

#include "tests/scenes/hard_scenes.h"

namespace aleph {
namespace {

TEST(HardScenes, KF17_MirroredScaleKeepsItsLight) {
    HardScene hard("mirrored");
    Scene straight = hard.scene;
    Node& thing = straight.nodes[hard.node("thing")];
    thing.transform.scale =
        glm::dvec3(1.0);  // unmirrored and turned the other way: this gives the mirror image of the picture
    thing.transform.axis_rotation->angle = Track<double>(-20.0 * pi / 180.0);
    RenderSettings settings = small_settings();
    settings.light.light_samples = 256;
    settings.cache.gather = 1024;
    Sequence mirrored(hard.scene, settings), sequence(straight, settings);
    const Image<Rgb> picture = mirrored.render(0).shaded.color, other = sequence.render(0).shaded.color;
    double sum = 0.0, difference = 0.0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            const double a = luminance(picture(x, y)), b = luminance(other(picture.width - 1 - x, y));
            sum += a;
            difference += std::abs(a - b);
        }
    }
    EXPECT_GT(sum, 1.0);
    EXPECT_LT(difference / sum, 0.03);  // noise
}
TEST(HardScenes, KF18_FlattenedIsLeftOut) {
    HardScene hard("flattened");
    const FrameOutput output = hard.render(0);
    EXPECT_TRUE(hard.pixels_on(output, "thing").empty());
    EXPECT_TRUE(hard.pixels_on(output, "gone").empty());
    EXPECT_GT(mean_luminance(output.shaded.color), 0.01);
}
/// A box of any size scaled to 1 m: the picture of a box of 1 m.
TEST(HardScenes, KF19_TinyAndHugeScalesLookLikeABox) {
    HardScene hard("tiny_scale");
    const auto render = [&](double size) {
        Scene scene = hard.scene;
        Node& thing = scene.nodes[hard.node("thing")];
        for (glm::vec3& p : scene.meshes[thing.meshes.front()].positions) p = glm::vec3(glm::dvec3(p) * (size / 1e8));
        thing.transform.scale = glm::dvec3(1.0 / size);
        return render_hard(scene, 0);
    };
    const FrameOutput expected = render(1.0);
    const std::vector<std::size_t> pixels = hard.pixels_on(expected, "thing");
    ASSERT_GT(pixels.size(), 50u);
    for (const double size : {1e-8, 1e-4, 1e4, 1e8}) {
        SCOPED_TRACE(size);
        const FrameOutput found = render(size);
        ASSERT_EQ(hard.pixels_on(found, "thing"), pixels);
        double error = 0.0;
        for (const std::size_t i : pixels) {
            EXPECT_NEAR(found.surface.depth.pixels[i], expected.surface.depth.pixels[i], 1e-5);
            EXPECT_LT(glm::length(found.surface.normal.pixels[i] - expected.surface.normal.pixels[i]), 1e-5f);
            error += luminance(found.shaded.color.pixels[i]) - luminance(expected.shaded.color.pixels[i]);
        }
        EXPECT_NEAR(error / static_cast<double>(pixels.size()), 0.0, 0.01 * mean_luminance(expected.shaded.color));
    }
}
TEST(HardScenes, KF20_ScaleThroughZeroHasNoMotionThere) {
    HardScene hard("scale_through_zero");
    EXPECT_TRUE(hard.pixels_on(hard.render(1), "thing").empty());
    EXPECT_FALSE(hard.pixels_on(hard.render(0), "thing").empty());
    EXPECT_FALSE(hard.pixels_on(hard.render(2), "thing").empty());
}
TEST(HardScenes, KF25_RP02_FarAwayMovesAsNear) {
    HardScene hard("far_away");
    Scene near = hard.scene;
    for (Node& node : near.nodes)
        for (glm::dvec3& key : node.transform.translation.values) key -= glm::dvec3(1e6, 0.0, -1e6);
    const FrameOutput far_frame = hard.render(0);
    const FrameOutput near_frame = render_hard(near, 0);
    std::size_t compared = 0;
    for (std::size_t i = 0; i < far_frame.hits.size(); ++i) {
        if (far_frame.hits.pixels[i].instance != near_frame.hits.pixels[i].instance) continue;  // an edge
        ++compared;
        const glm::dvec2 d = far_frame.motion.displacement.pixels[i] - near_frame.motion.displacement.pixels[i];
        ASSERT_LT(glm::length(d), 1e-6);
    }
    EXPECT_GT(compared, far_frame.hits.size() * 99 / 100);
    EXPECT_GT(longest_motion(far_frame), 0.5);
}
TEST(HardScenes, KF26_NormalsOfShearedFaces) {
    HardScene hard("squeezed_parent");
    const FrameOutput output = hard.render(0);
    const glm::dmat3 linear(hard.world("thing", 0));
    for (const std::size_t i : hard.seen_on(output, "thing")) {
        // Perpendicular to two edges of the box in world space.
        int perpendicular = 0;
        for (int axis = 0; axis < 3; ++axis)
            if (std::abs(glm::dot(glm::normalize(linear[axis]), glm::dvec3(output.surface.normal.pixels[i]))) < 1e-6)
                ++perpendicular;
        EXPECT_EQ(perpendicular, 2);
    }
}
TEST(HardScenes, KF27_LookingDownSeesTheBox) {
    HardScene hard("looking_down");
    const FrameOutput output = hard.render(0);
    EXPECT_NEAR(output.surface.normal(24, 18).y, 1.0, 1e-6);
    EXPECT_NEAR(output.surface.depth(24, 18), 3.0, 1e-5);
}

}  // namespace
}  // namespace aleph
