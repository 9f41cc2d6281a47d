// Pyramids, N(.) and saliency of images for which simple code gives NaN, noise or one bright pixel.

#include "engine/base/pyramid.h"
#include "engine/base/sampling.h"
#include "perception/band_response.h"
#include "perception/perception.h"
#include "perception/saliency/feature_maps.h"
#include "perception/sanitize.h"
#include "tests/support/scenes/perception_scene.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

PerceptionMaps with_everything(const Image<Rgb>& estimate, const Image<float>& velocity) {
    return compute_perception(estimate, velocity, {}, {}, {}, {true, true});
}

/// No feature differs: S = .82 everywhere, every conspicuity 0, v_R as (3.1) has it.
void expect_fallback(const Image<Rgb>& estimate, const Image<float>& velocity) {
    const PerceptionMaps maps = with_everything(estimate, velocity);
    EXPECT_TRUE(maps.fallback);
    for (const Image<float>* map : {&maps.conspicuity_intensity, &maps.conspicuity_color, &maps.conspicuity_orientation,
                                    &maps.conspicuity_motion})
        EXPECT_TRUE(std::ranges::all_of(map->pixels, [](float v) { return v == 0.0f; }));
    for (std::size_t i = 0; i < velocity.size(); ++i) {
        ASSERT_EQ(maps.saliency.pixels[i], 0.82f);
        const double v = velocity.pixels[i];
        ASSERT_NEAR(maps.retinal_velocity.pixels[i], std::max(0.15, v - std::min(0.82 * v + 0.15, 80.0)), 1e-5);
    }
}

TEST(PyramidHard, PY01_UniformImage) {
    for (const float grey : {0.0f, 1e-30f, 0.5f, 1e6f})
        expect_fallback(Image<Rgb>(70, 50, Rgb(grey)), Image<float>(70, 50, 3.0f));
}

TEST(PyramidHard, PY02_BorderGivesNoEdge) {
    for (const float value : {0.3f, 1.0f, 1e6f}) {
        const auto levels = make_gaussian_pyramid(Image<float>(131, 77, value), 9);
        const auto sizes = pyramid_sizes(131, 77, 9);
        Image<float> finer = levels[0];
        for (int level = 1; level < 9; ++level) {
            const Image<float> full = expand_to_level(levels[level], sizes, level, 0);
            for (std::size_t i = 0; i < full.size(); ++i) {
                ASSERT_NEAR(full.pixels[i], finer.pixels[i], 5e-7 * value) << level;
            }
            finer = full;
        }
    }
}

TEST(PyramidHard, PY03_EverySizeRuns) {
    const std::pair<int, int> sizes[] = {{1, 1}, {1, 640},   {640, 1},   {3, 5},    {17, 1},
                                         {2, 2}, {511, 333}, {512, 512}, {8192, 1}, {5, 300}};
    for (const auto& [width, height] : sizes) {
        const SyntheticFrame frame = make_synthetic_frame(width, height);
        for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
            const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {}, {.grid = grid});
            ASSERT_TRUE(same_size(maps.aleph, frame.velocity));
            for (std::size_t i = 0; i < maps.aleph.size(); ++i) {
                ASSERT_TRUE(maps.aleph.pixels[i] >= 1.0f && maps.aleph.pixels[i] <= 250.8f) << width << "x" << height;
                ASSERT_TRUE(maps.saliency.pixels[i] >= 0.0f && maps.saliency.pixels[i] <= 1.0f);
            }
            // Buffers keep nothing of other sizes.
            EXPECT_EQ(compute_perception(frame.estimate, frame.velocity, {}, {}, {.grid = grid}).aleph, maps.aleph);
        }
    }
    const auto single = compute_band_response(Image<float>(1, 1, 0.7f));
    for (int i = 0; i < band_count; ++i) EXPECT_EQ(single[i](0, 0), i == 6 ? 1.0f : 0.0f);
}

