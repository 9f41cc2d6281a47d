#pragma once
// How many pixels of two pictures a viewer would tell apart: Yee and Newman 2004, "A Perceptual Metric for Production
// Testing", SIGGRAPH Sketches. Purely spatial; the baseline that Aleph thresholds are compared with.
//
// OpenImageIO 2.4.7 has this metric too (ImageBufAlgo::compare_Yee), but that version reads a missing channel as the
// luminance: black passes against white. Hence this one.
// Where the paper leaves a choice: bands are differences of a picture blurred repeatedly at full resolution; adaptation
// is ours (mean within half a degree); the colour test fades linearly below 10 cd/m2.

#include <cstddef>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "engine/base/viewing.h"

namespace aleph {

/// @param a,b  linear RGB, Rec.709, finite, of one size; what lies below black counts as black
std::size_t count_visible_differences(const Image<Rgb>& a, const Image<Rgb>& b, const ViewingConditions& viewing);

}  // namespace aleph
