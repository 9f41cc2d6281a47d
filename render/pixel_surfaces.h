#pragma once
// The surface that each pixel sample shows, with its material.

#include "engine/pose/camera_view.h"
#include "engine/rays/first_hits.h"
#include "render/surface_material.h"

namespace aleph {

/// A thin lens.
struct Lens {
    double radius = 0.0;          ///< m; 0: a pinhole
    double focus_distance = 1.0;  ///< m, from the camera to the plane that is sharp
};

/// Which sample of every pixel, and how its rays are placed.
struct SamplePlace {
    int index = 0, count = 1;  ///< sample `index` of `count`; the pixel's centre for count 1
    Lens lens;
    std::uint32_t seed = 0, frame = 0;  ///< for points on the lens
    Blend blend = Blend::cutout;        ///< what blended surfaces do to the rays
};

/// One sample of every pixel: hits cast through (offset_x, offset_y) of the pixel.
struct SampleHits {
    Image<Hit> hits;
    double offset_x = 0.5, offset_y = 0.5;
    float spacing = 1.0f;  ///< pixels between a pixel's samples; textures are averaged over it
    SamplePlace place;
};

/// The ray of a pixel's sample, from its point on the lens. In double, so that no focus distance is too far.
CameraRay make_sample_ray(const CameraView& view, const SampleHits& sample, int x, int y);

/// The surface of one pixel sample.
struct PixelSurface : ViewedSurface {
    Hit hit{};                ///< of the sample's ray
    float distance = 0.0f;    ///< from the camera, m
    float footprint = 0.0f;   ///< size of a pixel at that distance, m
    int x = 0, y = 0;         ///< of the pixel
    int sample = 0;           ///< which of the pixel's samples
    std::uint32_t pixel = 0;  ///< y * width + x, for random numbers
};

/// Undefined if the pixel's ray hit nothing.
PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y);

/// Casts one sample of every pixel: through the centre for a single one, otherwise through point `index` of a rank-1
/// lattice, the same in every pixel.
/// @param rays_cast  increased by the number of rays; may be null
SampleHits cast_sample(const RayScene& rays, const CameraView& view, const SamplePlace& place,
                       std::uint64_t* rays_cast);

/// Through the centre of every pixel, without a lens. Blended surfaces are holes where their alpha is below a half.
SampleHits cast_centers(const RayScene& rays, const CameraView& view, std::uint64_t* rays_cast);

}  // namespace aleph
