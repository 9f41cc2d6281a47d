#include "render/frame.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <deque>
#include <mutex>

#include "engine/base/parallel.h"
#include "render/bounce_levels.h"
#include "render/bounce_places.h"
#include "render/progressive.h"
#include "render/sample_place.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.3;      // of a frame's time, for progress only
constexpr std::size_t packet = 16;      // rays
constexpr std::size_t task_ranges = 64;  // pixels of a task

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

/// Samples of neighbouring pixels whose rays are cast together.
class SamplePacket {
  public:
    SamplePacket(const SampleMoment& moment, ShadingTask& task) : moment_(moment), task_(task) {}

    bool is_full() const { return size_ == packet; }
    /// @param known  the hit of its ray; null: not cast yet
    void add(const SamplePlace& place, int x, int y, const Hit* known) {
        const CameraRay ray = make_sample_ray(moment_.view, place, x, y);
        const RayScene& rays = moment_.lighting.rays;
        entries_[size_] = {place, x, y, known == nullptr ? Hit{} : *known};
        directions_[size_] = glm::vec3(ray.direction);
        if (known == nullptr) {
            uncast_[uncast_count_] = size_;
            rays_[uncast_count_].origin = glm::vec3(ray.origin - rays.anchor());
            rays_[uncast_count_++].direction = directions_[size_];
        }
        ++size_;
    }

    /// Casts the rays, gives every sample to `shade(place, x, y, direction, hit)`, and empties the packet.
    template <class Shade>
    void finish(const Shade& shade) {
        std::array<Hit, packet> hits;
        task_.tracer.intersect(std::span(rays_.data(), uncast_count_), std::span(hits.data(), uncast_count_), true);
        task_.counts.primary += uncast_count_;
        for (std::size_t i = 0; i < uncast_count_; ++i) entries_[uncast_[i]].hit = hits[i];
        for (std::size_t i = 0; i < size_; ++i) {
            const Entry& e = entries_[i];
            shade(e.place, e.x, e.y, directions_[i], e.hit);
        }
        size_ = uncast_count_ = 0;
    }

