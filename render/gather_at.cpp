#include "render/gather_at.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace aleph {

namespace {

constexpr int least_rays = 64, first_rays = 512, most_rays = 8192;
constexpr double noise_per_accuracy = 0.2;  // standard error of a record, over alpha

/// Keeps the random numbers of gathers apart from those of direct light: combined with the seed by exclusive or. Any
/// constant but 0 would do.
constexpr std::uint32_t gather_seed_mask = 0x67617468u;

}  // namespace

int choose_rays(const RenderSettings& settings, float accuracy, const std::optional<float>& ray_variance) {
    const double most = settings.gather > 0 ? settings.gather : most_rays;
    const double base = settings.gather > 0 ? settings.gather : first_rays;
    if (!(settings.accuracy > 0.0 && accuracy > 0.0f)) return static_cast<int>(base);
    double rays = base * std::pow(settings.accuracy / accuracy, 2.0);
    if (settings.gather == 0 && ray_variance) rays = *ray_variance / std::pow(noise_per_accuracy * accuracy, 2.0);
    return static_cast<int>(std::clamp(rays, std::min<double>(least_rays, most), most));
}

IrradianceSample gather_at(const IndirectContext& context, RayTask& task, const PixelSurface& surface,
                           GatherScratch& scratch, int rays) {
    // By the place: a surface at rest that a camera at rest sees has the same noise at every time.
    const Hit& hit = surface.hit;
    const std::uint64_t place =
        mix_bits(std::uint64_t{std::bit_cast<std::uint32_t>(hit.u)} << 32 | std::bit_cast<std::uint32_t>(hit.v));
    const RandomKey key{context.settings.seed ^ gather_seed_mask, static_cast<std::uint32_t>(hit.instance),
                        static_cast<std::uint32_t>(hit.primitive) ^ static_cast<std::uint32_t>(place >> 32),
                        static_cast<std::uint32_t>(place)};
    return gather_irradiance(context.lighting, task, surface.point, choose_strata(rays), key, scratch,
                             std::max(0, context.settings.path_depth - 2));
}

}  // namespace aleph
