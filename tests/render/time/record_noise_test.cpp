// Noise of records: what of it lasts is held to what goes unseen, it is new in each frame elsewhere, and it does not
// decide whether a frame reads lighting keyframes. Channels about the records that light comes from.

#include "render/cache/gather_at.h"
#include "render/cache/irradiance_cache.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 48, height = 36, seeds = 6;
constexpr int block = 4;  // pixels, over which the noise of samples cancels and that of records remains

RenderSettings make_settings(int light_step) {
    RenderSettings settings{.picture = {.width = width, .height = height}};
    follow_error(settings, 1.0);
    settings.cache.light_step = light_step;
    return settings;
}

using BlockNoise = std::vector<Image<double>>;

/// Difference of each seed from the mean of all, in two frames: luminance of blocks as it is shown, white at most, over
/// the noise of single pixels that goes unseen.
std::array<BlockNoise, 2> find_block_noise(const Scene& scene, RenderSettings settings, std::array<int, 2> frames) {
    std::array<BlockNoise, 2> noise;
    for (settings.seed = 1; settings.seed <= seeds; ++settings.seed) {
        Sequence sequence(scene, settings);
        for (std::size_t i = 0; i < frames.size(); ++i) {
            const FrameOutput out = sequence.render(frames[i], {.maps = true, .progress = {}});
            Image<double>& blocks = noise[i].emplace_back(width / block, height / block);
            for (const auto [x, y] : all_pixels(width, height)) {
                const Rgb color = glm::min(out.shaded.color(x, y), Rgb(1.0f));
                const double shown = luminance(color) * scene.film.viewing.display_white;
                blocks(x / block, y / block) += shown / out.limits.threshold_noise(x, y) / (block * block);
            }
        }
    }
    for (BlockNoise& of_seeds : noise) {
        for (std::size_t i = 0; i < of_seeds.front().size(); ++i) {
            double mean = 0.0;
            for (const Image<double>& blocks : of_seeds) mean += blocks.pixels[i] / seeds;
            for (Image<double>& blocks : of_seeds) blocks.pixels[i] -= mean;
        }
    }
    return noise;
}

/// Mean over seeds and blocks, from a row on, of the product of the noise of two frames.
double mean_product(const BlockNoise& a, const BlockNoise& b, int first_row = 0) {
    double sum = 0.0;
    for (int s = 0; s < seeds; ++s) {
        for (int y = first_row; y < height / block; ++y) {
            for (int x = 0; x < width / block; ++x) sum += a[s](x, y) * b[s](x, y);
        }
    }
    return sum / ((seeds - 1) * (height / block - first_row) * (width / block));
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
        const auto [between, at] = find_block_noise(scene, make_settings(10), {4, 10});
        EXPECT_LT(std::sqrt(mean_product(between, between)), 0.11) << "between two";
        EXPECT_LT(std::sqrt(mean_product(at, at)), 0.11) << "at one";
    }
}

/// On one large triangle, as in large pictures, records of different frames lie at the same places (make_place_key).
/// The eye averages their noise if it is new. With uniform samples there are records everywhere, and on the floor no
/// other noise.
TEST(RecordNoise, IsNewInEachFrameWhereAnErrorIsAsked) {
    Scene scene = make_spot_on_wall(make_shot_with_mover());
    scene.meshes[0] = make_quad(600.0, 600.0, 0);
    const auto correlate = [&](const RenderSettings& settings) {
        const auto [a, b] = find_block_noise(scene, settings, {4, 5});
        constexpr int floor = 7;  // row of blocks
        return mean_product(a, b, floor) / std::sqrt(mean_product(a, a, floor) * mean_product(b, b, floor));
    };
    RenderSettings settings = make_settings(0);
    settings.sampling.rule = Sampling::uniform;
    settings.sampling.spp = 4;
    EXPECT_LT(correlate(settings), 0.2);
    settings.error = 0.0;
    EXPECT_GT(correlate(settings), 0.7) << "it lasts";
}

TEST(RecordNoise, OfFurtherBouncesLasts) {
    IndirectStage fill(make_spot_on_wall(make_shot_with_mover()), width, height, 0.15);
    fill.settings.error = 1.0;
    RayTask task(fill.stage.rays);
    GatherScratch scratch;
    const auto gather = [&](int bounces_before, std::uint32_t frame) {
        fill.context.bounces.before = bounces_before;
        fill.context.frame = frame;
        const PixelSurface surface =
            make_pixel_surface(fill.stage.shading, fill.stage.view, fill.centers, width / 2, height - 4);
        return gather_at(fill.context, task, surface, scratch, 64).irradiance;
    };
    EXPECT_GT(gather(1, 4).g, 0.0f);
    EXPECT_EQ(gather(1, 4), gather(1, 5));
    EXPECT_NE(gather(0, 4), gather(0, 5));
}

/// A small box moves in the far corner, and changes no light but there.
TEST(LightingKeyframes, NoiseOfAProbeRejectsNoLight) {
    RenderSettings settings = shot_settings(10);
    settings.cache.gather = 1024;
    const FrameOutput out = Sequence(make_spot_on_wall(make_shot_with_mover()), settings).render(5);
    EXPECT_LT(out.statistics.counts.records, 40u);
}

const FrameRequest everything{.maps = true, .progress = {}};

TEST(RecordMaps, RecordsOfKeyMomentsCountToo) {
    RenderSettings settings = shot_settings(10);
    settings.sampling.spp = 2;
    Sequence sequence(make_shot_with_mover(), settings);
    const ShadedFrame moment = sequence.render(0, everything).shaded, between = sequence.render(3, everything).shaded;
    EXPECT_GT(mean_of(moment.cache_count), 1.0);
    EXPECT_NEAR(mean_of(between.cache_count) / mean_of(moment.cache_count), 2.0, 0.3) << "of two moments";
    EXPECT_NEAR(mean_of(between.cache_radius) / mean_of(moment.cache_radius), 1.0, 0.05);
    for (std::size_t i = 0; i < moment.cache_count.size(); ++i) {
        const bool is_used = moment.cache_count.pixels[i] > 0.0f;
        EXPECT_EQ(moment.cache_radius.pixels[i] > 0.0f, is_used);
        EXPECT_LT(moment.cache_radius.pixels[i], 6.0f) << "m, of a room of 6";
    }
}

TEST(RecordMaps, OnlyOnRequestAndOnlyOfTheCache) {
    RenderSettings settings = shot_settings(0);
    settings.cache.gather = 16;
    EXPECT_TRUE(Sequence(make_shot(), settings).render(0).shaded.cache_count.empty());
    EXPECT_FALSE(Sequence(make_shot(), settings).render(0, everything).shaded.cache_radius.empty());
    settings.light.integrator = Integrator::path;
    EXPECT_TRUE(Sequence(make_shot(), settings).render(0, everything).shaded.cache_count.empty());
}

}  // namespace
}  // namespace aleph