  private:
    struct Entry {
        SamplePlace place;
        int x = 0, y = 0;
        Hit hit;
    };
    const SampleMoment& moment_;
    ShadingTask& task_;
    std::size_t size_ = 0, uncast_count_ = 0;
    std::array<Entry, packet> entries_;
    std::array<glm::vec3, packet> directions_;
    std::array<Ray, packet> rays_;
    std::array<std::size_t, packet> uncast_;
};

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, const SampleOptions& options,
                 ShadedFrame& out)
        : context_(context),
          options_(options),
          out_(out),
          by_paths_(context.settings.integrator == Integrator::path || options.at_sample),
          indirect_(context.settings.bounces > 0 && context.settings.path_depth > 1),
          cached_(!by_paths_ && indirect_ && context.settings.accuracy > 0.0),
          cache_(make_cache(context.lighting.shading)),
          direct_(context.max_radius),
          pixels_(context.view.width, context.view.height),
          place_(make_sample_place(context.settings, context.view, options.lens, options.blended, 0)) {
        if (cached_) context_.direct = &direct_;
        context_.deeper = make_deeper_light(context.settings, nullptr);
        if (options.record_maps && !by_paths_) uses_ = Image<RecordUse>(context_.view.width, context_.view.height);
        const bool as_centers = !options.at_sample && !options.blended && !(options.lens.radius > 0.0);
        if (place_.centered && as_centers) kept_.push_back(&centers);
    }

    void fill() {
        const int samples = cached_ ? fill_samples(context_.settings) : 0;
        for (int i = 0; i < samples; ++i) {
            if (context_.progress) context_.progress(fill_share * i / samples, "fill");
            if (i >= std::ssize(kept_)) {
                cast_.push_back(cast_sample(context_.lighting.rays, context_.view, place(i), &out_.counts.rays.primary));
                kept_.push_back(&cast_.back());
            }
            if (i == 0) fill_fewer_bounces(*kept_[0]);
            fill_cache(cache_, context_, *kept_[i], out_);
        }
        cache_.finish();
    }

    void shade(double exposure) {
        const RenderSettings& settings = context_.settings;
        SamplingPlan plan;
        plan.rule = settings.sampling;
        plan.test = settings.variance_test;
        plan.most = settings.spp;
        if (options_.limits != nullptr) {
            plan.tolerance = compute_sampling_tolerance(*options_.limits, settings, exposure);
            plan.aleph = options_.limits->aleph;
        }
        sample_by_stages(plan, pixels_, [&](std::span<const PixelRange> ranges) { take(ranges); });
    }

    void resolve(double exposure) {
        const float scale = static_cast<float>(exposure);
        const bool with_variance = context_.settings.integrator == Integrator::path && context_.settings.spp > 1;
        const int width = pixels_.width, height = pixels_.height;
        out_.color = Image<Rgb>(width, height);
        out_.coverage = out_.samples = Image<float>(width, height);
        if (!by_paths_) out_.indirect = Image<Rgb>(width, height);
        if (with_variance) out_.variance = Image<float>(width, height);
        for (std::size_t p = 0; p < pixels_.size(); ++p) {
            const PixelSamples& pixel = pixels_.pixels[p];
            out_.color.pixels[p] = pixel.mean() * scale;
            out_.coverage.pixels[p] = pixel.coverage();
            out_.samples.pixels[p] = static_cast<float>(pixel.taken());
            out_.counts.samples += static_cast<std::uint64_t>(pixel.taken());
            if (!by_paths_) out_.indirect.pixels[p] = pixel.mean_indirect() * scale;
            if (with_variance) out_.variance.pixels[p] = static_cast<float>(pixel.variance() * exposure * exposure);
        }
        resolve_uses();
        if (options_.limits != nullptr && context_.settings.spp > 1) report_errors(exposure);
    }

  private:
    void fill_fewer_bounces(const SampleHits& sample) {
        if (context_.deeper.bounces == 0) return;
        std::vector<PixelSurface> seen;
        add_seen_surfaces(context_, sample, seen, out_.counts.rays);
        fewer_bounces_ = fill_levels(context_, seen, out_.counts);
        if (fewer_bounces_) context_.deeper = make_deeper_light(context_.settings, &*fewer_bounces_);
    }

    SamplePlace place(int index) const {
        SamplePlace place = place_;
        place.index = index;
        return place;
    }

    SampleShading make_shading() {
        const RenderSettings& settings = context_.settings;
        LightPoints points{1, 0, 0};
        if (settings.sampling == Sampling::uniform) {
            points = {(settings.light_samples + settings.spp - 1) / settings.spp, 0, settings.spp};
        }
        return {.context = context_,
                .moment = place_.moment,
                .by_paths = by_paths_,
                .indirect = indirect_,
                .cache = cached_ ? &cache_ : nullptr,
                .points = points,
                .records = &out_.records,
                .uses = uses_.empty() ? nullptr : &uses_};
    }

    /// Takes the samples of a stage.
    void take(std::span<const PixelRange> ranges) {
        if (!options_.at_sample) {
            const SampleMoment still{context_.lighting, context_.view};
            take_at(still, ranges);
        } else {
            take_by_time(ranges);
        }
        kept_.clear();
        cast_.clear();
        ++stage_;
    }

    /// One sample of all pixels after the other: each has a time of its own.
    void take_by_time(std::span<const PixelRange> ranges) {
        int first = ranges.front().first, last = 0;
        for (const PixelRange& range : ranges) {
            first = std::min(first, range.first);
            last = std::max(last, range.last);
        }
        std::vector<PixelRange> now;
        for (int i = first; i < last; ++i) {
            now.clear();
            for (const PixelRange& range : ranges) {
                if (range.first <= i && i < range.last) now.push_back({range.x, range.y, i, i + 1});
            }
            const SampleMoment moment = options_.at_sample(i);
            take_at(moment, now);
        }
    }

    void take_at(const SampleMoment& moment, std::span<const PixelRange> ranges) {
        const SampleShading shading = make_shading();
        std::atomic<std::size_t> done = 0;
        parallel_for(ranges.size(), task_ranges, [&](std::size_t begin, std::size_t end) {
            thread_local GatherScratch scratch;
            ShadingTask task(moment.lighting.rays, scratch);
            SamplePacket samples(moment, task);
            const auto shade = [&](const SamplePlace& at, int x, int y, const glm::vec3& direction, const Hit& hit) {
                add_sample(shading, moment, task, at, x, y, direction, hit);
            };
            for (const PixelRange& range : ranges.subspan(begin, end - begin)) {
                for (int i = range.first; i < range.last; ++i) {
                    if (samples.is_full()) samples.finish(shade);
                    const bool is_kept = i < std::ssize(kept_);
                    samples.add(place(i), range.x, range.y, is_kept ? &kept_[i]->hits(range.x, range.y) : nullptr);
                }
            }
            samples.finish(shade);
            finish(task);
            done += end - begin;
            report_progress(static_cast<double>(done) / static_cast<double>(ranges.size()));
        });
    }

    void add_sample(const SampleShading& shading, const SampleMoment& moment, ShadingTask& task, const SamplePlace& at,
                    int x, int y, const glm::vec3& direction, const Hit& hit) {
        const ShadingScene& scene = moment.lighting.shading;
        SampleLight light;
        if (hit.instance == no_index) {
            light[LightPart::surface] = environment_radiance(scene, direction);
        } else {
            light = shade_sample(shading, moment, task,
                                 make_pixel_surface(scene, moment.view, at, hit, direction, x, y));
        }
        if (is_finite(light.total())) {
            pixels_(x, y).add(light);
            return;
        }
        pixels_(x, y).add_invalid();
        out_.invalid_samples(x, y) += 1.0f;
        ++task.invalid;
    }

    void resolve_uses() {
        if (uses_.empty()) return;
        out_.cache_count = out_.cache_radius = Image<float>(uses_.width, uses_.height);
        for (std::size_t p = 0; p < uses_.size(); ++p) {
            const RecordUse& used = uses_.pixels[p];
            if (!(used.weights > 0.0f)) continue;
            out_.cache_count.pixels[p] = used.count / static_cast<float>(pixels_.pixels[p].taken());
            out_.cache_radius.pixels[p] = used.reaches / used.weights;
        }
    }

    void report_errors(double exposure) {
        const RenderSettings& settings = context_.settings;
        out_.errors = estimate_errors({.pixels = pixels_,
                                       .threshold = options_.limits->threshold,
                                       .accuracy = options_.limits->accuracy,
                                       .luminance_scale = exposure * options_.limits->viewing.display_white,
                                       .blurred = options_.at_sample || options_.lens.radius > 0.0});
        out_.error_shares = count_errors(out_.errors, settings.error > 0.0 ? settings.error : 1.0);
    }

    /// Adds what a task counted.
    void finish(const ShadingTask& task) {
        const std::lock_guard lock(mutex_);
        out_.counts.rays += task.counts;
        out_.counts.cache.lookups += task.lookups;
        out_.counts.cache.hits += task.hits;
        out_.counts.records += task.computed;
        out_.counts.invalid_samples += task.invalid;
    }

    /// How many stages follow is not known: each is taken for half of what was left.
    void report_progress(double stage) {
        if (!context_.progress) return;
        const double begin = cached_ ? fill_share : 0.0;
        const bool only_one = context_.settings.sampling == Sampling::uniform;
        const double left = std::pow(0.5, stage_), done = only_one ? stage : 1.0 - left + 0.5 * left * stage;
        context_.progress(begin + (1.0 - begin) * done, "shade");
    }

    IndirectContext context_;
    const SampleOptions& options_;
    ShadedFrame& out_;
    bool by_paths_, indirect_, cached_;
    IrradianceCache cache_;
    std::optional<IrradianceCache> fewer_bounces_;
    DirectGrid direct_;
    Image<PixelSamples> pixels_;
    SamplePlace place_;  ///< of the first sample
    std::vector<const SampleHits*> kept_;  ///< hits of the pixels' first samples, as far as they are cast already
    std::deque<SampleHits> cast_;          ///< those that were cast for the cache
    int stage_ = 0;
    Image<RecordUse> uses_;         ///< empty: not asked for
    std::mutex mutex_;
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure,
                        const SampleOptions& options) {
    ShadedFrame out;
    out.records = out.invalid_samples = Image<float>(context.view.width, context.view.height);
    FrameShading shading(context, centers, options, out);
    const auto fill_start = std::chrono::steady_clock::now();
    shading.fill();
    out.fill_seconds = seconds_since(fill_start);
    const auto shade_start = std::chrono::steady_clock::now();
    shading.shade(exposure);
    shading.resolve(exposure);
    out.shade_seconds = seconds_since(shade_start);
    return out;
}

}  // namespace aleph
