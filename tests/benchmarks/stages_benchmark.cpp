// Cost of motion and perception on one thread at 640x480, relative to casting the frame's first hits in packets, and to
// a plain copy of what each stage reads and writes. Prints a table of ratios. The scene is `pool`.

#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "motion/image_motion.h"
#include "motion/model_motion.h"
#include "motion/reprojection.h"
#include "motion/velocity.h"
#include "perception/noise_threshold.h"
#include "perception/perception.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "tests/benchmarks/raw_embree.h"
#include "tests/support/all_pixels.h"
#include "tests/support/first_hits.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

constexpr int width = 640, height = 480;

/// Everything that the stages read, made once.
struct Inputs {
    Scene scene;
    std::int64_t frame_number = 0;
    PosedView now, next;
    RayScene rays, other_rays;
    Image<Hit> hits;
    MotionField motion;
    Image<float> velocity;
    Image<Rgb> estimate, next_estimate;

    explicit Inputs(Scene from) : scene(std::move(from)), rays(scene), other_rays(rays.share_meshes()) {
        const FrameRange range = frame_range(scene);
        frame_number = range.first + (range.last - range.first) / 4;
        const int camera = CameraNames(scene).find("");
        now = make_posed_view(scene, scene.film.frame_rate.seconds_of(frame_number), camera, width, height);
        next = make_posed_view(scene, scene.film.frame_rate.seconds_of(frame_number + 1), camera, width, height);
        rays.update(now.pose, compute_anchor(now.view));
        other_rays.update(next.pose, compute_anchor(next.view));
        hits = cast_first_hits(rays, now.view);
        motion = compute_motion();
        velocity = compute_image_velocity(motion, {}, {});
        estimate = compute_estimate(hits, now.pose);
        next_estimate = compute_estimate(cast_first_hits(other_rays, next.view), next.pose);
    }
    MotionField compute_motion() const { return compute_model_motion(scene, now, next, hits); }
    /// A checker on every surface, a gradient behind: edges and texture enough for the maps of perception.
    Image<Rgb> compute_estimate(const Image<Hit>& seen, const ScenePose& frame) const {
        Image<Rgb> image(width, height);
        for (const auto [x, y] : all_pixels(width, height)) {
            const Hit& hit = seen(x, y);
            if (hit.instance == no_index) {
                image(x, y) = Rgb(0.3f, 0.4f, 0.6f) * (1.0f - 0.5f * static_cast<float>(y) / height);
                continue;
            }
            const Instance& instance = frame.instances[hit.instance];
            const glm::dvec3 p = surface_point(scene.meshes[instance.mesh], hit);
            const glm::dvec3 cell = glm::floor(8.0 * p + 0.5);
            const bool odd = std::fmod(std::abs(cell.x + cell.y + cell.z), 2.0) > 0.5;
            const float hue = 0.37f * static_cast<float>(hit.instance);
            image(x, y) = (odd ? 0.7f : 0.2f) * Rgb(0.6f + 0.4f * std::sin(hue), 0.6f + 0.4f * std::cos(hue), 0.5f);
        }
        return image;
    }
};

const Inputs& inputs() {
    static const Inputs made(load_scene(source_folder() / "scenes/pool/scene.json"));
    return made;
}

void first_hits(benchmark::State& state) {
    for (auto _ : state) benchmark::DoNotOptimize(cast_first_hits(inputs().rays, inputs().now.view).pixels.data());
}

void raw_embree(benchmark::State& state) {
    const auto& [frame, view] = inputs().now;
    const glm::dvec3 anchor = compute_anchor(view);
    const RawEmbree raw(inputs().scene, frame, anchor);
    std::vector<RawRay> rays;
    for (int i = 0; i < width * height; ++i) {
        const int x = i / 16 * 4 % width + i % 4, y = i / 16 * 4 / width * 4 + i / 4 % 4;  // in blocks of 4 x 4
        const CameraRay ray = make_camera_ray(view, x + 0.5, y + 0.5);
        const glm::vec3 o(ray.origin - anchor), d(ray.direction);
        rays.push_back({{o.x, o.y, o.z, 0.0f, d.x, d.y, d.z, 0.0f, Ray{}.far, ~0u, 0, 0}, false});
    }
    for (auto _ : state) benchmark::DoNotOptimize(raw.trace(rays, RawEmbree::Packets::coherent));
}

void motion(benchmark::State& state) {
    for (auto _ : state) {
        const MotionField field = inputs().compute_motion();
        benchmark::DoNotOptimize(compute_image_velocity(field, {}, {}).pixels.data());
    }
}

void motion_hidden(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        MotionField field = inputs().motion;
        state.ResumeTiming();
        benchmark::DoNotOptimize(mark_hidden(field, inputs().scene, inputs().next, inputs().hits, inputs().other_rays));
    }
}

/// Two frames to a motion field; a sequence makes every pyramid once.
void image_motion(benchmark::State& state) {
    const CensusPyramid next = make_census_pyramid(inputs().next_estimate);
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            compute_image_motion(make_census_pyramid(inputs().estimate), next).validity.pixels.data());
    }
}

void perception(benchmark::State& state, const PerceptionSettings& settings) {
    for (auto _ : state) {
        benchmark::DoNotOptimize(
            compute_perception(inputs().estimate, inputs().velocity, {}, {}, settings).aleph.pixels.data());
    }
}

void sanitize(benchmark::State& state) {
    for (auto _ : state) {
        state.PauseTiming();
        Image<Rgb> estimate = inputs().estimate;
        state.ResumeTiming();
        benchmark::DoNotOptimize(sanitize_estimate(estimate).clamped);
    }
}