TEST(PyramidHard, PY04_LevelsDoNotDrift) {
    for (const int size : {500, 512, 333}) {
        const double cx = size / 2 + 0.3, cy = size / 2 - 0.4;
        Image<float> blob(size, size);
        for (int y = 0; y < size; ++y) {
            for (int x = 0; x < size; ++x) {
                blob(x, y) = static_cast<float>(std::exp(-((x - cx) * (x - cx) + (y - cy) * (y - cy)) / 18.0));
            }
        }
        const auto levels = make_gaussian_pyramid(blob, 6);
        const auto sizes = pyramid_sizes(size, size, 6);
        for (int level = 0; level < 6; ++level) {
            const Image<float> full = expand_to_level(levels[level], sizes, level, 0);
            double sum = 0, sx = 0, sy = 0;
            for (int y = 0; y < size; ++y) {
                for (int x = 0; x < size; ++x) sum += full(x, y), sx += x * full(x, y), sy += y * full(x, y);
            }
            EXPECT_NEAR(sx / sum, cx, 0.25) << size << " level " << level;
            EXPECT_NEAR(sy / sum, cy, 0.25) << size << " level " << level;
        }
    }
}

/// A broken pixel must give what the pixel's replacement gives, bit for bit.
void expect_like_replaced(const Rgb& broken) {
    const SyntheticFrame frame = make_synthetic_frame(512, 512);
    Image<Rgb> replaced = frame.estimate, damaged = frame.estimate;
    damaged(200, 300) = broken;
    for (int c = 0; c < 3; ++c) {
        std::vector<float> around;
        for (int dy = -1; dy <= 1; ++dy) {
            for (int dx = -1; dx <= 1; ++dx) {
                if (dx != 0 || dy != 0) around.push_back(frame.estimate(200 + dx, 300 + dy)[c]);
            }
        }
        std::sort(around.begin(), around.end());
        replaced(200, 300)[c] = around[3];
    }
    EXPECT_EQ(sanitize_estimate(damaged).replaced, 1u);
    EXPECT_EQ(sanitize_estimate(replaced).replaced, 0u);
    ASSERT_EQ(damaged, replaced);
    EXPECT_EQ(compute_perception(damaged, frame.velocity, {}, {}, {}).aleph,
              compute_perception(replaced, frame.velocity, {}, {}, {}).aleph);
}

TEST(PyramidHard, PY05_OneNanPixel) {
    expect_like_replaced(Rgb(float_nan, 0.5f, 0.5f));
}

TEST(PyramidHard, PY06_OneInfinitePixel) {
    expect_like_replaced(Rgb(0.1f, float_infinity, 0.1f));
    expect_like_replaced(Rgb(0.1f, 0.1f, -float_infinity));
}

TEST(PyramidHard, PY07_FireflyDoesNotTakeTheWholeMap) {
    const SyntheticFrame frame = make_synthetic_frame(512, 512);
    Image<Rgb> calm = frame.estimate, firefly = frame.estimate;
    firefly(400, 120) = Rgb(1e6f);
    EXPECT_EQ(sanitize_estimate(calm).clamped, 0u);
    EXPECT_EQ(sanitize_estimate(firefly).clamped, 1u);
    const Image<float> expected = compute_perception(calm, frame.velocity, {}, {}, {}).saliency;
    const Image<float> found = compute_perception(firefly, frame.velocity, {}, {}, {}).saliency;
    EXPECT_GT(correlation(found, expected, {400, 120}, 16), 0.9);
}

TEST(PyramidHard, PY11_RoundingNoiseStandsOutNowhere) {
    Image<Rgb> estimate(200, 150);
    RandomStream random({2, 0, 0, 0});
    for (Rgb& c : estimate.pixels) c = Rgb(0.5f + 1e-7f * random.next());
    expect_fallback(estimate, Image<float>(200, 150, 10.0f));
}

TEST(PyramidHard, PY11_MotionUnderAThousandthOfAPixelIsRest) {
    const Image<Rgb> estimate(128, 96, Rgb(0.4f));
    Image<float> velocity(128, 96);
    for (int y = 40; y < 60; ++y) std::fill_n(velocity.row(y) + 40, 30, 0.99e-3f / 31 * 30);
    expect_fallback(estimate, velocity);
    for (int y = 40; y < 60; ++y) std::fill_n(velocity.row(y) + 40, 30, 1.0f);
    EXPECT_FALSE(with_everything(estimate, velocity).fallback);
}

TEST(PyramidHard, PY12_BlackFrameTracksEverything) {
    for (const float velocity : {12.0f, 0.0f}) expect_fallback(Image<Rgb>(90, 60), Image<float>(90, 60, velocity));
}

