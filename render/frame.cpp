#include "render/frame.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "engine/base/parallel.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.6;  // of a frame's time, for progress only

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The valid samples of a pixel so far. In double: a float sum of 65,536 samples can be off by 0.2 %.
struct PixelSum {
    glm::dvec3 radiance{0.0};
    int samples = 0, hits = 0;
};

/// The work of one task: its rays, and what it counts.
struct ShadingTask : RayTask {
    ShadingTask(const RayScene& rays, GatherScratch& buffers) : RayTask(rays), scratch(buffers) {}

    GatherScratch& scratch;
    std::uint64_t lookups = 0, hits = 0, computed = 0, invalid = 0;
};

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, ShadedFrame& out)
        : context_(context),
          centers_(centers),
          out_(out),
          cached_(context.settings.bounces > 0 && context.settings.accuracy > 0.0),
          cache_(make_cache(context.lighting.shading)),
          sums_(context.view.width, context.view.height) {}

    void fill() {
        const int spp = context_.settings.spp;
        for (int i = 0; cached_ && i < spp; ++i) {
            if (context_.progress) context_.progress(fill_share * i / spp, "fill");
            fill_cache(cache_, context_, cast(i), out_);
        }
    }

    void shade() {
        for (int i = 0; i < context_.settings.spp; ++i) add_sample(cast(i));
    }

    /// Divides the sums by the numbers of valid samples.
    void resolve(double exposure) {
        const float scale = static_cast<float>(exposure);
        for (std::size_t p = 0; p < sums_.size(); ++p) {
            const PixelSum& sum = sums_.pixels[p];
            if (sum.samples == 0) continue;
            const float valid = static_cast<float>(sum.samples);
            out_.color.pixels[p] = Rgb(sum.radiance) * (scale / valid);
            out_.coverage.pixels[p] = static_cast<float>(sum.hits) / valid;
        }
    }

  private:
    SampleHits cast(int i) {
        const int spp = context_.settings.spp;
        if (spp == 1) return centers_;
        return cast_sample(context_.lighting.rays, context_.view, i, spp, &out_.counts.rays.primary);
    }

    /// Shades one sample of every pixel.
    void add_sample(const SampleHits& sample) {
        parallel_rows(context_.view.height, 1, [&](int begin, int end) {
            thread_local GatherScratch scratch;
            ShadingTask task(context_.lighting.rays, scratch);
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < context_.view.width; ++x) add_pixel(task, sample, x, y);
            }
            finish(task);
        });
    }

    void add_pixel(ShadingTask& task, const SampleHits& sample, int x, int y) {
        const bool hit = sample.hits(x, y).instance != no_index;
        const Rgb radiance = hit ? shade_hit(task, sample, x, y) : context_.lighting.shading.environment;
        if (!is_finite(radiance)) {
            out_.invalid_samples(x, y) += 1.0f;
            ++task.invalid;
            return;
        }
        PixelSum& sum = sums_(x, y);
        sum.radiance += glm::dvec3(radiance);
        ++sum.samples;
        if (hit) ++sum.hits;
    }

    Rgb shade_hit(ShadingTask& task, const SampleHits& sample, int x, int y) {
        const RenderSettings& settings = context_.settings;
        const PixelSurface surface = make_pixel_surface(context_.lighting.shading, context_.view, sample, x, y);
        RandomStream random({settings.seed, context_.frame, surface.pixel, 0});  // one lattice for all samples
        const int light_samples = (settings.light_samples + settings.spp - 1) / settings.spp;
        Rgb radiance = surface.material.emission;
        radiance += compute_direct_light(context_.lighting, task, surface,
                                         {light_samples, surface.sample, settings.spp}, random);
        if (settings.bounces > 0 && surface.material.has_diffuse()) {
            const float cos_view = std::max(glm::dot(surface.point.normal, surface.view), 0.0f);
            radiance += diffuse_radiance(surface.material, cos_view, find_irradiance(task, surface));
        }
        return radiance;
    }

    /// Indirect irradiance: from the cache, or gathered if it has no record here. The latter happens where neighbour
    /// clamping shrank a record after it covered this place.
    Rgb find_irradiance(ShadingTask& task, const PixelSurface& surface) {
        const float accuracy = context_.accuracy(surface.x, surface.y);
        if (cached_ && accuracy > 0.0f) {
            const CacheQuery query{surface.point.position, surface.point.normal,
                                   accuracy * static_cast<float>(context_.settings.shade_reach)};
            ++task.lookups;
            if (const std::optional<Rgb> found = cache_.interpolate(query)) {
                ++task.hits;
                return *found;
            }
        }
        ++task.computed;
        out_.records(surface.x, surface.y) += 1.0f;
        return gather_at(context_, task, surface, task.scratch).irradiance;
    }

    /// Adds what a row's task counted.
    void finish(const ShadingTask& task) {
        const std::lock_guard lock(mutex_);
        out_.counts.rays += task.counts;
        out_.counts.cache.lookups += task.lookups;
        out_.counts.cache.hits += task.hits;
        out_.counts.records += task.computed;
        out_.counts.invalid_samples += task.invalid;
        ++rows_done_;
        if (context_.progress && rows_done_ % 16 == 0) {
            const double rows = static_cast<double>(context_.view.height) * context_.settings.spp;
            context_.progress(fill_share + (1.0 - fill_share) * static_cast<double>(rows_done_) / rows, "shade");
        }
    }

    const IndirectContext& context_;
    const SampleHits& centers_;
    ShadedFrame& out_;
    bool cached_;
    IrradianceCache cache_;
    Image<PixelSum> sums_;
    std::mutex mutex_;
    std::size_t rows_done_ = 0;
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure) {
    const int width = context.view.width, height = context.view.height, spp = context.settings.spp;
    ShadedFrame out;
    out.color = Image<Rgb>(width, height);
    out.coverage = out.records = out.invalid_samples = Image<float>(width, height);
    out.samples = Image<float>(width, height, static_cast<float>(spp));
    out.counts.samples = out.color.size() * static_cast<std::uint64_t>(spp);
    FrameShading shading(context, centers, out);
    const auto fill_start = std::chrono::steady_clock::now();
    shading.fill();
    out.fill_seconds = seconds_since(fill_start);
    const auto shade_start = std::chrono::steady_clock::now();
    shading.shade();
    shading.resolve(exposure);
    out.shade_seconds = seconds_since(shade_start);
    return out;
}

}  // namespace aleph