void threshold(benchmark::State& state) {
    for (auto _ : state) {
        const Image<float> luminance = compute_adaptation_luminance(inputs().estimate, {});
        benchmark::DoNotOptimize(compute_threshold(inputs().velocity, luminance).pixels.data());
    }
}

void threshold_noise(benchmark::State& state) {
    const Image<float> luminance = compute_adaptation_luminance(inputs().estimate, {});
    const NoiseVisibility noise({}, {}, NoiseOverTime::fresh);
    const Image<float>& velocity = inputs().velocity;
    for (auto _ : state)
        benchmark::DoNotOptimize(
            compute_noise_threshold(noise, inputs().estimate, 100.0, luminance, velocity, velocity).pixels.data());
}

/// Copies each image once: what a stage reads and writes, without its arithmetic.
template <class... Images>
void copy_all(benchmark::State& state, const Images&... images) {
    std::tuple<Images...> targets(images...);
    for (auto _ : state) {
        std::apply(
            [&](Images&... target) {
                (std::memcpy(target.pixels.data(), images.pixels.data(), images.size() * sizeof(images.pixels[0])),
                 ...);
            },
            targets);
        benchmark::ClobberMemory();
    }
}

void copy_motion(benchmark::State& state) {
    const Inputs& in = inputs();
    copy_all(state, in.hits, in.motion.displacement, in.motion.path_length, in.motion.validity, in.velocity);
}

void copy_perception(benchmark::State& state) {
    const Inputs& in = inputs();
    // In: estimate and velocity; out: Aleph map and saliency, floats like the velocity.
    copy_all(state, in.estimate, in.velocity, in.velocity, in.velocity);
}

/// Prints as usual, and keeps each benchmark's best CPU time: other programs may run on the machine.
class BestTimes : public benchmark::ConsoleReporter {
  public:
    void ReportRuns(const std::vector<Run>& runs) override {
        for (const Run& run : runs) {
            if (run.run_type != Run::RT_Iteration) continue;
            const auto [place, is_new] = milliseconds_.try_emplace(run.run_name.function_name, 1e30);
            place->second = std::min(place->second, run.GetAdjustedCPUTime());
        }
        ConsoleReporter::ReportRuns(runs);
    }
    /// Best of all repetitions, ms; 0 where it did not run.
    double operator()(const std::string& name) const {
        const auto found = milliseconds_.find(name);
        return found == milliseconds_.end() ? 0.0 : found->second;
    }

  private:
    std::map<std::string, double> milliseconds_;
};

void print_ratios(const BestTimes& best) {
    const struct {
        const char *stage, *copy;
        double demand;  ///< times first hits; 0: none
    } rows[] = {{"raw_embree", nullptr, 0.0},
                {"first_hits", nullptr, 0.0},
                {"motion", "copy_motion", 1.0},
                {"motion_hidden", nullptr, 0.0},
                {"image_motion", nullptr, 0.0},
                {"perception_full", "copy_perception", 8.0},
                {"perception_center", "copy_perception", 2.0},
                {"perception_spatial", "copy_perception", 0.0},
                {"perception_castle", "copy_perception", 0.0},
                {"sanitize", nullptr, 0.0},
                {"threshold", nullptr, 0.0},
                {"threshold_noise", nullptr, 0.0}};
    fmt::print("\nframe {}, {}x{}, one thread, best CPU time of the repetitions\n", inputs().frame_number, width,
               height);
    fmt::print("{:<20}{:>8}{:>14}{:>10}{:>10}\n", "stage", "ms", "x first hits", "at most", "x memcpy");
    const auto ratio = [](double a, double b) { return a > 0.0 && b > 0.0 ? fmt::format("{:.2f}", a / b) : "-"; };
    for (const auto& row : rows) {
        const double ms = best(row.stage);
        fmt::print("{:<20}{:>8.2f}{:>14}{:>10}{:>10}\n", row.stage, ms, ratio(ms, best("first_hits")),
                   row.demand > 0.0 ? fmt::format("{:g}", row.demand) : "-",
                   row.copy != nullptr ? ratio(ms, best(row.copy)) : "-");
    }
}

void add(const char* name, const std::function<void(benchmark::State&)>& run) {
    benchmark::RegisterBenchmark(name, run)->Unit(benchmark::kMillisecond)->Repetitions(9)->Iterations(5);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    using namespace aleph;
    const ThreadLimit one(1);
    // Repetitions of different stages take turns, so that a disturbance does not hit one stage alone.
    std::vector<char*> arguments(argv, argv + argc);
    std::string interleaving = "--benchmark_enable_random_interleaving=true";
    arguments.insert(arguments.begin() + 1, interleaving.data());
    int count = static_cast<int>(arguments.size());
    benchmark::Initialize(&count, arguments.data());

    add("raw_embree", raw_embree);
    add("first_hits", first_hits);
    add("motion", motion);
    add("motion_hidden", motion_hidden);
    add("image_motion", image_motion);
    add("perception_full", [](auto& state) { perception(state, {.grid = SaliencyGrid::full}); });
    add("perception_center", [](auto& state) { perception(state, {.grid = SaliencyGrid::center}); });
    add("perception_spatial", [](auto& state) { perception(state, {.guide = Guide::spatial}); });
    add("perception_castle", [](auto& state) { perception(state, {.vision = &castle_vision()}); });
    add("sanitize", sanitize);
    add("threshold", threshold);
    add("threshold_noise", threshold_noise);
    add("copy_motion", copy_motion);
    add("copy_perception", copy_perception);
    BestTimes best;
    benchmark::RunSpecifiedBenchmarks(&best);
    print_ratios(best);
}
