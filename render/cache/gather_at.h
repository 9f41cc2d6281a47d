#pragma once
// A gather at a pixel: how many rays, and from which random numbers.

#include <optional>

#include "render/cache/indirect_context.h"

namespace aleph {

/// The rays of a record's gather, where their number follows from the light.
inline constexpr int most_rays = 8192;

/// Rays for a gather at a pixel's accuracy. With CacheSettings::gather 0, as many as bring its standard error to a
/// fifth of the accuracy, from 64 to most_rays; otherwise that number at the frame's accuracy. Where the accuracy is
/// looser, fewer by its square.
/// @param ray_variance  relative, of one ray; nothing where it is not known
int choose_rays(const RenderSettings& settings, float accuracy, const std::optional<float>& ray_variance);

/// Rays, within these bounds, that bring the standard error of a gather to `noise`, relative.
/// @param ray_variance  relative, of one ray
int choose_rays_for_noise(double ray_variance, double noise, int fewest, int most);

/// Gathers the irradiance at one pixel sample.
/// @param found  samples of direct light for the grid of the context; null: they are dropped
IrradianceSample gather_at(const IndirectContext& context, RayTask& task, const PixelSurface& surface,
                           GatherScratch& scratch, int rays, std::vector<DirectSample>* found = nullptr);

/// Rays over the hemisphere of a sample whose irradiance no record knows.
inline constexpr int sample_rays = 2;

/// Returns the rays, at least `rays` and at most most_rays, that bring the noise of a record below what the pixel's
/// samples may have.
/// @param min_radius  m, of RadiusBounds
int add_rays_for_noise(int rays, const ExpectedRecord& expected, float reflected, float tolerance, float min_radius);

}  // namespace aleph
