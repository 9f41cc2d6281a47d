#pragma once
// One frame of a scene, posed and ready to shade, for studies of single stages.

#include "engine/pose/posed_view.h"
#include "perception/perception_settings.h"
#include "render/frame.h"
#include "render/sequence.h"

namespace aleph {

/// What shading needs of a frame. Keeps a pointer to the sequence's scene, which must outlive it.
struct StudyFrame {
    StudyFrame(const Sequence& sequence, const RenderSettings& settings, std::int64_t number);
    StudyFrame(const StudyFrame&) = delete;
    StudyFrame& operator=(const StudyFrame&) = delete;

    LightingContext lighting() const { return {shading, lights, rays}; }
    /// cd/m2 of a radiance.
    double display_luminance(const Rgb& radiance) const {
        return luminance(radiance) * exposure * scene.viewing.display_white;
    }

    const Scene& scene;
    std::int64_t frame;
    PosedView posed;
    TextureSet textures;
    RayScene rays;
    ShadingScene shading;
    LightSet lights;
    SampleHits centers;  ///< through the pixel centres
    double exposure;
};

/// What the model of vision says of a frame.
struct FrameVision {
    Image<float> aleph;      ///< contrast elevation
    Image<float> threshold;  ///< cd/m2, of an error that lasts
    double seconds = 0.0;    ///< of a processor, for the estimate, motion and maps
};

FrameVision compute_vision(const Scene& scene, RenderSettings settings, Guide guide, Vision vision, std::int64_t frame);

/// Seconds of processor time that the program has used, in all its threads: less disturbed by other programs than the
/// time of a clock.
double processor_seconds();

}  // namespace aleph
