#pragma once
// Indirect diffuse light of the quick estimate: irradiance gathered at few pixels, and a smooth interpolation between
// them along surfaces.

#include "render/direct_light.h"
#include "render/pixel_surfaces.h"

namespace aleph {

/// What indirect light finds at a pixel.
struct DiffuseSurface {
    glm::vec3 position{0.0f};  ///< m, relative to the anchor
    glm::vec3 normal{0.0f};    ///< unit
    float footprint = 0.0f;    ///< size of a pixel at that distance, m; 0: nothing that reflects diffusely
    Rgb reflected{0.0f};       ///< radiance towards the viewer per unit of irradiance
};
DiffuseSurface make_diffuse_surface(const PixelSurface& surface);

/// The radiance, towards the viewer, of the light that arrives after one bounce, without the noise and the blocks that
/// the model of vision would take for detail. All gathers have the same random numbers, so their error varies as slowly
/// as the light itself. Biased: what is smaller than about 30 pixels of a 640x480 picture, such as the shadow of a
/// chair leg, is smoothed away.
/// @param surfaces  of all pixel centres
/// @param counts    increased by the rays cast
Image<Rgb> estimate_indirect_light(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                   const Image<DiffuseSurface>& surfaces, RayCounts& counts);

}  // namespace aleph
