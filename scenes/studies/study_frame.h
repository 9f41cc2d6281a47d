#pragma once
// One frame of a scene, posed and ready to shade, for studies of single stages.

#include "engine/pose/posed_view.h"
#include "perception/perception_settings.h"
#include "render/frame/sequence.h"
#include "render/shade/frame.h"
#include "render/study/processor_time.h"

namespace aleph {

/// What shading needs of a frame. Keeps a pointer to the sequence's scene, which must outlive it.
struct StudyFrame {
    StudyFrame(const Sequence& sequence, const RenderSettings& settings, std::int64_t number);
    StudyFrame(const StudyFrame&) = delete;
    StudyFrame& operator=(const StudyFrame&) = delete;

    /// Takes it to another frame.
    void move_to(std::int64_t number);

    LightingContext lighting() const { return {shading, lights, rays}; }
    /// cd/m2 of a radiance.
    double display_luminance(const Rgb& radiance) const {
        return luminance(radiance) * exposure * scene.viewing.display_white;
    }

    const Scene& scene;
    PosePlan plan;
    int camera;
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
    Image<float> tolerance;  ///< relative error of indirect light that is not seen
    double seconds = 0.0;    ///< of a processor, for the estimate, motion and maps
};

/// Computes the maps of a guide and a model of vision.
Sequence make_vision_sequence(const Scene& scene, RenderSettings settings, Guide guide, const VisionModel* vision);

/// @param sequence  make_vision_sequence
FrameVision compute_vision(Sequence& sequence, std::int64_t frame);

/// The surface at a pixel's centre. Undefined if nothing is there.
inline PixelSurface surface_at(const StudyFrame& frame, int x, int y) {
    return make_pixel_surface(frame.shading, frame.posed.view, frame.centers, x, y);
}

/// Radiance that a surface reflects towards its viewer of an indirect irradiance of 1.
Rgb reflect_unit_irradiance(const PixelSurface& surface);

}  // namespace aleph
