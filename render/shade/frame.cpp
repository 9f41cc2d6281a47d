#include "render/shade/frame.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/base/parallel.h"
#include "render/guide/error_report.h"
#include "render/guide/mean_around.h"
#include "render/pixels/sample_place.h"
#include "render/settings/measure.h"
#include "render/shade/bright_edges.h"
#include "render/shade/integrator.h"
#include "render/shade/progressive.h"
#include "render/shade/resolve.h"
#include "render/shade/sample_packet.h"
#include "render/shade/texture_control.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.3;                      // of a frame's time, for progress only
constexpr std::size_t task_ranges = 64;                 // pixels of a task
constexpr std::size_t slice_ranges = 64 * task_ranges;  // between reports of progress

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, double exposure,
                 const SampleOptions& options, ShadedFrame& out)
        : context_(context),
          options_(options),
          out_(out),
          pixels_(context.view.width, context.view.height),
          place_(make_sample_place(context.settings, options.lens, options.blended, context.frame, 0)),
          exposure_(exposure),
          plan_(make_sampling_plan(options.limits, context.settings, exposure)),
          integrator_(make_integrator({context, options, out, place_.noise_key, plan_.tolerance, systematic_})) {
        plan_.part = options.part;
        if (options.limits) systematic_ = compute_systematic_tolerance(*options.limits, context.settings, exposure);
        const bool as_centers = !options.at_sample && !options.blended && !(options.lens.radius > 0.0);
        if (place_.centered && as_centers) first_ = &centers;
    }

    /// Computes shared light for the first of the pixel samples alone. Others that need light beside them find it by
    /// rays of their own.
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

    /// @param centers  hits of the pixels' centres
    void shade(const SampleHits& centers) {
        // A lens or an open shutter would need rays from all of it: their outlines and textures are soft.
        if (!place_.centered && !options_.at_sample && !(options_.lens.radius > 0.0)) {
            const ShadingScene& shading = context_.lighting.shading;
            bright_edges_ = find_bright_edges(shading, context_.view, centers, exposure_);
            // Paths alone are to judge what an estimate guides.
            if (options_.estimate != nullptr && context_.settings.light.integrator == Integrator::cache)
                textures_.emplace(shading, context_.view, centers, *options_.estimate, exposure_);
        }
        sample_by_stages(plan_, pixels_, [&](std::span<const PixelRange> ranges) { take(ranges); });
    }

    void resolve() {
        if (options_.part != nullptr && !options_.part_picture) return count_samples(pixels_, out_);
        integrator_->resolve(pixels_, exposure_);
        if (options_.limits != nullptr && context_.settings.sampling.spp > 1) report_errors();
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
        const std::size_t before = std::exchange(stage_pixels_, ranges.size());
        if (textures_) textures_->choose(ranges, pixels_);
        expected_ = taken_ + sum_samples(ranges);
        if (!plan_.tolerance.empty()) expected_ += predict_samples(ranges, before, plan_.most);
        if (!options_.at_sample) {
            take_at({context_.lighting, context_.view}, ranges);
        } else {
            take_in_turn(ranges, [this](int i, int c, auto now) { take_at(options_.at_sample(i, c), now); });
        }
    }

    void take_at(const SampleScene& scene, std::span<const PixelRange> ranges) {
        integrator_->begin(scene);
        for (std::size_t begin = 0; begin < ranges.size(); begin += slice_ranges) {
            const auto slice = ranges.subspan(begin, std::min(slice_ranges, ranges.size() - begin));
            parallel_for(slice.size(), task_ranges, [&](std::size_t first, std::size_t last) {
                ShadingTask task(scene.lighting.rays, context_.lighting.rays);
                take_ranges(scene, task, slice.subspan(first, last - first));
                finish(task);
            });
            report_progress(slice);
        }
    }

    void take_ranges(const SampleScene& scene, ShadingTask& task, std::span<const PixelRange> ranges) {
        SamplePacket samples(scene, task);
        std::optional<PixelTexture> texture;  // of the last pixel that was corrected
        const auto shade = [&](const SamplePlace& at, int x, int y, const glm::vec3& direction, const Hit& hit) {
            SampleLight light;
            if (hit.instance == no_index) {
                light[LightPart::surface] = environment_radiance(scene.lighting.shading, direction);
            } else {
                const PixelSurface surface =
                    make_pixel_surface(scene.lighting.shading, scene.view, at, hit, direction, {x, y});
                begin_light(surface, light);
                integrator_->shade(task, surface, pixels_(x, y), light);
            }
            if (textures_ && textures_->corrects(x, y)) {
                if (!texture || texture->pixel() != glm::ivec2(x, y)) texture.emplace(textures_->find_texture(x, y));
                const Rgb correction = texture->correct(at);
                light[LightPart::direct] += correction;
                light.control = luminance(correction);
            }
            if (!bright_edges_.empty() && bright_edges_(x, y) != 0) {
                const glm::ivec2 pixel(x, y);
                light[LightPart::surface] +=
                    average_light_seen(scene, task, at, pixel) - light_seen(scene, at, hit, direction, pixel);
            }
            add_sample(task, x, y, light);
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

    void add_sample(ShadingTask& task, int x, int y, const SampleLight& light) {
        if (is_finite(light.total())) {
            pixels_(x, y).add(light);
            return;
        }
        pixels_(x, y).add_invalid();
        out_.invalid_samples(x, y) += 1.0f;
        ++task.invalid;
    }

    void report_errors() {
        const RenderSettings& settings = context_.settings;
        out_.errors = estimate_errors({.pixels = pixels_,
                                       .threshold = options_.limits->threshold,
                                       .noise = options_.limits->noise,
                                       .accuracy = options_.limits->accuracy,
                                       .outlines = options_.limits->outlines,
                                       .luminance_scale = exposure_ * options_.limits->viewing.display_white,
                                       .blurred = options_.at_sample || options_.lens.radius > 0.0,
                                       .reach = find_seen_reach(options_.limits->viewing.pixels_per_degree)});
        out_.error_shares = count_errors(out_.errors, settings.error > 0.0 ? settings.error : 1.0);
    }

    /// Adds what a task counted.
    void finish(const ShadingTask& task) {
        const std::lock_guard lock(mutex_);
        out_.counts.rays += task.counts;
        out_.counts.rays += task.at_frame.counts;
        out_.counts.cache.lookups += task.lookups;
        out_.counts.cache.hits += task.hits;
        out_.counts.invalid_samples += task.invalid;
    }

    /// The share of the samples that are expected. It never falls when more turn out to be needed.
    void report_progress(std::span<const PixelRange> taken) {
        if (!context_.progress) return;
        taken_ += sum_samples(taken);
        done_ = std::max(done_, std::min(taken_ / expected_, 1.0));
        const double begin = integrator_->shares_light() ? fill_share : 0.0;
        context_.progress(begin + (1.0 - begin) * done_, "shade");
    }

    const IndirectContext& context_;
    const SampleOptions& options_;
    ShadedFrame& out_;
    Image<PixelSamples> pixels_;
    Image<std::uint8_t> bright_edges_;
    std::optional<TextureControl> textures_;
    SamplePlace place_;  ///< of the first sample
    const double exposure_;
    SamplingPlan plan_;
    std::optional<SystematicTolerance> systematic_;
    const std::unique_ptr<LightIntegrator> integrator_;
    const SampleHits* first_ = nullptr;  ///< hits of the pixels' first samples, if they are cast already
    SampleHits cast_first_;
    double taken_ = 0.0, expected_ = 0.0;  ///< samples so far, and in the end, for progress only
    double done_ = 0.0;                    ///< share of them
    std::size_t stage_pixels_ = 0;         ///< of the last stage
    std::mutex mutex_;
};

}  // namespace

ShadedFrame shade_frame(const IndirectContext& context, const SampleHits& centers, double exposure,
                        const SampleOptions& options) {
    ShadedFrame out;
    out.records = out.invalid_samples = Image<float>(context.view.width, context.view.height);
    FrameShading shading(context, centers, exposure, options, out);
    StageClock clock;
    shading.fill();
    clock.add_to(out.fill_seconds);
    if (options.light_only) return out;
    shading.shade(centers);
    shading.resolve();
    clock.add_to(out.shade_seconds);
    return out;
}

}  // namespace aleph
