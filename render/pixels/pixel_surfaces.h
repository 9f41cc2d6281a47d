#pragma once
// The surface that each pixel sample shows, with its material.

#include "engine/pose/camera_view.h"
#include "engine/rays/first_hits.h"
#include "render/settings/settings.h"
#include "render/surface/surface_material.h"

namespace aleph {

/// A thin lens.
struct Lens {
    double radius = 0.0;          ///< m; 0: a pinhole
    double focus_distance = 1.0;  ///< m, from the camera to the plane that is sharp
};

/// How the rays of samples are placed. The same in all pixels but for the sequence of each.
struct SamplePlace {
    int index = 0;         ///< of the sample in its pixel
    bool centered = true;  ///< through the pixel's centre, whatever the filter
    float spacing = 1.0f;  ///< pixels between a pixel's samples; textures are averaged over it
    Lens lens{};
    PixelFilter filter = PixelFilter::box;  ///< that samples are distributed by
    std::uint32_t seed = 0, noise_key = 0;  ///< for the pixels' sequences
    Blend blend = Blend::cutout;            ///< what blended surfaces do to the rays
};

/// Where a sample lies along x or y, in pixels from the pixel's centre: distributed like the filter (filter importance
/// sampling, Ernst et al. 2006), so that every sample counts the same and belongs to one pixel alone.
/// @param u  uniform in [0,1)
double place_in_filter(PixelFilter filter, double u);
/// The density of these places along x or y, per pixel; 0 beyond them.
double filter_density(PixelFilter filter, double place);

/// Pixels between the samples of a pixel that is left after the stage of this one: 1 over the square root of their
/// number. Textures are averaged over it, so later samples of a pixel see them sharper.
float find_spacing(const RenderSettings& settings, int index);

/// Placing of sample `index` of the pixels. A single sample is the pixel's centre.
/// @param noise_key  key of random numbers: the same in all frames if their noise is (Shot::keeps_noise)
SamplePlace make_sample_place(const RenderSettings& settings, const Lens& lens, bool blended, std::uint32_t noise_key,
                              int index);

/// Where a sample lies in the picture, in pixels.
glm::dvec2 place_sample(const SamplePlace& place, int x, int y);

/// One sample of every pixel.
struct SampleHits {
    Image<Hit> hits;
    SamplePlace place;
};

/// The ray through a place in the picture (pixels) from a point of a lens that is open.
/// @param u  the point of the lens, in [0,1)^2
CameraRay make_lens_ray(const CameraView& view, const Lens& lens, const glm::dvec2& pixel, const glm::vec2& u);

/// The ray of a pixel's sample, from its point on the lens. In double, so that no focus distance is too far.
CameraRay make_sample_ray(const CameraView& view, const SamplePlace& place, int x, int y);

/// The surface of one pixel sample.
struct PixelSurface : ViewedSurface {
    Hit hit{};                ///< of the sample's ray; its distance is from the camera
    float footprint = 0.0f;   ///< size of a pixel at that distance, m
    int x = 0, y = 0;         ///< of the pixel
    int sample = 0;           ///< which of the pixel's samples
    std::uint32_t pixel = 0;  ///< y * width + x, for random numbers
};

/// @param direction  of the sample's ray, unit
/// @param hit        of that ray: a surface
PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SamplePlace& place,
                                const Hit& hit, const glm::vec3& direction, const glm::ivec2& pixel);
/// Undefined if the pixel's ray hit nothing.
PixelSurface make_pixel_surface(const ShadingScene& shading, const CameraView& view, const SampleHits& sample, int x,
                                int y);

/// Casts one sample of every pixel.
/// @param rays_cast  increased by the number of rays; may be null
SampleHits cast_sample(const RayScene& rays, const CameraView& view, const SamplePlace& place,
                       std::uint64_t* rays_cast);

/// Through the centre of every pixel, without a lens. Blended surfaces are holes where their alpha is below a half.
SampleHits cast_centers(const RayScene& rays, const CameraView& view, std::uint64_t* rays_cast);

}  // namespace aleph
