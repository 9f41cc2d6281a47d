#pragma once
// Counts the pixels in which a viewer would see a difference between two pictures: Yee and Newman 2004, "A Perceptual
// Metric for Production Testing", SIGGRAPH Sketches. It considers neither motion nor saliency; Aleph thresholds are
// compared with it.
//
// OpenImageIO 2.4.7 has this metric too (ImageBufAlgo::compare_Yee), but that version takes the luminance from a
// missing channel, so that black passes against white. Where the paper leaves a choice: bands are differences of a
// picture blurred repeatedly at full resolution; adaptation is ours (mean within half a degree); the colour test fades
// linearly below 10 cd/m2.

#include <cstddef>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// @param a,b  linear RGB, Rec.709, finite, of one size; negative values count as 0
std::size_t count_visible_differences(const Image<Rgb>& a, const Image<Rgb>& b, const ViewingConditions& viewing);

}  // namespace aleph
