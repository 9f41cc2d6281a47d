#pragma once
// A part of a picture: what is wanted of it, or what stands for the whole, to measure what that costs.

#include <cstdint>

#include "engine/base/picture_area.h"
#include "engine/rays/hit.h"

namespace aleph {

using PicturePart = Image<std::uint8_t>;  ///< 1: the pixel belongs to it

/// Every `every`th block of the picture, on a lattice: each row and each column of blocks has about its share of them.
/// @param every  1 or more; 1: the whole picture
/// @param block  pixels, width and height
PicturePart choose_part(int width, int height, int every, int block);

/// Adds the pixels of an area, and those up to so many pixels around it.
void mark_area(PicturePart& part, const PictureArea& area, int around);

/// Its share of all pixels, 0 to 1.
double find_share(const PicturePart& part);

/// Hits of other pixels become misses, so that no light is computed for them.
void forget_others(const PicturePart& part, Image<Hit>& hits);

}  // namespace aleph