TEST(PyramidHard, PY13_EverythingEquallySalient) {
    const Image<float> pattern = checker(128, 128);
    Image<Rgb> estimate(128, 128);
    Image<float> velocity(128, 128);
    for (std::size_t i = 0; i < pattern.size(); ++i) {
        estimate.pixels[i] = pattern.pixels[i] > 0 ? Rgb(0.9f, 0.2f, 0.1f) : Rgb(0.1f, 0.3f, 0.8f);
        velocity.pixels[i] = 20 * pattern.pixels[i];
    }
    expect_fallback(estimate, velocity);
}

TEST(PyramidHard, PY14_DenormalFrame) {
    Image<Rgb> estimate(64, 64);
    RandomStream random({4, 0, 0, 0});
    for (Rgb& c : estimate.pixels) c = Rgb(1e-39f * random.next());
    expect_fallback(estimate, Image<float>(64, 64, 5.0f));
}

TEST(PyramidHard, PY16_OrientationsOfFlatAndLines) {
    for (const auto& response : compute_orientations(Image<float>(40, 30, 0.8f))) {
        for (const float v : response.pixels) ASSERT_LE(v, 1e-6f);  // no rings at the border either
    }
    const int size = 41;
    for (std::size_t line = 0; line < orientation_degrees.size(); ++line) {
        Image<float> image(size, size);
        for (int i = 0; i < size; ++i) {
            // The wave vector at 0, 45, 90, 135 degrees (y down) crosses |, /, -, \.
            const int x[] = {size / 2, size - 1 - i, i, i}, y[] = {i, i, size / 2, i};
            image(x[line], y[line]) = 1.0f;
        }
        const auto responses = compute_orientations(image);
        double energy[4] = {};
        for (std::size_t o = 0; o < responses.size(); ++o) {
            for (int v = 10; v < size - 10; ++v) {
                for (int u = 10; u < size - 10; ++u) energy[o] += responses[o](u, v);
            }
        }
        EXPECT_EQ(std::max_element(energy, energy + 4) - energy, static_cast<std::ptrdiff_t>(line));
    }
}

TEST(PyramidHard, PY17_OneAbsurdVelocityDoesNotTakeTheMotionMap) {
    const SyntheticFrame frame = make_synthetic_frame(512, 512);
    for (const float absurd : {1e8f / 31 * 30, float_infinity}) {
        Image<float> velocity = frame.velocity;
        velocity(400, 120) = absurd;
        const PerceptionMaps expected = with_everything(frame.estimate, frame.velocity);
        const PerceptionMaps found = with_everything(frame.estimate, velocity);
        EXPECT_GT(correlation(found.saliency, expected.saliency, {400, 120}, 16), 0.9);
        EXPECT_GT(correlation(found.conspicuity_motion, expected.conspicuity_motion, {400, 120}, 32), 0.9);
    }
}

TEST(PyramidHard, PY18_SixMapsPerPyramidAtEverySize) {
    for (const auto& [width, height] : {std::pair{1, 1}, {2, 1}, {3, 7}, {40, 1}, {300, 200}}) {
        const auto levels = make_gaussian_pyramid(Image<float>(width, height, 0.5f), saliency_levels);
        ASSERT_EQ(levels.size(), 9u);
        const auto maps = make_feature_maps({{width, height}, levels, levels, levels, levels});
        ASSERT_EQ(maps.size(), 48u);
        std::array<int, channel_count> count{};
        for (const FeatureMap& map : maps) {
            ++count[static_cast<std::size_t>(map.channel)];
            EXPECT_TRUE(same_size(map.difference, levels[map.level]));
        }
        EXPECT_EQ(count, (std::array{6, 12, 24, 6}));
    }
}

TEST(PyramidHard, PY19_SaliencyIsWithinZeroAndOneAndReachesBoth) {
    for (std::uint32_t seed = 0; seed < 20; ++seed) {
        const SyntheticFrame frame = make_synthetic_frame(60 + 7 * static_cast<int>(seed), 90, seed);
        for (const SaliencyGrid grid : {SaliencyGrid::full, SaliencyGrid::center}) {
            const PerceptionMaps maps = compute_perception(frame.estimate, frame.velocity, {}, {}, {.grid = grid});
            const auto [low, high] = std::minmax_element(maps.saliency.pixels.begin(), maps.saliency.pixels.end());
            EXPECT_EQ(*low, 0.0f);
            EXPECT_EQ(*high, 1.0f);
            EXPECT_FALSE(maps.fallback);
        }
    }
}

}  // namespace
}  // namespace aleph
