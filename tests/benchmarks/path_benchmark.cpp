// Path tracing against Embree alone: the path tracer renders a frame, and Embree traces the rays of that frame again,
// without shading, in the fastest of its ways. Other rays are traced in between, so that no ray was just traced.
//   bench_path SCENE.json [FRAME [WIDTHxHEIGHT [SAMPLES]]]
// The rays are recorded by functions of this program that stand in for Embree's.

#include <dlfcn.h>
#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <string>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "render/sequence.h"
#include "tests/benchmarks/raw_embree.h"

namespace aleph {
namespace {

bool recording = false;
std::vector<RawRay> recorded;

bool is_same(const RawRay& a, const RawRay& b) {
    return a.ray.org_x == b.ray.org_x && a.ray.org_y == b.ray.org_y && a.ray.org_z == b.ray.org_z &&
           a.ray.dir_x == b.ray.dir_x && a.ray.dir_y == b.ray.dir_y && a.ray.dir_z == b.ray.dir_z &&
           a.occlusion == b.occlusion;
}

/// Rays go through what stands still and what moves one after the other: they count once.
void record(const RTCRay& ray, bool occlusion) {
    const RawRay entry{ray, occlusion};
    const std::size_t near = std::min<std::size_t>(recorded.size(), 17);
    for (std::size_t i = 0; i < near; ++i) {
        if (is_same(recorded[recorded.size() - 1 - i], entry)) return;
    }
    recorded.push_back(entry);
}

template <class Function>
Function* original(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

double seconds_of(const std::function<void()>& run) {
    const auto start = std::chrono::steady_clock::now();
    run();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int run(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "usage: bench_path SCENE.json [FRAME [WIDTHxHEIGHT [SAMPLES]]]\n");
        return 2;
    }
    const Scene scene = load_scene(argv[1]);
    RenderSettings settings;
    settings.perception.guide = Guide::none;
    settings.integrator = Integrator::path;
    SettingMap options{{"size", argc > 3 ? argv[3] : "320x240"}, {"spp", argc > 4 ? std::atof(argv[4]) : 4.0}};
    apply_settings(settings, options, "command line");
    const std::int64_t frame = argc > 2 ? std::atoll(argv[2]) : 0;
    const auto shade = [&](std::uint32_t seed) {
        RenderSettings seeded = settings;
        seeded.seed = seed;
        return Sequence(scene, seeded).render(frame).statistics;
    };
    {
        const ThreadLimit one(1);
        recording = true;
        shade(1);
        recording = false;
    }
    const FrameStatistics paths = shade(1);
    const PosedView posed =
        make_posed_view(scene, scene.frame_rate.seconds_of(frame), 0, settings.width, settings.height);
    RawEmbree raw(scene, posed.pose, posed.view);
    fmt::print("{}, frame {}, {}x{}, {} samples, {} threads: {} rays\n", argv[1], frame, settings.width,
               settings.height, settings.spp, thread_count(), paths.traced_rays);
    const double rays = static_cast<double>(paths.traced_rays), path_seconds = paths.seconds.shade;
    double best = 0.0;
    for (const auto& [name, packets] : {std::pair("single rays", false), std::pair("packets of 16", true)}) {
        shade(2);  // other rays
        const double seconds = seconds_of([&] { raw.trace(recorded, packets); });
        const double rate = static_cast<double>(recorded.size()) / seconds;
        best = std::max(best, rate);
        fmt::print("  Embree alone, {:<14} {:8.2f} Mray/s\n", name, 1e-6 * rate);
    }
    fmt::print("  path tracer                  {:8.2f} Mray/s, {:.2f} of the best\n", 1e-6 * rays / path_seconds,
               rays / path_seconds / best);
    return 0;
}

}  // namespace
}  // namespace aleph

extern "C" {

void rtcIntersect1(RTCScene scene, RTCIntersectContext* context, RTCRayHit* ray) {
    static auto* const call = aleph::original<decltype(rtcIntersect1)>("rtcIntersect1");
    if (aleph::recording) aleph::record(ray->ray, false);
    call(scene, context, ray);
}

void rtcOccluded1(RTCScene scene, RTCIntersectContext* context, RTCRay* ray) {
    static auto* const call = aleph::original<decltype(rtcOccluded1)>("rtcOccluded1");
    if (aleph::recording) aleph::record(*ray, true);
    call(scene, context, ray);
}

void rtcIntersect16(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit16* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect16)>("rtcIntersect16");
    for (unsigned i = 0; aleph::recording && i < 16; ++i) {
        if (valid[i] != 0) aleph::record(rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&packet->ray), 16, i), false);
    }
    call(valid, scene, context, packet);
}

void rtcIntersect8(const int* valid, RTCScene scene, RTCIntersectContext* context, RTCRayHit8* packet) {
    static auto* const call = aleph::original<decltype(rtcIntersect8)>("rtcIntersect8");
    for (unsigned i = 0; aleph::recording && i < 8; ++i) {
        if (valid[i] != 0) aleph::record(rtcGetRayFromRayN(reinterpret_cast<RTCRayN*>(&packet->ray), 8, i), false);
    }
    call(valid, scene, context, packet);
}

}  // extern "C"

int main(int argc, char** argv) {
    try {
        return aleph::run(argc, argv);
    } catch (const std::exception& e) {
        fmt::print(stderr, "bench_path: {}\n", e.what());
        return 1;
    }
}
