#pragma once
// A part of a picture that stands for the whole, to measure what the whole costs.

#include <cstdint>

#include "engine/base/image.h"
#include "engine/rays/hit.h"

namespace aleph {

using PicturePart = Image<std::uint8_t>;  ///< 1: the pixel belongs to it

/// Every `every`th block of the picture, on a lattice: each row and each column of blocks has about its share of them.
/// @param every  1 or more; 1: the whole picture
/// @param block  pixels, width and height
PicturePart choose_part(int width, int height, int every, int block);

/// Its share of all pixels, 0 to 1.
double find_share(const PicturePart& part);

/// Hits of other pixels become misses, so that no light is computed for them.
void forget_others(const PicturePart& part, Image<Hit>& hits);

}  // namespace aleph
