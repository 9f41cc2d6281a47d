// How light is found: by a cache and samples, or by paths alone.

#include "render/cache/aimed_rays.h"
#include "render/cache/bounce_places.h"
#include "render/cache/cache_fill.h"
#include "render/cache/further_bounces.h"
#include "render/shade/integrator.h"
#include "render/shade/resolve.h"

namespace aleph {

namespace {

/// Direct light and gloss by samples; indirect light from the irradiance cache, or by samples as well. Light of the
/// second and further bounces comes from a coarse cache either way.
class CacheIntegrator final : public LightIntegrator {
  public:
    explicit CacheIntegrator(const IntegratorInput& input)
        : input_(input),
          context_(input.context),
          indirect_(context_.settings.light.bounces > 0 && context_.settings.light.path_depth > 1),
          cached_(indirect_ && context_.settings.cache.accuracy > 0.0 && input.options.light_lasts &&
                  input.options.spans.empty()),
          blurred_(static_cast<bool>(input.options.at_sample)),
          cache_(make_cache(context_.lighting.shading)),
          known_(make_frame_irradiance(context_, cached_ ? &cache_ : nullptr)),
          direct_(context_.max_radius),
          shading_{.context = context_,
                   .indirect = indirect_,
                   .cache = cached_ ? &cache_ : nullptr,
                   .known = blurred_ ? nullptr : &known_,
                   .blurred = blurred_} {
        if (cached_) context_.direct = &direct_;
        if (context_.settings.error > 0.0 && !input.sampling_tolerance.empty())
            context_.tolerance = &input.sampling_tolerance;
        context_.bounces.further = make_multi_bounce_light(context_.settings, nullptr);
        if (!input.options.record_maps) return;
        uses_ = Image<RecordUse>(context_.view.width, context_.view.height);
        shading_.uses = &uses_;
    }

    bool shares_light() const override { return cached_ || needs_further() || needs_bright(); }

    void fill(const SampleHits& first, const SampleHits& whole) override {
        if (cached_ && input_.options.risk != nullptr)
            context_.carried = &checked_.emplace(context_, *input_.options.risk, first);
        if (needs_further() && context_.carried != nullptr)
            further_bounces_ =
                restore_further_bounces(context_, context_.carried->find_further(context_.lighting.shading));
        const std::vector<PixelSurface> seen = find_seen(whole);
        if (needs_bright()) bright_ = find_bright_surfaces(context_.lighting, seen, input_.out.counts.rays);
        if (!bright_.empty()) context_.bright = &bright_;
        solve_further(seen);
        if (!cached_) return;
        if (checked_) checked_->check(cache_, context_, input_.out);
        fill_cache(cache_, context_, first, input_.out);
        fill_mirror_places(cache_, context_, first, input_.out);
        cache_.finish(0, context_.settings.error > 0.0);
        cache_.prepare();
    }

    void begin(const SampleScene& scene) override {
        scene_ = &scene;
        if (const ShutterSpan* span = find_span(input_.options.spans, scene.at)) {
            shading_.shutter = &in_span_.emplace(*span, scene.at, scene.lighting.shading).light();
            return;
        }
        shading_.shutter = nullptr;
        if (!blurred_ || !cached_) return;
        shading_.shutter =
            &shutter_.emplace(context_.lighting.shading, scene.lighting.shading, context_.carried, &cache_);
        shutter_->add_changes(input_.options.from_center, 1.0f);
    }

    void shade(ShadingTask& task, const PixelSurface& surface, const PixelSamples& pixel, SampleLight& light) override {
        shade_sample(shading_, scene_before(*scene_, task, surface), task, surface, pixel, light);
    }

    void save(ByteWriter& out) const override { out.add(uses_.pixels); }
    void restore(ByteReader& in) override { uses_.pixels = in.read_all<RecordUse>(); }

    void resolve(const Image<PixelSamples>& pixels, double exposure) override {
        resolve_pixels(pixels, exposure, true, false, input_.out);
        if (!uses_.empty()) resolve_uses(uses_, pixels, input_.out);
    }

  private:
    /// Paths of samples while the shutter is open do not use it: it holds for the shutter's centre.
    bool needs_further() const { return context_.bounces.further.bounces > 0 && (cached_ || !blurred_); }

    /// Neither do they use bright surfaces. Where keyframes know the light, little is left but samples whose irradiance
    /// is not worth a record.
    bool needs_bright() const {
        return indirect_ && (cached_ || !blurred_) && (context_.carried == nullptr || context_.tolerance != nullptr);
    }

    /// Some of the surfaces in the picture, also where lighting keyframes know their light.
    std::vector<PixelSurface> find_seen(const SampleHits& first) const {
        std::vector<PixelSurface> seen;
        IndirectContext all = context_;
        all.carried = nullptr;
        if (needs_bright() || (needs_further() && !further_bounces_))
            add_seen_surfaces(all, first, seen, input_.out.counts.rays);
        return seen;
    }

    /// Finds light of further bounces, for gathers and for paths of samples.
    void solve_further(const std::vector<PixelSurface>& seen) {
        if (!needs_further()) return;
        if (!further_bounces_) further_bounces_ = solve_further_bounces(context_, seen, input_.out.counts);
        if (!further_bounces_) return;
        context_.bounces.further = make_multi_bounce_light(context_.settings, &*further_bounces_);
        further_ = make_further_irradiance(context_.bounces.further);
        known_.fewer = &further_;
    }

    const IntegratorInput input_;
    IndirectContext context_;
    const bool indirect_, cached_, blurred_;
    IrradianceCache cache_;
    std::optional<CheckedLight> checked_;
    KnownIrradiance known_;
    std::optional<FurtherBounces> further_bounces_;
    KnownIrradiance further_;  ///< the same to paths
    DirectGrid direct_;
    BrightSurfaces bright_;
    Image<RecordUse> uses_;  ///< empty: not asked for
    std::optional<ShutterLight> shutter_;
    std::optional<LightInSpan> in_span_;
    SampleShading shading_;
    const SampleScene* scene_ = nullptr;
};

/// All light along paths, without bias.
class PathIntegrator final : public LightIntegrator {
  public:
    explicit PathIntegrator(const IntegratorInput& input) : input_(input) {}

    void begin(const SampleScene& scene) override { scene_ = &scene; }

    void shade(ShadingTask& task, const PixelSurface& surface, const PixelSamples&, SampleLight& light) override {
        const RenderSettings& settings = input_.context.settings;
        RandomStream random = path_stream(settings.seed, input_.context.frame, surface);
        const LightingContext lighting = scene_before(*scene_, task, surface).lighting;
        const Rgb left = share_left(lighting.around, surface);
        light[LightPart::surface] = surface.material.emission * left;
        light[LightPart::gloss] =
            scatter_light(lighting, task, surface, start_path(settings, lighting.around), random) * left;
    }

    void resolve(const Image<PixelSamples>& pixels, double exposure) override {
        resolve_pixels(pixels, exposure, false, input_.context.settings.sampling.spp > 1, input_.out);
    }

  private:
    const IntegratorInput input_;
    const SampleScene* scene_ = nullptr;
};

}  // namespace

std::unique_ptr<LightIntegrator> make_integrator(const IntegratorInput& input) {
    if (input.context.settings.light.integrator == Integrator::path) return std::make_unique<PathIntegrator>(input);
    return std::make_unique<CacheIntegrator>(input);
}

}  // namespace aleph
