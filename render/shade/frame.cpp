#include "render/shade/frame.h"

#include <algorithm>
#include <mutex>

#include "engine/base/parallel.h"
#include "render/guide/error_report.h"
#include "render/pixels/sample_place.h"
#include "render/settings/measure.h"
#include "render/shade/integrator.h"
#include "render/shade/progressive.h"
#include "render/shade/resolve.h"
#include "render/shade/sample_packet.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.3;          // of a frame's time, for progress only
constexpr std::size_t task_ranges = 64;     // pixels of a task
constexpr std::size_t pending_pixels = 16;  // the same for samples that the cache did not cover
constexpr int slice_samples = 1 << 17;      // that may wait for light at a time: more only for the sake of threads
constexpr std::size_t slice_ranges = 64 * task_ranges;

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, const SampleOptions& options,
                 ShadedFrame& out)
        : context_(context),
          options_(options),
          out_(out),
          pixels_(context.view.width, context.view.height),
          place_(make_sample_place(context.settings, options.lens, options.blended, context.frame, 0)),
          integrator_(make_integrator({context, options, out, place_.noise_key, systematic_})) {
        const bool as_centers = !options.at_sample && !options.blended && !(options.lens.radius > 0.0);
        if (place_.centered && as_centers) first_ = &centers;
    }

    /// Computes shared light for the first of the pixel samples alone: where others need light beside them, they get it
    /// before they are added.
    void fill() {
        if (!integrator_->shares_light()) return;
        if (context_.progress) context_.progress(0.0, "fill");
        if (first_ == nullptr) {
            cast_first_ = cast_sample(context_.lighting.rays, context_.view, place_, &out_.counts.rays.primary);
            first_ = &cast_first_;
        }
        if (options_.part != nullptr) leave_part();
        integrator_->fill(*first_);
        if (options_.at_sample) first_ = nullptr;  // of the shutter's centre
    }

    void shade(double exposure) {
        const RenderSettings& settings = context_.settings;
        SamplingPlan plan = make_sampling_plan(options_.limits, settings, exposure);
        plan.part = options_.part;
        if (options_.limits) systematic_ = compute_systematic_tolerance(*options_.limits, settings, exposure);
        sample_by_stages(plan, pixels_, [&](std::span<const PixelRange> ranges) { take(ranges); });
    }

    void resolve(double exposure) {
        if (options_.part != nullptr && !options_.part_picture) return count_samples(pixels_, out_);
        integrator_->resolve(pixels_, exposure);
        if (options_.limits != nullptr && context_.settings.sampling.spp > 1) report_errors(exposure);
    }

  private:
    void leave_part() {
        if (first_ != &cast_first_) cast_first_ = *first_;
        forget_others(*options_.part, cast_first_.hits);
        first_ = &cast_first_;
    }

    SamplePlace place(int index) const {
        SamplePlace place = place_;
        place.index = index;
        place.spacing = find_spacing(context_.settings, index);
        return place;
    }

    /// Takes the samples of a stage.
    void take(std::span<const PixelRange> ranges) {
        if (!options_.at_sample) {
            take_at({context_.lighting, context_.view}, ranges);
        } else {
            take_in_turn(ranges, [this](int i, int c, auto now) { take_at(options_.at_sample(i, c), now); });
        }
        ++stage_;
    }

    void take_at(const SampleScene& scene, std::span<const PixelRange> ranges) {
        integrator_->begin(scene);
        std::size_t begin = 0, end = 0;
        while (begin < ranges.size()) {
            int samples = 0;
            while (end < ranges.size() && (samples < slice_samples || end - begin < slice_ranges)) {
                samples += ranges[end].last - ranges[end].first;
                ++end;
            }
            take_slice(scene, ranges.subspan(begin, end - begin));
            report_progress(static_cast<double>(end) / static_cast<double>(ranges.size()));
            begin = end;
        }
    }

    /// Takes samples, and then finds the light of those that the cache did not cover.
    void take_slice(const SampleScene& scene, std::span<const PixelRange> ranges) {
        std::vector<std::vector<PendingSample>> waiting((ranges.size() + task_ranges - 1) / task_ranges);
        parallel_for(ranges.size(), task_ranges, [&](std::size_t begin, std::size_t end) {
            thread_local GatherScratch scratch;
            ShadingTask task(scene.lighting.rays, context_.lighting.rays, scratch);
            take_ranges(scene, task, ranges.subspan(begin, end - begin), waiting[begin / task_ranges]);
            finish(task);
        });
        std::vector<PendingSample> pending;
        for (const auto& chunk : waiting) pending.insert(pending.end(), chunk.begin(), chunk.end());
        waiting.clear();
        integrator_->fill_waiting(pending);
        add_pending(scene, pending);
    }

    void take_ranges(const SampleScene& scene, ShadingTask& task, std::span<const PixelRange> ranges,
                     std::vector<PendingSample>& waiting) {
        SamplePacket samples(scene, task);
        const auto shade = [&](const SamplePlace& at, int x, int y, const glm::vec3& direction, const Hit& hit) {
            SampleLight light;
            if (hit.instance == no_index) {
                light[LightPart::surface] = environment_radiance(scene.lighting.shading, direction);
                add_sample(task, x, y, light);
                return;
            }
            const PixelSurface surface =
                make_pixel_surface(scene.lighting.shading, scene.view, at, hit, direction, {x, y});
            begin_light(surface, light);
            if (integrator_->shade(task, surface, pixels_(x, y), light)) {
                add_sample(task, x, y, light);
            } else {
                waiting.push_back({surface, light});
            }
        };
        for (const PixelRange& range : ranges) {
            for (int i = range.first; i < range.last; ++i) {
                if (samples.is_full()) samples.finish(shade);
                const bool is_known = i == 0 && first_ != nullptr;
                samples.add(place(i), range.x, range.y, is_known ? &first_->hits(range.x, range.y) : nullptr);
            }
        }
        samples.finish(shade);
    }

    /// Where each pixel's samples begin, and the end of all: a pixel's sums belong to one task.
    static std::vector<std::size_t> find_pixels(const std::vector<PendingSample>& pending) {
        std::vector<std::size_t> begins;
        for (std::size_t i = 0; i < pending.size(); ++i) {
            const PixelSurface& now = pending[i].surface;
            if (i == 0 || now.x != pending[i - 1].surface.x || now.y != pending[i - 1].surface.y) begins.push_back(i);
        }
        begins.push_back(pending.size());
        return begins;
    }

    void add_pending(const SampleScene& scene, std::vector<PendingSample>& pending) {
        if (pending.empty()) return;
        const std::vector<std::size_t> pixels = find_pixels(pending);
        parallel_for(pixels.size() - 1, pending_pixels, [&](std::size_t begin, std::size_t end) {
            thread_local GatherScratch scratch;
            ShadingTask task(scene.lighting.rays, context_.lighting.rays, scratch);
            for (std::size_t i = pixels[begin]; i < pixels[end]; ++i) integrator_->add_waiting(task, pending[i]);
            finish(task);
        });
        ShadingTask task(scene.lighting.rays, context_.lighting.rays, pending_scratch_);
        for (const PendingSample& sample : pending) {
            add_sample(task, sample.surface.x, sample.surface.y, sample.light);
        }
        finish(task);
    }

    void add_sample(ShadingTask& task, int x, int y, const SampleLight& light) {
        if (is_finite(light.total())) {
            pixels_(x, y).add(light);
            return;
        }
        pixels_(x, y).add_invalid();
        out_.invalid_samples(x, y) += 1.0f;
        ++task.invalid;
    }

    void report_errors(double exposure) {
        const RenderSettings& settings = context_.settings;
        out_.errors = estimate_errors({.pixels = pixels_,
                                       .threshold = options_.limits->threshold,
                                       .noise = options_.limits->noise,
                                       .accuracy = options_.limits->accuracy,
                                       .outlines = options_.limits->outlines,
                                       .luminance_scale = exposure * options_.limits->viewing.display_white,
                                       .blurred = options_.at_sample || options_.lens.radius > 0.0});
        out_.error_shares = count_errors(out_.errors, settings.error > 0.0 ? settings.error : 1.0);
    }

    /// Adds what a task counted.
    void finish(const ShadingTask& task) {
        const std::lock_guard lock(mutex_);
        out_.counts.rays += task.counts;
        out_.counts.rays += task.at_frame.counts;
        out_.counts.cache.lookups += task.lookups;
        out_.counts.cache.hits += task.hits;
        out_.counts.records += task.computed;
        out_.counts.invalid_samples += task.invalid;
    }

    /// How many stages follow is not known: each is taken for half of what was left.
    void report_progress(double stage) {
        if (!context_.progress) return;
        const double begin = integrator_->shares_light() ? fill_share : 0.0;
        const Sampling rule = context_.settings.sampling.rule;
        const bool only_one = rule == Sampling::uniform || rule == Sampling::protocol;
        const double left = std::pow(0.5, stage_), done = only_one ? stage : 1.0 - left + 0.5 * left * stage;
        context_.progress(begin + (1.0 - begin) * done, "shade");
    }

    const IndirectContext& context_;
    const SampleOptions& options_;
    ShadedFrame& out_;
    Image<PixelSamples> pixels_;
    SamplePlace place_;  ///< of the first sample
    std::optional<SystematicTolerance> systematic_;
    const std::unique_ptr<LightIntegrator> integrator_;
    const SampleHits* first_ = nullptr;  ///< hits of the pixels' first samples, if they are cast already
    SampleHits cast_first_;
    GatherScratch pending_scratch_;
    int stage_ = 0;
    std::mutex mutex_;
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure,
                        const SampleOptions& options) {
    ShadedFrame out;
    out.records = out.invalid_samples = Image<float>(context.view.width, context.view.height);
    FrameShading shading(context, centers, options, out);
    StageClock clock;
    shading.fill();
    clock.add_to(out.fill_seconds);
    if (options.light_only) return out;
    shading.shade(exposure);
    shading.resolve(exposure);
    clock.add_to(out.shade_seconds);
    return out;
}

}  // namespace aleph
