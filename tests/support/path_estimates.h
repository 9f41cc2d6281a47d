#pragma once
// Light at a surface point by path tracing, and by two simpler estimators that have no weights which could be wrong:
// one never samples lights, the other never counts light that a ray meets.

#include <functional>

#include "render/path/path.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/trial.h"

namespace aleph {

/// Light that a surface scatters to its viewer, from one sample.
using Estimator = std::function<Rgb(const Stage&, RayTask&, const ViewedSurface&, RandomStream&)>;

inline Estimator by_paths(int bounces, int depth, int roulette_after = 4) {
    return [=](const Stage& stage, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        PathState state;
        state.left = {bounces, depth};
        state.roulette_after = roulette_after;
        return scatter_light(stage.lighting(), task, surface, state, random);
    };
}

/// The surface that a ray meets; false for the environment.
inline bool meet(const Stage& stage, RayTask& task, const Ray& ray, ViewedSurface& next) {
    const Hit hit = task.tracer.intersect(ray);
    if (hit.instance == no_index) return false;
    const SurfacePoint point = make_surface_point(stage.shading, hit, ray.direction);
    next = view_surface(stage.shading, point, -ray.direction, {});
    return true;
}

/// Follows lobes over `depth` surfaces that scatter. Volumes are not followed.
/// @param choose_lights  one light is chosen at every surface, without a weight, and light that is met does not count;
/// else only light that is met counts
inline Estimator by_walks(int depth, bool choose_lights) {
    return [=](const Stage& stage, RayTask& task, ViewedSurface surface, RandomStream& random) {
        Rgb light(0.0f), throughput(1.0f);
        for (int i = 0; i < depth; ++i) {
            const LitSurface lit(surface);
            if (choose_lights) {
                const LightNumbers numbers{random.next(), random.next_2d()};
                const ScatteredLight direct = choose_light(stage.lighting(), lit, {}, numbers);
                if (direct.radiance != Rgb(0.0f))
                    light +=
                        throughput * direct.radiance * find_transmittance(stage.lighting(), task, direct.shadow_ray);
            }
            const ScatterSample sample =
                sample_scatter(lit, share_lobes(lit, LobeSet::all), random.next(), random.next_2d(), random.next());
            if (sample.weight == Rgb(0.0f)) break;
            throughput *= sample.weight;
            const Ray ray{lit.ray_origin(sample.direction), sample.direction};
            ViewedSurface next;
            const bool met = meet(stage, task, ray, next);
            if (!choose_lights)
                light +=
                    throughput * (met ? next.material.emission : environment_radiance(stage.shading, ray.direction));
            if (!met) break;
            surface = next;
        }
        return light;
    };
}
/// Directions are sampled from the lobes only, and all light that is met counts.
inline Estimator by_lobes(int depth) {
    return by_walks(depth, false);
}
/// For scenes without mirrors and without smooth glass.
inline Estimator by_lights(int depth) {
    return by_walks(depth, true);
}

/// So many samples of direct light. The sequence begins anew at each call.
inline Estimator by_direct_samples(int count) {
    return [=](const Stage& stage, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        const auto seed = static_cast<std::uint32_t>(random.next() * 0x1p24f);
        const LobeShares shares{};
        return sample_direct_light(stage.lighting(), task, LitSurface(surface), shares, PixelSequence(seed, 0, 5, 7),
                                   {0, count});
    };
}

/// The mean luminance of so many samples.
inline Mean estimate(const Stage& stage, const ViewedSurface& surface, int count, const Estimator& estimator,
                     std::uint32_t seed = 0) {
    RayTask task(stage.rays);
    Mean mean;
    for (int i = 0; i < count; ++i) {
        RandomStream random({seed, 3, 5, static_cast<std::uint32_t>(i)});
        mean.add(luminance(estimator(stage, task, surface, random)));
    }
    return mean;
}

}  // namespace aleph
