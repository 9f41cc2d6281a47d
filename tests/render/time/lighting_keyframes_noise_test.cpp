// Noise of records at lighting keyframes: what of it lasts is held to what goes unseen, and none of it decides whether
// a frame reads them.

#include "tests/support/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int block = 4;  // pixels, over which the noise of samples cancels and that of records remains

/// Standard deviation over seeds of the mean of blocks, over that of single pixels which goes unseen: root mean square.
double find_block_noise(const Scene& scene, int light_step, int frame) {
    constexpr int seeds = 6, width = 48, height = 36;
    RenderSettings settings{.picture = {.width = width, .height = height}};
    follow_error(settings, 1.0);
    settings.cache.light_step = light_step;
    Image<double> sums(width / block, height / block), squares = sums;
    for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
        Sequence sequence(scene, settings);
        const FrameOutput out = sequence.render(frame, {.frame = true, .maps = true, .progress = {}});
        Image<double> means(width / block, height / block);
        for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
                const double shown = luminance(out.shaded.color(x, y)) * scene.film.viewing.display_white;
                means(x / block, y / block) += shown / out.limits.threshold_noise(x, y) / (block * block);
            }
        }
        for (std::size_t i = 0; i < means.size(); ++i) {
            sums.pixels[i] += means.pixels[i];
            squares.pixels[i] += means.pixels[i] * means.pixels[i];
        }
    }
    double variance = 0.0;
    for (std::size_t i = 0; i < sums.size(); ++i)
        variance += (squares.pixels[i] - sums.pixels[i] * sums.pixels[i] / seeds) / (seeds - 1);
    return std::sqrt(variance / static_cast<double>(sums.size()));
}

/// Most light comes from a spot on the red wall beside the lamp.
Scene make_spot_on_wall(Scene scene) {
    for (Node& node : scene.nodes) {
        if (node.light >= 0) node.transform.translation = glm::dvec3(-2.9, 2.0, -1.0);
    }
    scene.film.exposure = 1.0;
    return scene;
}

TEST(LightingKeyframes, TheirNoiseGoesUnseenWhereAnErrorIsAsked) {
    for (const Scene& scene :
         {make_spot_on_wall(make_shot_with_moving_camera()), make_spot_on_wall(make_shot_with_mover())}) {
        EXPECT_LT(find_block_noise(scene, 10, 4), 0.11) << "between two";
        EXPECT_LT(find_block_noise(scene, 10, 10), 0.11) << "at one";
    }
}

/// A small box moves in the far corner, and changes no light but there.
TEST(LightingKeyframes, NoiseOfAProbeRejectsNoLight) {
    RenderSettings settings = shot_settings(10);
    settings.cache.gather = 1024;
    const FrameOutput out = Sequence(make_spot_on_wall(make_shot_with_mover()), settings).render(5);
    EXPECT_LT(out.statistics.counts.records, 40u);
}

}  // namespace
}  // namespace aleph
