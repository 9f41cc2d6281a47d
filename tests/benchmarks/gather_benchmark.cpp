// Gathers against Embree alone: irradiance is gathered at points all over a frame, and Embree traces the gather and
// shadow rays again, without shading, in the fastest of its ways. Other rays are traced in between, so that no ray was
// just traced. All rates are of one thread and of its processor time, and the best of several rounds.
//   bench_gather SCENE [FRAME [WIDTHxHEIGHT [GATHER]]]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <ctime>
#include <string>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "render/gather.h"
#include "render/pixel_surfaces.h"
#include "render/settings.h"
#include "tests/benchmarks/recorded_rays.h"

namespace aleph {
namespace {

constexpr int rounds = 2;
constexpr int across = 24, down = 18;       // points over the frame
constexpr std::size_t points_at_once = 64;  // between two insertions into the direct grid

double processor_seconds(const std::function<void()>& run) {
    const std::clock_t start = std::clock();
    run();
    return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double seconds(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// What gathers need of a frame.
struct Frame {
    Frame(const Scene& scene, std::int64_t number, int width, int height)
        : posed(make_posed_view(scene, scene.frame_rate.seconds_of(number), 0, width, height)),
          textures(make_texture_set(scene)),
          rays(scene),
          shading((rays.update(posed.pose, compute_anchor(posed.view)),
                   make_shading_scene(scene, posed.pose, rays, textures))),
          lights(make_light_set(shading)) {
        const SampleHits centers = cast_centers(rays, posed.view, nullptr);
        for (int y = height / (2 * down); y < height; y += height / down) {
            for (int x = width / (2 * across); x < width; x += width / across) {
                if (centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = make_pixel_surface(shading, posed.view, centers, x, y);
                if (surface.material.has_diffuse()) points.push_back(surface.point);
            }
        }
    }

    /// Gathers at every point. @return the rays cast
    RayCounts gather(const HemisphereStrata& strata, std::uint32_t seed, bool with_grid) const {
        const LightingContext lighting{shading, lights, rays};
        std::vector<RayCounts> counts(points.size());
        std::vector<std::vector<DirectSample>> found(points_at_once);
        DirectGrid grid;
        for (std::size_t first = 0; first < points.size(); first += points_at_once) {
            const std::size_t count = std::min(points_at_once, points.size() - first);
            parallel_for(count, 1, [&](std::size_t i, std::size_t) {
                thread_local GatherScratch scratch;
                RayTask task(rays);
                found[i].clear();
                GatherOptions options{depth, nullptr, nullptr};
                if (with_grid) options = {depth, &grid, &found[i]};
                const RandomKey key{seed, 0, static_cast<std::uint32_t>(first + i), 0};
                gather_irradiance(lighting, task, points[first + i], strata, key, scratch, options);
                counts[first + i] = task.counts;
            });
            for (std::size_t i = 0; i < count; ++i) grid.insert(found[i]);
        }
        RayCounts sum;
        for (const RayCounts& c : counts) sum += c;
        return sum;
    }

    int depth = 0;  ///< GatherOptions
    PosedView posed;
    TextureSet textures;
    RayScene rays;
    ShadingScene shading;
    LightSet lights;
    std::vector<SurfacePoint> points;
};

void measure(const Frame& frame, const RawEmbree& raw, const HemisphereStrata& strata, bool with_grid) {
    double gathering = 1e30, one_thread = 1e30, two_threads = 1e30;
    std::array<double, 3> alone{1e30, 1e30, 1e30};
    RayCounts counts;
    double traced = 0.0;
    const auto others = [&](std::uint32_t round) { frame.gather(strata, 1000 + round, with_grid); };
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const auto gather = [&] { counts = frame.gather(strata, round, with_grid); };
        {
            const ThreadLimit one(1);
            const std::vector<RawRay> recorded = record_rays(gather);
            traced = static_cast<double>(recorded.size());
            for (std::size_t packets = 0; packets < alone.size(); ++packets) {
                others(round);
                const auto trace = [&] { raw.trace(recorded, static_cast<RawEmbree::Packets>(packets)); };
                alone[packets] = std::min(alone[packets], processor_seconds(trace) / traced);
            }
            others(round);
            gathering = std::min(gathering, processor_seconds(gather) / traced);
            others(round);
            one_thread = std::min(one_thread, seconds(gather));
        }
        const ThreadLimit two(2);
        others(round);
        two_threads = std::min(two_threads, seconds(gather));
    }
    fmt::print(" {} direct grid: {} rays: {} gather, {} shadow\n", with_grid ? "with" : "without", counts.total(),
               counts.gather, counts.shadow);
    constexpr std::array names{"single rays", "packets of 16", "coherent packets"};
    for (std::size_t i = 0; i < alone.size(); ++i) {
        fmt::print("  Embree alone, {:<16} {:8.2f} Mray/s\n", names[i], 1e-6 / alone[i]);
    }
    const double best = *std::min_element(alone.begin(), alone.end());
    fmt::print("  gathers                        {:8.2f} Mray/s, {:.2f} of the best\n", 1e-6 / gathering,
               best / gathering);
    fmt::print("  two threads                    {:8.2f} times one\n", one_thread / two_threads);
}

int run(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: bench_gather SCENE [FRAME [WIDTHxHEIGHT [GATHER]]]\n");
        return 2;
    }
    const Scene scene = load_scene(argv[1]);
    RenderSettings settings;
    apply_settings(settings,
                   {{"size", argc > 3 ? argv[3] : "640x480"}, {"gather", argc > 4 ? std::atof(argv[4]) : 1024.0}},
                   "command line");
    Frame frame(scene, argc > 2 ? std::atoll(argv[2]) : 0, settings.width, settings.height);
    frame.depth = std::max(0, settings.path_depth - 2);
    const RawEmbree raw(scene, frame.posed.pose, frame.posed.view, true,
                        origin_of_recorded(frame.rays, frame.posed.pose));
    const HemisphereStrata strata = choose_strata(settings.gather);

    fmt::print("{}: {} points, {} gather rays each\n", argv[1], frame.points.size(), strata.count());
    for (const bool with_grid : {false, true}) measure(frame, raw, strata, with_grid);
    return 0;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    try {
        return aleph::run(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "bench_gather: {}\n", e.what());
        return 1;
    }
}
