#include "render/cache/cache_fill.h"

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

std::optional<PixelSurface> find_needed(const IndirectContext& context, const SampleHits& sample, int x, int y,
                                        RayTask& task) {
    if (sample.hits(x, y).instance == no_index) return std::nullopt;
    std::optional<PixelSurface> surface = find_surface(context, sample, x, y);
    if (!surface || !surface->material.has_diffuse()) return std::nullopt;
    if (context.carried != nullptr && context.carried->find(*surface, context.accuracy(x, y), task)) {
        return std::nullopt;
    }
    return surface;
}

FillPoint make_fill_point(const PixelSurface& surface) {
    const LitSurface lit(surface);
    const Rgb reflected = diffuse_radiance(surface.material, lit.cos_view, Rgb(1.0f)) * lit.below_sheen;
    return {surface.point.position, surface.footprint, surface.point.normal, luminance(reflected)};
}

Image<FillPoint> find_points(const IndirectContext& context, const SampleHits& sample, int step, RayCounts& counts) {
    Image<FillPoint> points(sample.hits.width, sample.hits.height);
    cast_parallel(points.height, 4, context.lighting.rays, counts, [&](int y, RayTask& task) {
        if (y % step != 0) return;
        for (int x = 0; x < points.width; x += step) {
            if (const auto surface = find_needed(context, sample, x, y, task)) points(x, y) = make_fill_point(*surface);
        }
    });
    return points;
}

}  // namespace aleph
