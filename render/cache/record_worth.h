#pragma once
// Where a record costs less than the rays of samples that do without one.
//
// A record casts hundreds of rays, and is read within its reach. Beside small things its reach is a pixel or two, and
// the few rays that every sample of these pixels would cast by itself cost less: unless their light varies so much with
// direction that the pixels would need many more samples.
//
// All samples of a pixel share the noise of its records, so the rule that stops sampling does not know it. Where few
// rays meet most of the light, a record takes more of them.

#include "render/cache/irradiance_cache.h"

namespace aleph {

/// Rays over the hemisphere of a sample whose irradiance no record knows.
inline constexpr int sample_rays = 2;

/// Returns whether a record pays.
/// @param expected   of a record there
/// @param footprint  m, of a pixel
/// @param accuracy   alpha of the pixel
/// @param reflected  luminance of radiance over irradiance
/// @param tolerance  luminance that the mean of the pixel's samples may err by
/// @param rays       of the record's gather
bool is_worth_record(const ExpectedRecord& expected, float footprint, float accuracy, float reflected, float tolerance,
                     int rays);

/// Returns the rays, at least `rays` and at most most_rays, that bring the noise of a record below what the pixel's
/// samples may have.
/// @param expected, reflected, tolerance  as above
int add_rays_for_noise(int rays, const ExpectedRecord& expected, float reflected, float tolerance);

}  // namespace aleph
