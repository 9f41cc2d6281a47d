// Gathers against Embree alone: irradiance is gathered at points all over a frame, and Embree traces the gather and
// shadow rays again, without shading, in the fastest of its ways. Other rays are traced in between, so that no ray was
// just traced. All rates are of one thread and of its processor time, and the best of several rounds.
//   bench_gather SCENE [FRAME [WIDTHxHEIGHT [GATHER]]]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/cache/gather.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/settings/settings.h"
#include "tests/benchmarks/recorded_rays.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

constexpr int rounds = 5;
constexpr int across = 24, down = 18;       // points over the frame
constexpr std::size_t points_at_once = 64;  // between two insertions into the direct grid

/// A frame, and points on its surfaces.
struct Frame : Stage {
    Frame(const Scene& of, std::int64_t number, int width, int height)
        : Stage(of, width, height, of.film.frame_rate.seconds_of(number)) {
        const SampleHits centers = cast_centers(rays, view, nullptr);
        for (int y = height / (2 * down); y < height; y += height / down) {
            for (int x = width / (2 * across); x < width; x += width / across) {
                if (centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = make_pixel_surface(shading, view, centers, x, y);
                if (surface.material.has_diffuse()) points.push_back(surface.point);
            }
        }
    }
    /// Gathers at every point. @return the rays cast
    RayCounts gather(const HemisphereStrata& strata, std::uint32_t seed, bool with_grid) const {
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
                gather_irradiance(lighting(), task, points[first + i], {strata, key}, scratch, options);
                counts[first + i] = task.counts;
            });
            for (std::size_t i = 0; i < count; ++i) grid.insert(found[i]);
        }
        RayCounts sum;
        for (const RayCounts& c : counts) sum += c;
        return sum;
    }

    int depth = 0;  ///< GatherOptions
    std::vector<SurfacePoint> points;
};

/// Embree and the gathers take turns, so that what other programs do to the machine meets both.
void measure(const Frame& frame, const RawEmbree& raw, const HemisphereStrata& strata, bool with_grid) {
    Best gathering(CLOCK_THREAD_CPUTIME_ID), one_thread(CLOCK_MONOTONIC), two_threads(CLOCK_MONOTONIC),
        two_processors(CLOCK_PROCESS_CPUTIME_ID);
    std::array<Best, 3> alone{gathering, gathering, gathering};
    RayCounts counts;
    double traced = 0.0;
    for (std::uint32_t round = 0; round < rounds; ++round) {
        const auto gather = [&] { counts = frame.gather(strata, round, with_grid); };
        const auto others = [&] { frame.gather(strata, 1000 + round, with_grid); };
        {
            const ThreadLimit one(1);
            const std::vector<RawRay> recorded = record_rays(gather);
            traced = static_cast<double>(recorded.size());
            for (std::size_t packets = 0; packets < alone.size(); ++packets) {
                others();
                alone[packets].time([&] { raw.trace(recorded, static_cast<RawEmbree::Packets>(packets)); }, traced);
            }
            others();
            one_thread.time([&] { gathering.time(gather, traced); });
        }
        const ThreadLimit two(2);
        others();
        two_threads.time([&] { two_processors.time(gather, traced); });
    }
    fmt::print(" {} direct grid: {} rays: {} gather, {} shadow\n", with_grid ? "with" : "without", counts.total(),
               counts.gather, counts.shadow);
    constexpr std::array names{"single rays", "packets of 16", "coherent packets"};
    double best = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < alone.size(); ++i) {
        fmt::print("  Embree alone, {:<16} {:8.2f} Mray/s\n", names[i], 1e-6 / alone[i].least);
        best = std::min(best, alone[i].least);
    }
    fmt::print("  gathers                        {:8.2f} Mray/s, {:.2f} of the best\n", 1e-6 / gathering.least,
               best / gathering.least);
    fmt::print("  two threads                    {:8.2f} times one; {:.2f} by their processor time\n",
               one_thread.least / two_threads.least, 2.0 * gathering.least / two_processors.least);
}

void run(int argc, char** argv) {
    const Scene scene = load_scene(argv[1]);
    RenderSettings settings;
    apply_settings(settings,
                   {{"size", argc > 3 ? argv[3] : "640x480"}, {"gather", argc > 4 ? std::atof(argv[4]) : 1024.0}},
                   "command line");
    Frame frame(scene, argc > 2 ? std::atoll(argv[2]) : 0, settings.picture.width, settings.picture.height);
    frame.depth = std::max(0, settings.light.path_depth - 2);
    const RawEmbree raw(scene, frame.frame, origin_of_recorded(frame.rays, frame.frame));
    const HemisphereStrata strata = choose_strata(settings.cache.gather);

    fmt::print("{}: {} points, {} gather rays each\n", argv[1], frame.points.size(), strata.count());
    for (const bool with_grid : {false, true}) measure(frame, raw, strata, with_grid);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    return aleph::run_benchmark(argc, "bench_gather SCENE [FRAME [WIDTHxHEIGHT [GATHER]]]",
                                [&] { aleph::run(argc, argv); });
}
