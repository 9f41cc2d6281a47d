#pragma once
// How the samples of a frame's pixels are placed.

#include "render/pixels/pixel_surfaces.h"
#include "render/settings/settings.h"

namespace aleph {

/// Pixels between the samples of a pixel that is left after the stage of this one: 1 over the square root of their
/// number. Textures are averaged over it, so later samples of a pixel see them sharper.
float find_spacing(const RenderSettings& settings, int index);

/// Placing of sample `index` of the pixels. A single sample is the pixel's centre.
/// @param noise_key  key of random numbers: the same in all frames if their noise is (Shot::keeps_noise)
SamplePlace make_sample_place(const RenderSettings& settings, const Lens& lens, bool blended, std::uint32_t noise_key,
                              int index);

}  // namespace aleph
