#pragma once
// Integrators: ways to find the light of a frame's samples. README.md says how to add one.

#include <memory>

#include "render/shade/frame.h"

namespace aleph {

/// How light is found, for one frame. Its samples are placed, cast and added up by others (frame.cpp).
class LightIntegrator {
  public:
    virtual ~LightIntegrator() = default;

    /// Returns whether light is computed before the samples, which share it.
    virtual bool shares_light() const { return false; }
    /// Computes it. @param whole  hits of the whole picture, of which `first` may be a part
    virtual void fill(const SampleHits& /*first*/, const SampleHits& /*whole*/) {}

    /// Samples are taken at this time until the next call.
    virtual void begin(const SampleScene& scene) = 0;

    /// Finds the light that a pixel's surface sends to the camera. Called from any thread.
    /// @param light  set, but for what begin_light sets
    virtual void shade(ShadingTask& task, const PixelSurface& surface, const PixelSamples& pixel,
                       SampleLight& light) = 0;

    /// The state that samples have left beside the pixels, for a checkpoint.
    virtual void save(ByteWriter&) const {}
    virtual void restore(ByteReader&) {}

    /// Makes the frame's images.
    virtual void resolve(const Image<PixelSamples>& pixels, double exposure) = 0;
};

/// Inputs of an integrator; all of it must outlive the integrator.
struct IntegratorInput {
    const IndirectContext& context;
    const SampleOptions& options;
    ShadedFrame& out;
    const Image<float>& sampling_tolerance;  ///< SamplingPlan::tolerance
};

std::unique_ptr<LightIntegrator> make_integrator(const IntegratorInput& input);

}  // namespace aleph
