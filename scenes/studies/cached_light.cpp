#include "scenes/studies/cached_light.h"

#include <mutex>

#include "engine/base/parallel.h"
#include "render/cache/cache_fill.h"
#include "render/cache/gather_at.h"

namespace aleph {

namespace {

/// A pixel that reflects indirect light.
struct LitPixel {
    CacheQuery query;
    Rgb reflected{0.0f};  ///< radiance at an irradiance of 1
    int x = 0, y = 0;
};

/// The pixels that reflect diffusely, row by row.
std::vector<LitPixel> find_lit_pixels(const StudyFrame& frame, const Image<float>& alpha) {
    std::vector<std::vector<LitPixel>> rows(static_cast<std::size_t>(alpha.height));
    parallel_rows(alpha.height, 1, [&](int y, int) {
        for (int x = 0; x < alpha.width; ++x) {
            if (frame.centers.hits(x, y).instance == no_index) continue;
            const PixelSurface surface = surface_at(frame, x, y);
            if (!surface.material.has_diffuse()) continue;
            const float accuracy = alpha(x, y) * static_cast<float>(shade_reach);
            rows[static_cast<std::size_t>(y)].push_back(
                {{surface.point.position, surface.point.normal, accuracy, nullptr},
                 reflect_unit_irradiance(surface),
                 x,
                 y});
        }
    });
    std::vector<LitPixel> all;
    for (const auto& row : rows) all.insert(all.end(), row.begin(), row.end());
    return all;
}

/// Reads the cache at the pixels. @return whether a record was found for each
std::vector<std::uint8_t> look_up(const IrradianceCache& cache, const StudyFrame& frame,
                                  const std::vector<LitPixel>& pixels, CachedLight& out) {
    std::vector<std::uint8_t> found(pixels.size());
    std::mutex mutex;
    parallel_for(pixels.size(), 1024, [&](std::size_t begin, std::size_t end) {
        RayTask task(frame.rays);
        for (std::size_t i = begin; i < end; ++i) {
            CacheQuery query = pixels[i].query;
            query.task = &task;
            const std::optional<Rgb> irradiance = cache.interpolate(query);
            found[i] = irradiance.has_value();
            if (irradiance) {
                out.light(pixels[i].x, pixels[i].y) =
                    static_cast<float>(frame.display_luminance(pixels[i].reflected * *irradiance));
            }
        }
        const std::lock_guard lock(mutex);
        out.lookup_rays += task.counts.total();
    });
    return found;
}

/// Gathers at the pixels for which no record was found, as shading does.
void gather_late(const IrradianceCache& cache, const IndirectContext& context, const StudyFrame& frame,
                 const std::vector<LitPixel>& pixels, const std::vector<std::uint8_t>& found, CachedLight& out) {
    std::mutex mutex;
    parallel_for(pixels.size(), 64, [&](std::size_t begin, std::size_t end) {
        thread_local GatherScratch scratch;
        RayTask task(frame.rays);
        std::size_t late = 0;
        for (std::size_t i = begin; i < end; ++i) {
            if (found[i]) continue;
            const LitPixel& pixel = pixels[i];
            const float accuracy = context.accuracy(pixel.x, pixel.y);
            const CacheQuery place{pixel.query.position, pixel.query.normal, accuracy, &task};
            const int rays = choose_rays(context.settings, accuracy, cache.expected_ray_variance(place));
            const PixelSurface surface = surface_at(frame, pixel.x, pixel.y);
            const Rgb irradiance = gather_at(context, task, surface, scratch, rays).irradiance;
            out.light(pixel.x, pixel.y) = static_cast<float>(frame.display_luminance(pixel.reflected * irradiance));
            out.records(pixel.x, pixel.y) += 1.0f;
            ++late;
        }
        const std::lock_guard lock(mutex);
        out.late += late;
        out.gather_rays += task.counts.gather;
        out.shadow_rays += task.counts.shadow;
    });
    out.record_count += out.late;
}

}  // namespace

CachedLight compute_cached_light(const StudyFrame& frame, const RenderSettings& settings, const Image<float>& alpha,
                                 bool smooth) {
    const LightingContext lighting = frame.lighting();
    DirectGrid direct(scene_radius(frame.shading));
    const IndirectContext context{.lighting = lighting,
                                  .view = frame.posed.view,
                                  .settings = settings,
                                  .accuracy = alpha,
                                  .frame = static_cast<std::uint32_t>(frame.frame),
                                  .max_radius = scene_radius(frame.shading),
                                  .progress = {},
                                  .direct = &direct};
    CachedLight out;
    out.light = Image<float>(alpha.width, alpha.height);
    IrradianceCache cache = make_cache(frame.shading);
    FrameTally tally{Image<float>(alpha.width, alpha.height), Image<float>(alpha.width, alpha.height), {}};
    double start = processor_seconds();
    fill_cache(cache, context, frame.centers, tally);
    if (smooth) cache.finish();
    out.fill_seconds = processor_seconds() - start;
    out.records = std::move(tally.records);
    out.record_count = tally.counts.records;
    out.gather_rays = tally.counts.rays.gather;
    out.shadow_rays = tally.counts.rays.shadow;

    const std::vector<LitPixel> pixels = find_lit_pixels(frame, alpha);
    out.lookups = pixels.size();
    start = processor_seconds();
    const std::vector<std::uint8_t> found = look_up(cache, frame, pixels, out);
    out.lookup_seconds = processor_seconds() - start;
    start = processor_seconds();
    gather_late(cache, context, frame, pixels, found, out);
    out.late_seconds = processor_seconds() - start;
    return out;
}

}  // namespace aleph
