#include "render/cache/fill_points.h"

#include <mutex>

#include "engine/base/parallel.h"
#include "render/surface/carried_point.h"
#include "render/surface/scatter.h"

namespace aleph {

std::optional<PixelSurface> find_surface(const IndirectContext& context, const SampleHits& sample, int x, int y) {
    const ShadingScene& wanted = context.lighting.shading;
    if (context.seen == nullptr) return make_pixel_surface(wanted, context.view, sample, x, y);
    PixelSurface surface = make_pixel_surface(*context.seen, context.view, sample, x, y);
    const std::optional<SurfacePoint> point = carry_point(wanted, surface.hit, surface.point);
    if (!point) return std::nullopt;
    surface.point = *point;
    return surface;
}

FillPoint make_fill_point(const PixelSurface& surface) {
    const LitSurface lit(surface);
    const Rgb reflected = diffuse_radiance(surface.material, lit.cos_view, Rgb(1.0f)) * lit.below_sheen;
    return {surface.point.position, surface.footprint, surface.point.normal, luminance(reflected)};
}

Image<FillPoint> find_points(const IndirectContext& context, const SampleHits& sample, int step, RayCounts& counts) {
    std::mutex counts_mutex;
    Image<FillPoint> points(sample.hits.width, sample.hits.height);
    parallel_rows(points.height, 4, [&](int begin, int end) {
        RayTask task(context.lighting.rays);
        for (int y = begin; y < end; ++y) {
            if (y % step != 0) continue;
            for (int x = 0; x < points.width; x += step) {
                if (sample.hits(x, y).instance == no_index) continue;
                const std::optional<PixelSurface> surface = find_surface(context, sample, x, y);
                if (!surface || !surface->material.has_diffuse()) continue;
                if (context.carried != nullptr && context.carried->find(*surface, context.accuracy(x, y), task)) {
                    continue;
                }
                points(x, y) = make_fill_point(*surface);
            }
        }
        const std::lock_guard lock(counts_mutex);
        counts += task.counts;
    });
    return points;
}

}  // namespace aleph
