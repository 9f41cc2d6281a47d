// Indirect light of the quick estimate, carried from lighting keyframes to the frames between them.
// Which frames are lighting keyframes, and which views they are computed for.

#include "render/time/keyframe_light.h"
#include "render/time/lighting_keyframes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

const FrameRequest only_maps{.frame = false, .maps = true, .progress = {}};

RenderSettings estimate_settings(int light_step) {
    RenderSettings settings = shot_settings(light_step);
    set_size(settings, 96, 72);
    return settings;
}

/// Walls, floor and lamp move together, so the light rides with the surfaces.
Scene make_riding_shot() {
    Scene scene = make_shot();
    Node wagon{.transform = {.translation = move_between({1.5, 0.0, 0.0}, {-4.5, 0.0, 0.0})}};
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
            const FrameOutput both = pictures.render(frame, {.maps = true, .progress = {}});
            EXPECT_TRUE(maps.estimate.pixels == both.estimate.pixels) << step << " " << frame;
            EXPECT_TRUE(maps.limits.alpha.pixels == both.limits.alpha.pixels) << step << " " << frame;
        }
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

using Views = std::vector<std::int64_t>;

TEST(KeyframeFrames, EveryStepOfTheRange) {
    const LightingKeyframes keyframes{{-5, 30}, {}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, -5), (KeyframePair{-5, -5, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, -4), (KeyframePair{-5, 5, 0.1}));
    EXPECT_EQ(find_keyframes(keyframes, 5), (KeyframePair{5, 5, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 14), (KeyframePair{5, 15, 0.9}));
    EXPECT_EQ(find_keyframes(keyframes, 26), (KeyframePair{25, 30, 0.2})) << "the range's last frame";
    EXPECT_EQ(find_keyframes(keyframes, 30), (KeyframePair{30, 30, 0.0}));
}

TEST(KeyframeFrames, FramesOutsideTheRangeToo) {
    const LightingKeyframes keyframes{{0, 4}, {}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, 2), (KeyframePair{0, 4, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, 7), (KeyframePair{4, 10, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, -1), (KeyframePair{-10, 0, 0.9}));
    EXPECT_EQ(find_keyframes(keyframes, -23), (KeyframePair{-30, -20, 0.7}));
}

TEST(KeyframeFrames, BothSidesOfACut) {
    const LightingKeyframes keyframes{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_keyframes(keyframes, 12).after, 13);
    EXPECT_EQ(find_keyframes(keyframes, 13), (KeyframePair{13, 13, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 14), (KeyframePair{14, 14, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 17), (KeyframePair{14, 20, 0.5}));
}

TEST(KeyframeFrames, ViewsDoNotCrossCutsOrEnds) {
    const LightingKeyframes keyframes{{0, 40}, {14}, 10, {}};
    EXPECT_EQ(find_keyframe_views(keyframes, 0), (Views{0, 10}));
    EXPECT_EQ(find_keyframe_views(keyframes, 10), (Views{10, 0, 13}));
    EXPECT_EQ(find_keyframe_views(keyframes, 13), (Views{13, 10}));
    EXPECT_EQ(find_keyframe_views(keyframes, 14), (Views{14, 20}));
    EXPECT_EQ(find_keyframe_views(keyframes, 40), (Views{40, 30}));
    EXPECT_EQ(find_keyframe_views(keyframes, 50), (Views{50, 40, 60}));
    EXPECT_EQ(find_keyframe_views({{0, 0}, {}, 10, {}}, 0), (Views{0}));
}

TEST(KeyframeFrames, BothSidesOfAJump) {
    const auto find_breaks = [](std::int64_t first, std::int64_t last) {
        return first < 14 && last >= 14 ? Views{14} : Views{};
    };
    const LightingKeyframes keyframes{{0, 40}, {}, 10, find_breaks};
    EXPECT_EQ(find_keyframes(keyframes, 12).after, 13);
    EXPECT_EQ(find_keyframes(keyframes, 13), (KeyframePair{13, 13, 0.0}));
    EXPECT_EQ(find_keyframes(keyframes, 17), (KeyframePair{14, 20, 0.5}));
    EXPECT_EQ(find_keyframes(keyframes, 27), (KeyframePair{20, 30, 0.7}));
    EXPECT_EQ(find_keyframe_views(keyframes, 14), (Views{14, 13, 20})) << "the camera is the same";
}

TEST(KeyframeFrames, EveryFrameForAStepOfOne) {
    const LightingKeyframes keyframes{{0, 9}, {}, 1, {}};
    for (int frame = -2; frame < 12; ++frame) {
        EXPECT_EQ(find_keyframes(keyframes, frame), (KeyframePair{frame, frame, 0.0}));
    }
}

TEST(KeyframeFrames, BaseMomentsAreInTheMiddleOfAboutTenSteps) {
    const LightingKeyframes keyframes{{0, 249}, {170}, 10, {}};
    for (const int keyframe : {0, 40, 80}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 40) << keyframe;
    for (const int keyframe : {90, 130, 160, 169}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 120) << keyframe;
    for (const int keyframe : {170, 210, 249, 300}) EXPECT_EQ(find_base_keyframe(keyframes, keyframe), 210) << keyframe;
    EXPECT_EQ(find_base_keyframe({{0, 3}, {}, 10, {}}, 3), 0);
    EXPECT_EQ(find_base_keyframe({{7, 7}, {}, 10, {}}, 7), 7);
}

TEST(KeyframeFrames, ABaseMomentIsItsOwn) {
    const LightingKeyframes keyframes{{-1000000000, 1000000000}, {-7, 3, 55, 77, 900}, 7, {}};
    for (std::int64_t frame = -3000; frame < 3000; frame += 13) {
        const std::int64_t keyframe = find_keyframes(keyframes, frame).before,
                           base = find_base_keyframe(keyframes, keyframe);
        EXPECT_EQ(find_keyframes(keyframes, base).before, base);
        EXPECT_EQ(find_keyframes(keyframes, base).after, base);
        EXPECT_EQ(find_base_keyframe(keyframes, base), base);
    }
}

}  // namespace
}  // namespace aleph
