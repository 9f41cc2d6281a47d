#pragma once
// Image-based motion, Yee 2000, 5.1.1: a hierarchical search for the census-transformed neighbourhood of every pixel in
// the other frame. motion/README.md has its limits; white noise has no coarse level to search.

#include <cstdint>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/image.h"
#include "motion/motion_field.h"

namespace aleph {

/// Census of one Gaussian level: a byte per pixel, a bit per neighbour (raster order, 1 where neighbour >= centre).
/// One pixel of border on every side repeats the edge, so that 3x3 windows need no test.
struct CensusLevel {
    int width = 0, height = 0;       ///< without the border
    std::vector<std::uint8_t> bits;  ///< (height + 2) rows of width + 2 bytes, and a few spare bytes for wide reads

    const std::uint8_t* row(int y) const {  ///< y from -1 to height; [-1] to [width] may be read
        return bits.data() + static_cast<std::size_t>(y + 1) * static_cast<std::size_t>(width + 2) + 1;
    }
};

/// From the finest level, 0. Made once for a frame, which is first N+1 and then N.
using CensusPyramid = std::vector<CensusLevel>;

/// Compares the achromatic channel A. NaN and components below 0 count as 0 (opponent_color.h).
/// Three levels; those whose shorter side is under 8 pixels are left out, but never level 0.
CensusPyramid make_census_pyramid(const Image<Rgb>& frame);

/// The census of one level; neighbours beyond the border are the nearest pixel inside.
CensusLevel make_census_level(const Image<float>& level);

/// Whole pixels, for every pixel. Cost of an offset: sum of Hamming distances over 3x3, borders clamped; targets
/// outside the frame are excluded. Exhaustive within 8 pixels at the coarsest level; at each finer level three steps
/// (4, 2, 1) from twice the coarser result (of pixel floor(x/2), floor(y/2); brought back inside where it leads one
/// pixel out). Ties go to the smaller |offset|^2, then dy, then dx, so that areas without texture stand still. Reach:
/// 53 pixels with three levels, 23 with two, 8 with one. All pixels are `valid`.
/// @throws InputError if the sizes differ or are empty
MotionField compute_image_motion(const CensusPyramid& now, const CensusPyramid& other);
MotionField compute_image_motion(const Image<Rgb>& now, const Image<Rgb>& other);

}  // namespace aleph
