// Indirect light of the quick estimate, carried from lighting keyframes to the frames between them.

#include "render/time/estimate_keyframes.h"

#include <gtest/gtest.h>

#include "tests/support/shot_scenes.h"
#include "tests/support/with_threads.h"

namespace aleph {
namespace {

const FrameRequest only_maps{.frame = false, .maps = true, .progress = {}};

RenderSettings estimate_settings(int light_step) {
    RenderSettings settings = shot_settings(light_step);
    settings.picture.width = 96;
    settings.picture.height = 72;
    return settings;
}

/// Walls, floor and lamp move together, so the light rides with the surfaces.
Scene make_riding_shot() {
    Scene scene = make_shot();
    Node wagon;
    wagon.translation = move_between({1.5, 0.0, 0.0}, {-4.5, 0.0, 0.0});
    scene.nodes.insert(scene.nodes.begin(), wagon);
    for (std::size_t n = 1; n + 1 < scene.nodes.size(); ++n) scene.nodes[n].parent = 0;
    return scene;
}

/// Luminance of the estimate's indirect light: what it has beyond the estimate without bounces.
Image<float> indirect_of(const FrameOutput& output, const Scene& scene, RenderSettings settings, int frame) {
    settings.light.bounces = 0;
    const FrameOutput direct = Sequence(scene, settings).render(frame, only_maps);
    Image<float> light(output.estimate.width, output.estimate.height);
    for (std::size_t i = 0; i < light.size(); ++i)
        light.pixels[i] = luminance(output.estimate.pixels[i]) - luminance(direct.estimate.pixels[i]);
    return light;
}

Image<float> indirect_at(const Scene& scene, const RenderSettings& settings, int frame) {
    return indirect_of(Sequence(scene, settings).render(frame, only_maps), scene, settings, frame);
}

/// The mean of abs(a - b), over the mean of b.
double mean_difference(const Image<float>& a, const Image<float>& b) {
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        difference += std::abs(a.pixels[i] - b.pixels[i]);
        sum += b.pixels[i];
    }
    return difference / sum;
}

/// The largest second difference along a row, relative, of those within one surface: blocks and noise make it large.
double largest_bend(const Image<float>& light, const Image<Hit>& hits) {
    double largest = 0.0;
    for (int y = 0; y < light.height; ++y) {
        for (int x = 1; x + 1 < light.width; ++x) {
            const int here = hits(x, y).instance;
            if (here == no_index || hits(x - 1, y).instance != here || hits(x + 1, y).instance != here) continue;
            const double bend = light(x - 1, y) - 2.0 * light(x, y) + light(x + 1, y);
            largest = std::max(largest, std::abs(bend) / light(x, y));
        }
    }
    return largest;
}

TEST(EstimateKeyframes, FramesBetweenThemGatherNearlyNothing) {
    Sequence own(make_shot_with_moving_camera(), estimate_settings(0));
    const std::uint64_t by_itself = own.render(5, only_maps).statistics.counts.rays.gather;
    Sequence sequence(make_shot_with_moving_camera(), estimate_settings(10));
    const std::uint64_t keyframes = sequence.render(3, only_maps).statistics.counts.rays.gather;
    EXPECT_LT(2 * keyframes, 3 * by_itself) << "the base keyframe, and what it does not know of the other";
    EXPECT_LT(20 * sequence.render(5, only_maps).statistics.counts.rays.gather, by_itself);
    EXPECT_EQ(sequence.render(10, only_maps).statistics.counts.rays.gather, 0u) << "kept";
}

TEST(EstimateKeyframes, TheirLightIsThatOfTheFrame) {
    for (const Scene& scene : {make_shot_with_moving_camera(), make_riding_shot(), make_shot_with_mover()}) {
        const double off =
            mean_difference(indirect_at(scene, estimate_settings(10), 4), indirect_at(scene, estimate_settings(0), 4));
        EXPECT_LT(off, 0.04) << "the noise of 48 rays";
    }
}

/// Half way between a dark and a bright keyframe, but not a jump.
TEST(EstimateKeyframes, TheirLightIsLinearInTime) {
    Scene scene = make_shot();
    scene.lights[0].color.values = {glm::dvec3(4.0), glm::dvec3(12.0)};
    const Image<float> own = indirect_at(scene, estimate_settings(0), 3);
    EXPECT_LT(mean_difference(indirect_at(scene, estimate_settings(10), 3), own), 0.02);
}

TEST(EstimateKeyframes, TheyAddNoDetail) {
    const Scene scene = make_riding_shot();
    const FrameOutput own = Sequence(scene, estimate_settings(0)).render(4, only_maps);
    const FrameOutput carried = Sequence(scene, estimate_settings(10)).render(4, only_maps);
    EXPECT_LT(largest_bend(indirect_of(carried, scene, estimate_settings(10), 4), carried.hits),
              1.2 * largest_bend(indirect_of(own, scene, estimate_settings(0), 4), own.hits));
}

TEST(EstimateKeyframes, MapsAreThoseOfThePicture) {
    const Scene scene = make_riding_shot();
    RenderSettings settings = shot_settings(4);
    settings.perception.guide = Guide::full;
    settings.cache.gather = 16;
    settings.guide.motion = MotionSource::image;
    for (const int step : {1, 4}) {
        settings.cache.light_step = step;
        Sequence pictures(scene, settings);
        for (const int frame : {5, 6, 8}) {
            const FrameOutput maps = Sequence(scene, settings).render(frame, only_maps);
            const FrameOutput both = pictures.render(frame, {.frame = true, .maps = true, .progress = {}});
            EXPECT_TRUE(maps.estimate.pixels == both.estimate.pixels) << step << " " << frame;
            EXPECT_TRUE(maps.alpha.pixels == both.alpha.pixels) << step << " " << frame;
        }
    }
}

TEST(EstimateKeyframes, MapsAreTheSameAloneAndOnAnyThreads) {
    const Scene scene = make_riding_shot();
    Sequence sequence(scene, estimate_settings(4));
    for (const int frame : {2, 3, 4, 7, 13, 1}) {
        const Image<Rgb> together = sequence.render(frame, only_maps).estimate;
        with_threads(3, [&] {
            const Image<Rgb> alone = Sequence(scene, estimate_settings(4)).render(frame, only_maps).estimate;
            EXPECT_TRUE(alone.pixels == together.pixels) << frame;
        });
    }
}

/// Either of a frame and the next may be the base keyframe of the other.
TEST(EstimateKeyframes, ImageMotionFindsTheBaseMomentOfEveryFrame) {
    const Scene scene = make_shot_with_moving_camera();
    RenderSettings settings = shot_settings(1);
    settings.perception.guide = Guide::full;
    settings.guide.motion = MotionSource::image;
    for (const int step : {1, 4}) {
        settings.cache.light_step = step;
        Sequence sequence(scene, settings);
        for (std::int64_t frame = sequence.range().first; frame <= sequence.range().last; ++frame) {
            const FrameOutput alone = Sequence(scene, settings).render(frame, only_maps);
            EXPECT_TRUE(alone.estimate.pixels == sequence.render(frame, only_maps).estimate.pixels) << frame;
        }
    }
}

}  // namespace
}  // namespace aleph
