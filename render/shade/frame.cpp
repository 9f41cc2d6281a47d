#include "render/shade/frame.h"

#include <algorithm>
#include <mutex>
#include <utility>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/guide/error_report.h"
#include "render/settings/measure.h"
#include "render/shade/edge_light.h"
#include "render/shade/integrator.h"
#include "render/shade/lens_light.h"
#include "render/shade/resolve.h"
#include "render/shade/sample_packet.h"
#include "render/shade/texture_control.h"

namespace aleph {

namespace {

constexpr double fill_share = 0.3;          // of a frame's time, for progress only
constexpr std::size_t tasks_of_slice = 64;  // between reports of progress

class FrameShading {
  public:
    FrameShading(const IndirectContext& context, const SampleHits& centers, double exposure,
                 const SampleOptions& options, ShadedFrame& out)
        : context_(context),
          options_(options),
          out_(out),
          place_(make_sample_place(context.settings, options.lens, options.blended, context.frame, 0)),
          exposure_(exposure),
          plan_(make_sampling_plan(options.limits, context.settings, exposure)),
          pixels_(context.view.width, context.view.height, PixelSamples(static_cast<float>(plan_.white))),
          integrator_(make_integrator({context, options, out, plan_.tolerance})) {
        plan_.part = options.part;
        const bool as_centers = !options.at_sample && !options.blended && !(options.lens.radius > 0.0);
        if (place_.centered && as_centers) first_ = &centers;
    }

    /// Computes shared light for the first of the pixel samples alone. Others that need light beside them find it by
    /// rays of their own.
    void fill() {
        if (!integrator_->shares_light()) return;
        if (context_.checkpoint != nullptr) context_.checkpoint->begin_fill();
        if (context_.progress) context_.progress(0.0, "fill");
        if (first_ == nullptr) {
            cast_first_ = cast_sample(context_.lighting.rays, context_.view, place_, &out_.counts.rays.primary);
            first_ = &cast_first_;
        }
        if (options_.part == nullptr) {
            integrator_->fill(*first_, *first_);
        } else {
            SampleHits part = *first_;
            forget_others(*options_.part, part.hits);
            integrator_->fill(part, options_.part_picture ? *first_ : part);
        }
        if (options_.at_sample) first_ = nullptr;  // of the shutter's centre
    }

    /// @param centers  hits of the pixels' centres
    void shade(const SampleHits& centers) {
        // A lens would need rays from all of it: outlines and textures are soft.
        const bool is_sharp = !place_.centered && !(options_.lens.radius > 0.0);
        // Paths alone are to judge what an estimate guides.
        const bool by_estimate =
            options_.estimate != nullptr && context_.settings.light.integrator == Integrator::cache;
        if (is_sharp && !options_.at_sample && by_estimate)
            textures_.emplace(context_.lighting.shading, context_.view, centers, *options_.estimate, exposure_);
        std::vector<PixelRange> begin = restore();
        if (is_sharp) find_edges(centers, !begin.empty());
        if (options_.lens.radius > 0.0 && !place_.centered && context_.settings.light.integrator == Integrator::cache)
            lamps_ = find_lens_light(context_.lighting, context_.view, options_.lens, exposure_);
        sample_by_stages(
            plan_, pixels_, [&](std::span<const PixelRange> ranges) { take(ranges); }, std::move(begin));
    }

    void resolve() {
        if (options_.part != nullptr && !options_.part_picture) return count_samples(pixels_, out_);
        if (plan_.rule == Sampling::threshold)
            spread_lost_light(pixels_, plan_.outlines, 2 * plan_.reach, plan_.white);  // a cycle
        integrator_->resolve(pixels_, exposure_);
        if (options_.limits != nullptr && context_.settings.sampling.spp > 1) report_errors();
    }

  private:
    /// The scene of the frame, at the shutter's centre.
    SampleScene center() const { return {context_.lighting, context_.view, options_.lens}; }

    /// @param is_known  their light is restored
    void find_edges(const SampleHits& centers, bool is_known) {
        std::uint64_t rays = 0;
        BrightEdges edges =
            find_bright_edges(context_.lighting, context_.view, centers, place_.filter, exposure_, rays);
        if (is_known) {
            edges_ = {std::move(edges), std::move(edges_.pixels)};
            return;
        }
        edges_ = find_edge_light(center(), place_, plan_, std::move(edges), rays);
        out_.counts.rays.primary += rays;
        for (const EdgeLight& light : edges_.pixels) pixels_(light.x, light.y).set_seen_variance(light.variance);
    }

    SamplePlace place(int index) const {
        SamplePlace place = place_;
        place.index = index;
        place.spacing = find_spacing(context_.settings, index);
        return place;
    }

    /// The samples that an earlier process left. @return its stage; empty: there are none
    std::vector<PixelRange> restore() {
        if (context_.checkpoint == nullptr) return {};
        const std::string samples = context_.checkpoint->take_samples();
        if (samples.empty()) return {};
        ByteReader in(samples);
        std::vector<PixelRange> stage = in.read_all<PixelRange>();
        skip_ = in.read<std::size_t>();
        pixels_.pixels = in.read_all<PixelSamples>();
        edges_.pixels = in.read_all<EdgeLight>();
        out_.counts = in.read<FrameCounts>();
        out_.invalid_samples.pixels = in.read_all<float>();
        integrator_->restore(in);
        if (textures_) textures_->restore(in);
        ALEPH_CHECK(in.is_good() && pixels_.pixels.size() == out_.records.size(), "samples of a checkpoint");
        return stage;
    }

