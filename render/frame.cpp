#include "render/frame.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <mutex>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr double fill_share = 0.6;  // of a frame's time, for progress only

bool is_finite(const Rgb& c) {
    return std::isfinite(c.x) && std::isfinite(c.y) && std::isfinite(c.z);
}

/// What one row adds up by itself.
struct RowCounts {
    RayCounts rays;
    std::uint64_t lookups = 0, hits = 0, computed = 0;
};

/// One frame's shading work, pixel by pixel; shared by all rows.
struct Shading {
    const IndirectContext& context;
    const IrradianceCache* cache;  ///< null: gather at every sample
    int light_samples;
    ShadedFrame& out;

    Rgb indirect(Tracer& tracer, const PixelSurface& surface, int x, int y, int sample, GatherScratch& scratch,
                 RowCounts& counts) {
        const float accuracy = context.accuracy(x, y);
        if (cache != nullptr && accuracy > 0.0f) {
            const CacheQuery query{surface.point.position, surface.point.normal,
                                   accuracy * static_cast<float>(context.settings.shade_radius)};
            ++counts.lookups;
            if (const std::optional<Rgb> found = cache->interpolate(query)) {
                ++counts.hits;
                return *found;
            }
        }
        // Neighbour clamping may shrink a record after it covered this place: then the value is computed here.
        ++counts.computed;
        out.records(x, y) += 1.0f;
        return gather_at(context, tracer, surface, x, y, sample, scratch, counts.rays).irradiance;
    }

    Rgb shade(Tracer& tracer, const SampleHits& hits_of_sample, int x, int y, int sample, GatherScratch& scratch,
              RowCounts& counts) {
        const ShadingScene& shading = context.lighting.shading;
        const PixelSurface surface = make_pixel_surface(shading, context.view, hits_of_sample, x, y);
        const std::uint32_t pixel = static_cast<std::uint32_t>(y) * static_cast<std::uint32_t>(context.view.width) +
                                    static_cast<std::uint32_t>(x);
        RandomStream random({context.settings.seed, context.frame, pixel, 0});  // one lattice for all samples
        Rgb radiance = surface.material.emission;
        radiance += compute_direct_light(context.lighting, tracer, surface.point, surface.material, surface.view,
                                         {light_samples, sample, context.settings.spp}, random, counts.rays);
        if (context.settings.bounces > 0 && needs_irradiance(hits_of_sample, surface, x, y)) {
            const float cos_view = std::max(glm::dot(surface.point.normal, surface.view), 0.0f);
            radiance +=
                diffuse_radiance(surface.material, cos_view, indirect(tracer, surface, x, y, sample, scratch, counts));
        }
        return radiance;
    }
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure) {
    const int width = context.view.width, height = context.view.height, spp = context.settings.spp;
    ShadedFrame out;
    out.color = Image<Rgb>(width, height);
    out.coverage = out.records = out.invalid_samples = Image<float>(width, height);
    out.samples = Image<float>(width, height, static_cast<float>(spp));
    out.counts.samples = out.color.size() * static_cast<std::uint64_t>(spp);
    const auto sample_hits = [&](int i) {
        return spp == 1 ? centers : cast_sample(context.lighting.rays, context.view, i, spp, &out.counts.rays.primary);
    };
    const bool cached = context.settings.bounces > 0 && context.settings.accuracy > 0.0;
    IrradianceCache cache = make_cache(context.lighting.shading);
    const auto fill_start = std::chrono::steady_clock::now();
    for (int i = 0; cached && i < spp; ++i) {
        if (context.progress) context.progress(fill_share * i / spp, "fill");
        fill_cache(cache, context, sample_hits(i), i, out.records, out.counts.rays, out.counts.cache);
    }
    out.fill_seconds = seconds_since(fill_start);
    const auto shade_start = std::chrono::steady_clock::now();
    const int light_samples = (context.settings.light_samples + spp - 1) / spp;
    Shading shading{context, cached ? &cache : nullptr, light_samples, out};
    std::mutex counts_mutex;
    std::size_t rows_done = 0;
    for (int i = 0; i < spp; ++i) {
        const SampleHits sample = sample_hits(i);
        parallel_rows(height, 1, [&](int begin, int end) {
            thread_local GatherScratch scratch;
            Tracer tracer(context.lighting.rays);
            RowCounts local;
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < width; ++x) {
                    const bool hit = sample.hits(x, y).instance != no_index;
                    const Rgb radiance = hit ? shading.shade(tracer, sample, x, y, i, scratch, local)
                                             : context.lighting.shading.environment;
                    if (!is_finite(radiance)) {
                        out.invalid_samples(x, y) += 1.0f;
                        continue;
                    }
                    out.color(x, y) += radiance;
                    out.coverage(x, y) += hit ? 1.0f : 0.0f;
                }
            }
            const std::lock_guard lock(counts_mutex);
            out.counts.rays += local.rays;
            out.counts.cache.lookups += local.lookups;
            out.counts.cache.hits += local.hits;
            out.counts.records += local.computed;
            ++rows_done;
            if (context.progress && rows_done % 16 == 0) {
                const double shaded = static_cast<double>(rows_done) / (static_cast<double>(height) * spp);
                context.progress(fill_share + (1.0 - fill_share) * shaded, "shade");
            }
        });
    }
    const float scale = static_cast<float>(exposure);
    for (std::size_t p = 0; p < out.color.size(); ++p) {
        const float valid = static_cast<float>(spp) - out.invalid_samples.pixels[p];
        out.counts.invalid_samples += static_cast<std::uint64_t>(out.invalid_samples.pixels[p]);
        if (valid > 0.0f) {
            out.color.pixels[p] *= scale / valid;
            out.coverage.pixels[p] /= valid;
        }
    }
    out.counts.records += cache.records().size();
    out.shade_seconds = seconds_since(shade_start);
    return out;
}

}  // namespace aleph
