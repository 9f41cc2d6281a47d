// The vision model on one thread: 640x480, compared with a copy of what it reads and writes, and flat 4K pictures.

#include <benchmark/benchmark.h>

#include <cstring>
#include <vector>

#include "engine/base/parallel.h"
#include "perception/normalize.h"
#include "perception/perception.h"
#include "perception/sanitize.h"
#include "perception/noise_threshold.h"
#include "perception/threshold.h"
#include "tests/support/perception_scene.h"

namespace aleph {
namespace {

const SyntheticFrame& synthetic_frame() {
    static const SyntheticFrame frame = make_synthetic_frame(640, 480);
    return frame;
}

void run_stage(benchmark::State& state, const PerceptionSettings& settings) {
    const ThreadLimit one(1);
    const SyntheticFrame& frame = synthetic_frame();
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            compute_perception(frame.estimate, frame.velocity, {}, {}, settings).aleph.pixels.data());
    }
}

void flat_4k(benchmark::State& state) {
    const ThreadLimit one(1);
    const Image<Rgb> estimate(3840, 2160, Rgb(0.4f, 0.5f, 0.3f));
    const Image<float> velocity(3840, 2160, 8.0f);
    for (auto _ : state) {
        benchmark::DoNotOptimize(compute_perception(estimate, velocity, {}, {}, {}).aleph.pixels.data());
    }
}

/// N(.) of one map with a range above the floor, whose other pixels all tie.
void normalize_flat_4k(benchmark::State& state) {
    Image<float> map(3840, 2160, 1.0f);
    map(1920, 1080) = 0.0f;
    for (auto _ : state) benchmark::DoNotOptimize(compute_normalization(map, 1e-6).weight);
}

void memory_copy(benchmark::State& state) {
    const SyntheticFrame& frame = synthetic_frame();
    Image<Rgb> estimate = frame.estimate;
    Image<float> velocity = frame.velocity, aleph = frame.velocity, saliency = frame.velocity;
    for (auto _ : state) {
        std::memcpy(estimate.pixels.data(), frame.estimate.pixels.data(), estimate.size() * sizeof(Rgb));
        std::memcpy(velocity.pixels.data(), frame.velocity.pixels.data(), velocity.size() * sizeof(float));
        std::memcpy(aleph.pixels.data(), frame.velocity.pixels.data(), aleph.size() * sizeof(float));
        std::memcpy(saliency.pixels.data(), frame.velocity.pixels.data(), saliency.size() * sizeof(float));
        benchmark::ClobberMemory();
    }
}

void sanitize(benchmark::State& state) {
    const ThreadLimit one(1);
    for (auto _ : state) {
        state.PauseTiming();
        Image<Rgb> estimate = synthetic_frame().estimate;
        state.ResumeTiming();
        benchmark::DoNotOptimize(sanitize_estimate(estimate).clamped);
    }
}

void adaptation(benchmark::State& state) {
    const ThreadLimit one(1);
    for (auto _ : state) {
        benchmark::DoNotOptimize(compute_adaptation_luminance(synthetic_frame().estimate, {}).pixels.data());
    }
}

void threshold(benchmark::State& state) {
    const ThreadLimit one(1);
    const Image<float> luminance = compute_adaptation_luminance(synthetic_frame().estimate, {});
    for (auto _ : state) {
        benchmark::DoNotOptimize(compute_threshold(synthetic_frame().velocity, luminance).pixels.data());
    }
}

void threshold_noise(benchmark::State& state) {
    const ThreadLimit one(1);
    const Image<float> luminance = compute_adaptation_luminance(synthetic_frame().estimate, {});
    const NoiseVisibility noise({}, {}, NoiseOverTime::fresh);
    const Image<float>& velocity = synthetic_frame().velocity;
    for (auto _ : state)
        benchmark::DoNotOptimize(compute_noise_threshold(noise, luminance, velocity, velocity).pixels.data());
}

BENCHMARK_CAPTURE(run_stage, saliency_full, PerceptionSettings{})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_stage, saliency_center, PerceptionSettings{.grid = SaliencyGrid::center})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_stage, full, PerceptionSettings{.guide = Guide::full})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_stage, spatial, PerceptionSettings{.guide = Guide::spatial})->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_stage, saliency_full_castle, PerceptionSettings{.vision = &castle_vision()})
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(run_stage, full_castle, PerceptionSettings{.guide = Guide::full, .vision = &castle_vision()})
    ->Unit(benchmark::kMillisecond);
BENCHMARK(flat_4k)->Unit(benchmark::kMillisecond);
BENCHMARK(normalize_flat_4k)->Unit(benchmark::kMillisecond);
BENCHMARK(memory_copy)->Unit(benchmark::kMillisecond);
BENCHMARK(sanitize)->Unit(benchmark::kMillisecond);
BENCHMARK(adaptation)->Unit(benchmark::kMillisecond);
BENCHMARK(threshold)->Unit(benchmark::kMillisecond);
BENCHMARK(threshold_noise)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace aleph

BENCHMARK_MAIN();