    std::string save(std::span<const PixelRange> stage) const {
        ByteWriter out;
        out.add(std::vector(stage.begin(), stage.end()));
        out.add(slices_);
        out.add(pixels_.pixels);
        out.add(edges_.pixels);
        out.add(out_.counts);
        out.add(out_.invalid_samples.pixels);
        integrator_->save(out);
        if (textures_) textures_->save(out);
        return out.take();
    }

    void show_picture() {
        Image<Rgb> color(pixels_.width, pixels_.height);
        for (std::size_t i = 0; i < color.size(); ++i)
            color.pixels[i] = pixels_.pixels[i].mean() * static_cast<float>(exposure_);
        options_.partial->show(color);
    }

    /// Between slices: what others want of the state.
    void offer() {
        ++slices_;
        if (context_.checkpoint != nullptr) context_.checkpoint->offer([&] { return save(stage_); });
        if (options_.partial != nullptr && options_.partial->is_wanted && options_.partial->is_wanted()) show_picture();
    }

    /// Takes the samples of a stage.
    void take(std::span<const PixelRange> ranges) {
        const std::size_t before = std::exchange(stage_, ranges).size();
        slices_ = 0;
        if (textures_ && skip_ == 0) textures_->choose(ranges, pixels_);
        expected_ = taken_ + sum_samples(ranges);
        if (!plan_.tolerance.empty()) expected_ += predict_samples(ranges, before, plan_.most);
        if (!options_.at_sample) {
            take_at(ranges, [this] { return center(); });
        } else {
            take_in_turn(ranges,
                         [this](int i, int c, auto now) { take_at(now, [&] { return options_.at_sample(i, c); }); });
        }
    }

    /// @param find_scene  called if samples are left to take: to pose the scene takes longer than few samples do
    template <class FindScene>
    void take_at(std::span<const PixelRange> ranges, const FindScene& find_scene) {
        const std::size_t task_ranges = find_task_ranges(ranges), slice_ranges = tasks_of_slice * task_ranges;
        const std::span<const PixelRange> left = skip_taken(ranges, slice_ranges);
        if (left.empty()) return;
        const SampleScene scene = find_scene();
        integrator_->begin(scene);
        place_.lens = scene.lens;
        if (left.size() == ranges.size()) out_.counts.rays.primary += scene.rays_cast;  // once, by the first process
        for (std::size_t begin = 0; begin < left.size(); begin += slice_ranges) {
            const auto slice = left.subspan(begin, std::min(slice_ranges, left.size() - begin));
            parallel_for(slice.size(), task_ranges, [&](std::size_t first, std::size_t last) {
                ShadingTask task(scene.lighting.rays, context_.lighting.rays);
                take_ranges(scene, task, slice.subspan(first, last - first));
                finish(task);
            });
            offer();
            report_progress(slice);
        }
    }

    /// Leaves out the slices that an earlier process has taken. @return the ranges that are left
    std::span<const PixelRange> skip_taken(std::span<const PixelRange> ranges, std::size_t slice_ranges) {
        for (; skip_ > 0 && !ranges.empty(); --skip_) {
            const auto slice = ranges.first(std::min(slice_ranges, ranges.size()));
            ++slices_;
            taken_ += sum_samples(slice);
            ranges = ranges.subspan(slice.size());
        }
        return ranges;
    }

    void take_ranges(const SampleScene& scene, ShadingTask& task, std::span<const PixelRange> ranges) {
        SamplePacket samples(scene, task);
        std::optional<PixelTexture> texture;  // of the last pixel that was corrected
        std::optional<LensPixel> lens;        // likewise
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
                light.control = correction;
            }
            if (lamps_) {
                if (!lens || lens->pixel() != glm::ivec2(x, y)) lens.emplace(*lamps_, at.filter, glm::ivec2(x, y));
                light[LightPart::surface] += lens->correct(scene, task, at, hit, direction);
            }
            if (const EdgeLight* edge = edges_.find(x, y)) {
                Rgb& seen = light[LightPart::surface];
                seen += edge->mean - light_in_edge(scene, task, at, edges_.edges, *edge, hit, direction);
                if (options_.at_sample)
                    seen += sample_edge_light(scene, task, at, edges_.edges, *edge) -
                            sample_edge_light(center(), task.at_frame, at, edges_.edges, *edge);
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
        const bool blurred = options_.at_sample || options_.lens.radius > 0.0;
        out_.errors = estimate_errors(pixels_, *options_.limits, exposure_, blurred);
        out_.error_shares = count_errors(out_.errors, context_.settings.error > 0.0 ? context_.settings.error : 1.0);
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
    std::optional<TextureControl> textures_;
    EdgeLights edges_;
    std::optional<LensLight> lamps_;
    SamplePlace place_;  ///< of the first sample
    const double exposure_;
    SamplingPlan plan_;
    Image<PixelSamples> pixels_;
    const std::unique_ptr<LightIntegrator> integrator_;
    const SampleHits* first_ = nullptr;  ///< hits of the pixels' first samples, if they are cast already
    SampleHits cast_first_;
    double taken_ = 0.0, expected_ = 0.0;  ///< samples so far, and in the end, for progress only
    double done_ = 0.0;                    ///< share of them
    std::span<const PixelRange> stage_;    ///< pixels of the last stage
    std::size_t slices_ = 0;               ///< of the stage that are finished
    std::size_t skip_ = 0;                 ///< slices of the stage that an earlier process has finished
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
