#pragma once
// The surface behind each pixel's sample, made ready for shading when it is asked for.

#include "engine/pose/camera_view.h"
#include "engine/rays/first_hits.h"
#include "render/bsdf.h"

namespace aleph {

/// One sample position of every pixel: hits cast through (offset_x, offset_y) of the pixel.
struct SampleHits {
    Image<Hit> hits;
    double offset_x = 0.5, offset_y = 0.5;
    float spacing = 1.0f;  ///< pixels between a pixel's samples: what textures are averaged over
};

struct PixelSurface {
    SurfacePoint point;
    SurfaceMaterial material;
    glm::vec3 view{0.0f};    ///< unit, towards the camera
    float footprint = 0.0f;  ///< a pixel's size at that distance, m
};

/// Undefined where the pixel hit nothing.
PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y);

/// Sample i of n within the pixel: the centre for n = 1, else a rank-1 lattice, the same in every pixel.
SampleHits cast_sample(const RayScene& rays, const CameraView& view, int i, int n, std::uint64_t* rays_cast);

}  // namespace aleph
