// All light along paths, without bias.

#include "render/shade/integrator.h"
#include "render/shade/resolve.h"

namespace aleph {

namespace {

class PathIntegrator final : public LightIntegrator {
  public:
    explicit PathIntegrator(const IntegratorInput& input) : input_(input) {}

    void begin(const SampleScene& scene) override { scene_ = &scene; }

    void shade(ShadingTask& task, const PixelSurface& surface, const PixelSamples&, SampleLight& light) override {
        const RenderSettings& settings = input_.context.settings;
        RandomStream random = path_stream(settings.seed, input_.noise_key, surface);
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
    if (input.context.settings.light.integrator == Integrator::cache) return make_cache_integrator(input);
    return std::make_unique<PathIntegrator>(input);
}

}  // namespace aleph
