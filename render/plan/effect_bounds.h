#pragma once
// How much an effect can change a picture, at most: from boxes and brightness alone. All radiances are before exposure.

#include "render/pixels/pixel_filter.h"
#include "render/plan/effect_facts.h"

namespace aleph {

/// Illuminance that a light can bring to surfaces in a box, without shadows. Infinite where a point light may touch it.
double largest_illuminance(const LightFacts& light, const Bounds& box);

/// Sets ObjectFacts::lit_radiance. The functions below need it.
void bound_direct_light(FrameFacts& facts);

/// Whether anything may stand between a light and a surface.
bool may_be_shadowed(const FrameFacts& facts, const LightFacts& light);

/// Radiance that pixels can have of indirect light: what each surface that is seen can receive from all others, by the
/// solid angles of spheres around them. 0 where no surface sees another.
/// @param bounces  of indirect light
double bound_indirect_light(const FrameFacts& facts, int bounces);

/// Of it, what comes after the first `bounces` bounces: by the largest albedo alone.
/// @param most  bounces in all
double bound_further_bounces(const FrameFacts& facts, int bounces, int most);

/// Radiance that pixels can have from lobes that have a width.
double bound_glossy_light(const FrameFacts& facts, int bounces);

/// Radiance that a light can bring to pixels.
double bound_light(const FrameFacts& facts, const LightFacts& light, int bounces);

/// How far blur moves what a pixel shows, in pixels: over the shutter's time, or over the lens.
struct BlurMoments {
    double mean = 0.0;         ///< distance from where the sharp picture has it
    double shift = 0.0;        ///< length of the mean displacement
    double mean_square = 0.0;  ///< of the distance
};

/// What blur can change, as a share of the picture's contrast: by the slope and the curvature that a picture can have
/// behind the filter. Taylor's theorem; what moves alike to both sides of its place cancels to first order.
double bound_blur(const BlurMoments& blur, PixelFilter filter);

}  // namespace aleph
