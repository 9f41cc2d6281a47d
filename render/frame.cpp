#include "render/frame.h"

#include <algorithm>
#include <chrono>
#include <mutex>

#include "engine/base/parallel.h"
#include "render/bounce_levels.h"
#include "render/bounce_places.h"
#include "render/frame_irradiance.h"
#include "render/gather_at.h"
#include "render/mirror_places.h"
#include "render/pixel_sum.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.6;    // of a frame's time, for progress only
constexpr int lights_in_mirrors = 4;  // PathState::light_samples

/// Keeps the random numbers of paths apart from those of direct light and of gathers (cache_fill.cpp).
constexpr std::uint32_t path_seed_mask = 0x70617468u;

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// The work of one task: its rays, and what it counts.
struct ShadingTask : RayTask {
    ShadingTask(const RayScene& rays, GatherScratch& buffers) : RayTask(rays), scratch(buffers) {}

    GatherScratch& scratch;
    std::uint64_t lookups = 0, hits = 0, computed = 0, invalid = 0;
};

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, const SampleOptions& options,
                 ShadedFrame& out)
        : context_(context),
          centers_(centers),
          options_(options),
          out_(out),
          by_paths_(context.settings.integrator == Integrator::path || options.at_sample),
          indirect_(context.settings.bounces > 0 && context.settings.path_depth > 1),
          cached_(!by_paths_ && indirect_ && context.settings.accuracy > 0.0),
          cache_(make_cache(context.lighting.shading)),
          direct_(context.max_radius),
          sums_(context.view.width, context.view.height) {
        if (cached_) context_.direct = &direct_;
        context_.deeper = make_deeper_light(context.settings, nullptr);
        if (options.record_maps && !by_paths_) uses_ = Image<RecordUse>(context_.view.width, context_.view.height);
        if (!by_paths_) out_.indirect = Image<Rgb>(context.view.width, context.view.height);
    }

    void fill() {
        const int spp = context_.settings.spp;
        for (int i = 0; cached_ && i < spp; ++i) {
            if (context_.progress) context_.progress(fill_share * i / spp, "fill");
            const SampleHits sample = cast(still(), i);
            if (i == 0) fill_fewer_bounces(sample);
            fill_cache(cache_, context_, sample, out_);
            if (i == 0) fill_mirror_places(cache_, context_, sample, out_);
        }
        cache_.finish();
        if (cached_ || context_.carried != nullptr) known_.emplace(context_, cached_ ? &cache_ : nullptr);
    }

    void shade() {
        for (int i = 0; i < context_.settings.spp; ++i) {
            const SampleMoment moment = options_.at_sample ? options_.at_sample(i) : still();
            add_sample(moment, cast(moment, i));
        }
    }

    /// Divides the sums by the numbers of valid samples.
    void resolve(double exposure) {
        const float scale = static_cast<float>(exposure);
        for (std::size_t p = 0; p < sums_.size(); ++p) {
            const PixelSum& sum = sums_.pixels[p];
            if (sum.samples == 0) continue;
            const float valid = static_cast<float>(sum.samples);
            out_.color.pixels[p] = Rgb(sum.radiance) * (scale / valid);
            if (!by_paths_) out_.indirect.pixels[p] *= scale / valid;
            out_.coverage.pixels[p] = static_cast<float>(sum.hits) / valid;
            if (!out_.variance.empty() && sum.samples > 1) {
                out_.variance.pixels[p] = static_cast<float>(sum.variance() * exposure * exposure);
            }
        }
        resolve_uses();
    }

  private:
    void fill_fewer_bounces(const SampleHits& sample) {
        if (context_.deeper.bounces == 0) return;
        std::vector<PixelSurface> seen;
        add_seen_surfaces(context_, sample, seen, out_.counts.rays);
        fewer_bounces_ = fill_levels(context_, seen, out_.counts);
        if (fewer_bounces_) context_.deeper = make_deeper_light(context_.settings, &*fewer_bounces_);
    }

    SampleMoment still() const { return {context_.lighting, context_.view}; }

    SampleHits cast(const SampleMoment& moment, int i) {
        const RenderSettings& settings = context_.settings;
        const bool as_centers = !options_.at_sample && !options_.blended && !(options_.lens.radius > 0.0);
        if (settings.spp == 1 && as_centers) return centers_;
        const SamplePlace place{i,
                                settings.spp,
                                options_.lens,
                                settings.seed,
                                context_.frame,
                                options_.blended ? Blend::random : Blend::cutout};
        return cast_sample(moment.lighting.rays, moment.view, place, &out_.counts.rays.primary);
    }

    /// Shades one sample of every pixel.
    void add_sample(const SampleMoment& moment, const SampleHits& sample) {
        parallel_rows(context_.view.height, 1, [&](int begin, int end) {
            thread_local GatherScratch scratch;
            ShadingTask task(moment.lighting.rays, scratch);
            for (int y = begin; y < end; ++y) {
                for (int x = 0; x < context_.view.width; ++x) add_pixel(moment, task, sample, x, y);
            }
            finish(task);
        });
    }

    void add_pixel(const SampleMoment& moment, ShadingTask& task, const SampleHits& sample, int x, int y) {
        const bool hit = sample.hits(x, y).instance != no_index;
        const ShadingScene& shading = moment.lighting.shading;
        Rgb radiance;
        if (!hit) {
            radiance = environment_radiance(shading, glm::vec3(make_sample_ray(moment.view, sample, x, y).direction));
        } else {
            const PixelSurface surface = make_pixel_surface(shading, moment.view, sample, x, y);
            radiance = by_paths_ ? shade_by_paths(moment, task, surface) : shade_cached(task, surface);
            // The camera may stand in what it sees from inside.
            if (const Rgb loss = Media().attenuation(surface); loss != Rgb(0.0f)) {
                radiance *= glm::exp(-loss * surface.distance);
            }
        }
        if (!is_finite(radiance)) {
            out_.invalid_samples(x, y) += 1.0f;
            ++task.invalid;
            return;
        }
        sums_(x, y).add(radiance, hit);
    }

    RandomStream path_stream(const PixelSurface& surface) const {
        return RandomStream({context_.settings.seed ^ path_seed_mask, context_.frame, surface.pixel,
                             static_cast<std::uint32_t>(surface.sample)});
    }

    PathState start_path() const {
        PathState state;
        state.left = {context_.settings.bounces, context_.settings.path_depth};
        return state;
    }

    Rgb shade_by_paths(const SampleMoment& moment, ShadingTask& task, const PixelSurface& surface) const {
        RandomStream random = path_stream(surface);
        return surface.material.emission + scatter_light(moment.lighting, task, surface, start_path(), random);
    }

    Rgb shade_cached(ShadingTask& task, const PixelSurface& surface) {
        const RenderSettings& settings = context_.settings;
        RandomStream random({settings.seed, context_.frame, surface.pixel, 0});  // one lattice for all samples
        RandomStream path_random = path_stream(surface);
        PathState beyond = start_path();
        --beyond.left.depth;
        beyond.roulette_after = 0;  // most lobes reflect little, and there are many samples
        beyond.survival = 4.0f;     // but one that is ended early leaves noise behind the rays already cast
        beyond.known = known_ ? &*known_ : nullptr;
        beyond.accuracy = context_.accuracy(surface.x, surface.y);
        beyond.light_samples = lights_in_mirrors;
        const int light_samples = (settings.light_samples + settings.spp - 1) / settings.spp;
        const LightPoints points{light_samples, surface.sample, settings.spp};
        Rgb radiance = surface.material.emission;
        radiance += compute_sampled_light(context_.lighting, task, surface, points, random, beyond, path_random);
        if (indirect_ && surface.material.has_diffuse()) {
            const LitSurface lit(surface);
            const Rgb indirect =
                diffuse_radiance(surface.material, lit.cos_view, find_irradiance(task, surface)) * lit.below_sheen;
            out_.indirect(surface.x, surface.y) += indirect;
            radiance += indirect;
        }
        return radiance;
    }

    void resolve_uses() {
        if (uses_.empty()) return;
        out_.cache_count = out_.cache_radius = Image<float>(uses_.width, uses_.height);
        for (std::size_t p = 0; p < uses_.size(); ++p) {
            const RecordUse& used = uses_.pixels[p];
            if (!(used.weights > 0.0f)) continue;
            out_.cache_count.pixels[p] = used.count / static_cast<float>(context_.settings.spp);
            out_.cache_radius.pixels[p] = used.reaches / used.weights;
        }
    }

    /// Indirect irradiance: from the cache, or gathered if it has no record here. The latter happens where neighbour
    /// clamping shrank a record after it covered this place.
    Rgb find_irradiance(ShadingTask& task, const PixelSurface& surface) {
        const float accuracy = context_.accuracy(surface.x, surface.y);
        RecordUse* const used = uses_.empty() ? nullptr : &uses_(surface.x, surface.y);
        if (context_.carried != nullptr) {
            ++task.lookups;
            if (const std::optional<Rgb> found = context_.carried->find(surface, accuracy, task, used)) {
                ++task.hits;
                return *found;
            }
        }
        const CacheQuery place{surface.point.position, surface.point.normal, accuracy, &task};
        if (cached_ && accuracy > 0.0f) {
            CacheQuery query = place;
            query.accuracy *= static_cast<float>(context_.settings.shade_reach);
            query.used = used;
            ++task.lookups;
            if (const std::optional<Rgb> found = cache_.interpolate(query)) {
                ++task.hits;
                return *found;
            }
        }
        ++task.computed;
        out_.records(surface.x, surface.y) += 1.0f;
        const int rays = choose_rays(context_.settings, accuracy, cache_.expected_ray_variance(place));
        return gather_at(context_, task, surface, task.scratch, rays).irradiance;
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
            const double begin = cached_ ? fill_share : 0.0;
            context_.progress(begin + (1.0 - begin) * static_cast<double>(rows_done_) / rows, "shade");
        }
    }

    IndirectContext context_;
    const SampleHits& centers_;
    const SampleOptions& options_;
    ShadedFrame& out_;
    bool by_paths_, indirect_, cached_;
    IrradianceCache cache_;
    std::optional<IrradianceCache> fewer_bounces_;
    std::optional<FrameIrradiance> known_;  ///< to paths
    DirectGrid direct_;
    Image<PixelSum> sums_;
    Image<RecordUse> uses_;  ///< empty: not asked for
    std::mutex mutex_;
    std::size_t rows_done_ = 0;
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure,
                        const SampleOptions& options) {
    const int width = context.view.width, height = context.view.height, spp = context.settings.spp;
    ShadedFrame out;
    out.color = Image<Rgb>(width, height);
    out.coverage = out.records = out.invalid_samples = Image<float>(width, height);
    out.samples = Image<float>(width, height, static_cast<float>(spp));
    out.counts.samples = out.color.size() * static_cast<std::uint64_t>(spp);
    if (context.settings.integrator == Integrator::path && spp > 1) out.variance = Image<float>(width, height);
    FrameShading shading(context, centers, options, out);
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
