#include "render/cache/gather_at.h"

#include <algorithm>
#include <cmath>

#include "render/cache/aimed_rays.h"
#include "render/guide/stopping_rule.h"

namespace aleph {

namespace {

constexpr int least_rays = 64, first_rays = 512;
constexpr double noise_per_accuracy = 0.2;  // standard error of a record, over alpha

/// Keeps the random numbers of gathers apart from those of direct light: combined with the seed by exclusive or. Any
/// constant but 0 would do.
constexpr std::uint32_t gather_seed_mask = 0x67617468u;

/// Keeps those of caches of different numbers of bounces apart.
constexpr std::uint32_t turn_seed_step = 0x9e3779b9u;

/// Keeps those of frames apart.
constexpr std::uint32_t frame_seed_step = 0x85ebca6bu;

/// Records have random numbers of their place (make_place_key): a surface at rest has the same noise in all frames.
/// Where an error is asked for, rays are chosen for noise that is new in each frame, which the eye averages. That of
/// further bounces stays: it is common to whole walls, where flicker is seen sooner than an error that lasts.
RandomKey choose_key(const IndirectContext& context, const PixelSurface& surface) {
    const std::uint32_t bounces = static_cast<std::uint32_t>(context.bounces.before);
    const bool is_new = context.settings.error > 0.0 && context.bounces.before == 0;
    const std::uint32_t seed = (context.settings.seed ^ gather_seed_mask) + bounces * turn_seed_step +
                               (is_new ? context.frame : 0u) * frame_seed_step;
    return make_place_key(seed, surface.hit);
}

/// Standard error of a record, over that of the mean of samples. Records lie about two pixels apart: noise that is
/// smooth over a pixel is 2.5 times as visible as that of single pixels at 60 cd/m2, and 2.9 times at 5 (castleCSF, as
/// in NoiseVisibility). The records around make it less (IrradianceCache::finish).
constexpr double record_noise = 0.5;

/// Least radii beyond which a record's standard error is smaller in proportion: the farther records reach, the fewer
/// they are, and the less their errors cancel out over a patch. The mean of a wall would differ from frame to frame,
/// which is seen in the dark beside it.
constexpr double steady_radii = 5.0;

}  // namespace

int choose_rays(const RenderSettings& settings, float accuracy, const std::optional<float>& ray_variance) {
    const double most = settings.cache.gather > 0 ? settings.cache.gather : most_rays;
    const double base = settings.cache.gather > 0 ? settings.cache.gather : first_rays;
    double rays = base * std::pow(settings.cache.accuracy / accuracy, 2.0);
    if (settings.cache.gather == 0 && ray_variance) rays = *ray_variance / std::pow(noise_per_accuracy * accuracy, 2.0);
    return static_cast<int>(std::lround(std::clamp(rays, std::min<double>(least_rays, most), most)));
}

int choose_rays_for_noise(double ray_variance, double noise, int fewest, int most) {
    const double needed = ray_variance / (noise * noise);
    return needed > fewest ? static_cast<int>(std::min<double>(needed, std::max(fewest, most))) : fewest;
}

IrradianceSample gather_at(const IndirectContext& context, RayTask& task, const PixelSurface& surface,
                           GatherScratch& scratch, int rays, std::vector<DirectSample>* found) {
    const RandomKey key = choose_key(context, surface);
    if (context.bright != nullptr)
        rays = std::max(std::min(rays, least_rays), rays * around_per_aimed / (around_per_aimed + 1));
    const bool apart_if_rare = context.settings.error > 0.0 && !context.bounces.further.noted && rays >= least_rays;
    return gather_irradiance(context.lighting, task, surface.point, {choose_strata(rays), key}, scratch,
                             {.depth = std::max(0, context.settings.light.path_depth - 2 - context.bounces.before),
                              .grid = context.direct,
                              .found = found,
                              .multi_bounce = context.bounces.further,
                              .material = &surface.material,
                              .bright = context.bright,
                              .apart_if_rare = apart_if_rare});
}

int add_rays_for_noise(int rays, const ExpectedRecord& expected, float reflected, float tolerance, float min_radius) {
    const double light = reflected * expected.irradiance;
    const double farther = std::max(1.0, expected.radius / (steady_radii * min_radius));
    const double noise = record_noise * tolerance / (farther * light * error_deviations);
    return choose_rays_for_noise(expected.ray_variance, noise, rays, most_rays);
}

}  // namespace aleph
