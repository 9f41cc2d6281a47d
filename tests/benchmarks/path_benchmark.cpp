// Path tracing against Embree alone: the path tracer renders a frame, and Embree traces the rays of that frame again,
// without shading, in the fastest of its ways. Other rays are traced in between, so that no ray was just traced.
//   bench_path SCENE.json [FRAME [WIDTHxHEIGHT [SAMPLES]]]

#include <fmt/format.h>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "render/frame/sequence.h"
#include "tests/benchmarks/recorded_rays.h"
#include "tests/benchmarks/thread_seconds.h"

namespace aleph {
namespace {

void run(int argc, char** argv) {
    const Scene scene = load_scene(argv[1]);
    RenderSettings settings;
    settings.perception.guide = Guide::none;
    settings.light.integrator = Integrator::path;
    SettingMap options{{"size", argc > 3 ? argv[3] : "320x240"}, {"spp", argc > 4 ? std::atof(argv[4]) : 4.0}};
    apply_settings(settings, options, "command line");
    const std::int64_t frame = argc > 2 ? std::atoll(argv[2]) : 0;
    const auto shade = [&](std::uint32_t seed) {
        RenderSettings seeded = settings;
        seeded.seed = seed;
        return Sequence(scene, seeded).render(frame).statistics;
    };
    std::vector<RawRay> recorded;
    {
        const ThreadLimit one(1);
        recorded = record_rays([&] { shade(1); });
    }
    const FrameStatistics paths = shade(1);
    const PosedView posed = make_posed_view(scene, scene.film.frame_rate.seconds_of(frame), 0, settings.picture.width,
                                            settings.picture.height);
    RayScene rays_of_frame(scene);
    rays_of_frame.update(posed.pose, compute_anchor(posed.view));
    const RawEmbree raw(scene, posed.pose, origin_of_recorded(rays_of_frame, posed.pose));
    fmt::print("{}, frame {}, {}x{}, {} samples, {} threads: {} rays\n", argv[1], frame, settings.picture.width,
               settings.picture.height, settings.sampling.spp, thread_count(), paths.traced.all);
    const double rays = static_cast<double>(paths.traced.all), path_seconds = paths.seconds.shade;
    double best = 0.0;
    for (const auto& [name, packets] : {std::pair("single rays", RawEmbree::Packets::none),
                                        std::pair("packets of 16", RawEmbree::Packets::incoherent)}) {
        shade(2);  // other rays
        const double seconds = seconds_of([&] { raw.trace(recorded, packets); }, CLOCK_MONOTONIC);
        const double rate = static_cast<double>(recorded.size()) / seconds;
        best = std::max(best, rate);
        fmt::print("  Embree alone, {:<14} {:8.2f} Mray/s\n", name, 1e-6 * rate);
    }
    fmt::print("  path tracer                  {:8.2f} Mray/s, {:.2f} of the best\n", 1e-6 * rays / path_seconds,
               rays / path_seconds / best);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    return aleph::run_benchmark(argc, "bench_path SCENE.json [FRAME [WIDTHxHEIGHT [SAMPLES]]]",
                                [&] { aleph::run(argc, argv); });
}
