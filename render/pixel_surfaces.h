#pragma once
// The surface that each pixel sample shows, with its material.

#include "engine/pose/camera_view.h"
#include "engine/rays/first_hits.h"
#include "render/bsdf.h"

namespace aleph {

/// One sample position of every pixel: hits cast through (offset_x, offset_y) of the pixel.
struct SampleHits {
    Image<Hit> hits;
    double offset_x = 0.5, offset_y = 0.5;
    float spacing = 1.0f;  ///< pixels between a pixel's samples; textures are averaged over it
    int index = 0;         ///< which of the pixel's samples
};

/// The surface of one pixel sample.
struct PixelSurface : ViewedSurface {
    float footprint = 0.0f;   ///< size of a pixel at that distance, m
    int x = 0, y = 0;         ///< of the pixel
    int sample = 0;           ///< which of the pixel's samples
    std::uint32_t pixel = 0;  ///< y * width + x, for random numbers
};

/// Undefined if the pixel's ray hit nothing.
PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y);

/// Sample i of n of every pixel: the centre for n = 1, otherwise point i of a rank-1 lattice, the same in every pixel.
/// @param rays_cast  increased by the number of rays; may be null
SampleHits cast_sample(const RayScene& rays, const CameraView& view, int i, int n, std::uint64_t* rays_cast);

}  // namespace aleph
