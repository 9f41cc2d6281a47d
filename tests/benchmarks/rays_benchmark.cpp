// Rays a second through the flat tree of what stands still, through an instance for every node, and through Embree
// alone (one flat tree of everything, no filters); on one thread, the same rays in all. Also time and memory of
// building.
//   bench_rays SCENE [FRAME [WIDTHxHEIGHT]]

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <memory>
#include <numeric>
#include <random>
#include <stdexcept>

#include "engine/base/flush_denormals.h"
#include "engine/base/parallel.h"
#include "engine/base/sampling.h"
#include "engine/load/load_scene.h"
#include "engine/pose/posed_view.h"
#include "engine/rays/state.h"
#include "tests/benchmarks/raw_embree.h"
#include "tests/benchmarks/thread_seconds.h"

namespace aleph {
namespace {

bool count_bytes(void* sum, ssize_t bytes, bool) {
    *static_cast<std::atomic<std::ptrdiff_t>*>(sum) += bytes;
    return true;
}

/// A ray scene and what its building took.
struct Built {
    Built(const Scene& scene, const PosePlan& plan, const PosedView& posed, bool flatten) {
        auto device = std::make_unique<EmbreeDevice>();
        rtcSetDeviceMemoryMonitorFunction(device->handle(), count_bytes, &bytes);
        seconds = seconds_of([&] {
            meshes = std::make_shared<MeshStructures>(scene, plan, std::move(device), flatten);
            rays = std::make_unique<RayScene>(std::make_unique<RayScene::State>(meshes));
            rays->update(posed.pose, compute_anchor(posed.view));
        });
    }
    std::atomic<std::ptrdiff_t> bytes{0};  // outlives the device
    double seconds = 0.0;
    std::shared_ptr<MeshStructures> meshes;
    std::unique_ptr<RayScene> rays;
};

enum class Way { coherent, packets, single };

std::size_t trace(const RayScene& scene, std::span<const Ray> rays, Way way, bool occlusion) {
    Tracer tracer(scene);
    std::size_t met = 0;
    if (way == Way::single || occlusion) {
        for (const Ray& ray : rays)
            met += occlusion ? tracer.occluded(ray) : tracer.intersect(ray).instance != no_index;
        return met;
    }
    constexpr std::size_t batch = 64;
    std::array<Hit, batch> hits;
    for (std::size_t begin = 0; begin < rays.size(); begin += batch) {
        const std::size_t count = std::min(batch, rays.size() - begin);
        tracer.intersect(rays.subspan(begin, count), std::span(hits.data(), count));
        for (std::size_t i = 0; i < count; ++i) met += hits[i].instance != no_index;
    }
    return met;
}

/// Kinds of rays as renderers cast them.
struct RaySets {
    std::vector<Ray> primary;    ///< blocks of 4 x 4 pixels
    std::vector<Ray> gather;     ///< 256 each from points that primary rays hit, in 4 x 4 blocks of a hemisphere
    std::vector<Ray> scattered;  ///< one from each end of a gather ray, in a random direction
    std::vector<Ray> shadow;     ///< from the same to a few points, as if they were lights
};

/// Some way before the hit: the surfaces' normals are not at hand.
glm::vec3 before(const Ray& ray, const Hit& hit) {
    return ray.origin + ray.direction * (0.999f * hit.distance);
}

RaySets make_rays(const PosedView& posed, const RayScene& scene) {
    RaySets sets;
    Tracer tracer(scene);
    std::mt19937 random(7);
    std::uniform_real_distribution<float> number(0.0f, 1.0f);
    const auto any = [&] {
        const float z = 2.0f * number(random) - 1.0f, angle = 6.2831853f * number(random), w = std::sqrt(1.0f - z * z);
        return glm::vec3(w * std::cos(angle), w * std::sin(angle), z);
    };
    for (int y0 = 0; y0 + 4 <= posed.view.height; y0 += 4) {
        for (int x0 = 0; x0 + 4 <= posed.view.width; x0 += 4) {
            for (int i = 0; i < 16; ++i) {
                const CameraRay ray = make_camera_ray(posed.view, x0 + i % 4 + 0.5, y0 + i / 4 + 0.5);
                sets.primary.push_back({glm::vec3(ray.origin - scene.anchor()), glm::vec3(ray.direction)});
            }
        }
    }
    const std::size_t step = std::max<std::size_t>(1, sets.primary.size() / 600);
    std::vector<glm::vec3> lights;
    for (std::size_t p = 0; p < sets.primary.size(); p += step) {
        const Hit hit = tracer.intersect(sets.primary[p]);
        if (hit.instance == no_index) continue;
        const glm::vec3 from = before(sets.primary[p], hit);
        if (lights.size() < 8) lights.push_back(from);
        const Basis basis = make_basis(-sets.primary[p].direction);
        for (int i = 0; i < 256; ++i) {
            const int row = i / 64 * 4 + i % 16 / 4, column = i / 16 % 4 * 4 + i % 4;
            const glm::vec2 at((static_cast<float>(row) + number(random)) / 16.0f,
                               (static_cast<float>(column) + number(random)) / 16.0f);
            sets.gather.push_back({from, basis.to_world(sample_cosine_hemisphere(at))});
        }
    }
    for (const Ray& ray : sets.gather) {
        const Hit hit = tracer.intersect(ray);
        if (hit.instance == no_index) continue;
        const glm::vec3 from = before(ray, hit);
        sets.scattered.push_back({from, any()});
        const glm::vec3 light = lights[static_cast<std::size_t>(8.0f * number(random)) % lights.size()];
        sets.shadow.push_back({from, light - from, 0.0f, 0.999f});
    }
    return sets;
}

constexpr std::size_t part_size = 8192;

struct Part {
    std::vector<Ray> rays;
    std::vector<RawRay> raw;
};

/// Whole parts only.
std::vector<Part> make_parts(std::span<const Ray> rays, bool occlusion) {
    std::vector<Part> parts(rays.size() / part_size);
    for (std::size_t i = 0; i < part_size * parts.size(); ++i) {
        const Ray& r = rays[i];
        Part& part = parts[i / part_size];
        part.rays.push_back(r);
        part.raw.push_back({{r.origin.x, r.origin.y, r.origin.z, r.near, r.direction.x, r.direction.y, r.direction.z,
                             0.0f, r.far, ~0u, 0, 0},
                            occlusion});
    }
    return parts;
}

void print_sizes(const Scene& scene, const ScenePose& posed, const Built& flat, const Built& nodes) {
    std::size_t shown = 0, triangles = 0, flat_triangles = 0;
    for (std::size_t i = 0; i < posed.instances.size(); ++i) {
        const std::size_t count = scene.meshes[posed.instances[i].mesh].triangles.size();
        shown += posed.shown[i];
        triangles += posed.shown[i] * count;
        flat_triangles += flat.rays->is_flat(static_cast<int>(i)) ? count : 0;
    }
    fmt::print("{} instances with {} triangles, of which {} with {} triangles are flat\n", shown, triangles,
               flat.meshes->flat.count, flat_triangles);
    fmt::print("building: flat {:.3f} s, {:.1f} MB; nodes {:.3f} s, {:.1f} MB\n", flat.seconds,
               1e-6 * static_cast<double>(flat.bytes), nodes.seconds, 1e-6 * static_cast<double>(nodes.bytes));
}

/// Flat, nodes and Embree alone take turns, each with another part of the rays, so that none was just traced. The best
/// time of each part counts: other programs may run on the machine.
void measure(const char* name, const std::vector<Ray>& rays, Way way, bool occlusion, const Built& flat,
             const Built& nodes, const RawEmbree& raw) {
    const std::vector<Part> parts = make_parts(rays, occlusion);
    const std::function<void(const Part&)> modes[] = {
        [&](const Part& part) { trace(*flat.rays, part.rays, way, occlusion); },
        [&](const Part& part) { trace(*nodes.rays, part.rays, way, occlusion); },
        [&](const Part& part) {
            raw.trace(part.raw, way == Way::single     ? RawEmbree::Packets::none
                                : way == Way::coherent ? RawEmbree::Packets::coherent
                                                       : RawEmbree::Packets::incoherent);
        }};
    std::array<std::vector<double>, 3> best;
    best.fill(std::vector<double>(parts.size(), 1e30));
    for (int round = 0; round < 9; ++round) {
        for (std::size_t step = 0; step < parts.size(); ++step) {
            for (std::size_t mode = 0; mode < 3; ++mode) {
                const std::size_t turn = (step + (mode + 1) * parts.size() / 4) % parts.size();
                double& least = best[mode][turn];
                least = std::min(least, seconds_of([&] { modes[mode](parts[turn]); }));
            }
        }
    }
    std::array<double, 3> rate;
    for (std::size_t mode = 0; mode < 3; ++mode)
        rate[mode] = 1e-6 * static_cast<double>(parts.size() * part_size) /
                     std::accumulate(best[mode].begin(), best[mode].end(), 0.0);
    fmt::print("{:<28}{:>10}{:>10.2f}{:>10.2f}{:>10.2f}{:>13.2f}{:>13.2f}\n", name, rays.size(), rate[0], rate[1],
               rate[2], rate[0] / rate[1], rate[0] / rate[2]);
}

void run(const Scene& scene, const PosedView& posed) {
    const PosePlan plan = make_pose_plan(scene);
    const Built flat(scene, plan, posed, true), nodes(scene, plan, posed, false);
    const RawEmbree raw(scene, posed.pose, compute_anchor(posed.view));
    print_sizes(scene, posed.pose, flat, nodes);
    const RaySets sets = make_rays(posed, *nodes.rays);
    fmt::print("{:<28}{:>10}{:>10}{:>10}{:>10}{:>13}{:>13}\n", "Mray/s", "rays", "flat", "nodes", "Embree",
               "flat/nodes", "flat/Embree");
    const auto row = [&](const char* name, const std::vector<Ray>& rays, Way way, bool occlusion) {
        measure(name, rays, way, occlusion, flat, nodes, raw);
    };
    row("primary, coherent", sets.primary, Way::coherent, false);
    row("primary, single", sets.primary, Way::single, false);
    row("gather, coherent", sets.gather, Way::coherent, false);
    row("gather, single", sets.gather, Way::single, false);
    row("scattered, packets", sets.scattered, Way::packets, false);
    row("scattered, single", sets.scattered, Way::single, false);
    row("shadow, single", sets.shadow, Way::single, true);
    row("scattered shadow, single", sets.scattered, Way::single, true);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) try {
    using namespace aleph;
    if (argc < 2) throw std::runtime_error("usage: bench_rays SCENE [FRAME [WIDTHxHEIGHT]]");
    const ThreadLimit one(1);
    const FlushDenormals flush;
    const Scene scene = load_scene(argv[1]);
    const std::int64_t frame = argc > 2 ? std::stoll(argv[2]) : frame_range(scene).first;
    int width = 640, height = 480;
    if (argc > 3) std::sscanf(argv[3], "%dx%d", &width, &height);
    const double seconds = scene.film.frame_rate.seconds_of(frame);
    run(scene, make_posed_view(scene, seconds, CameraNames(scene).find(""), width, height));
} catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
}
