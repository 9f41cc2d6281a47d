#pragma once
// The local maxima that N(.) averages: 8-connected plateaus of a map quantised to 16 bits that are higher than all
// their neighbours. The map is |expansion of a small raster|. It is streamed row by row, never stored: what is kept is
// one position per possible maximum and the rows of plateaus of more than one pixel.

#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"

namespace aleph {

/// A map at full size, given as the raster of a level and the sizes of all levels; level 0: the raster itself.
struct ExpandedMap {
    const Image<float>* image;
    int level;
    const std::vector<LevelSize>* sizes;

    LevelSize size() const { return sizes->front(); }
};

struct LocalMaxima {
    float minimum = 0.0f, maximum = 0.0f;  ///< of the map
    /// Heights in [.1, 1] after min-max of the map to [0,1], lower ones left out; one per plateau, in raster order.
    /// Empty where the map's range is not above the floor.
    std::vector<double> heights;
};

/// @param floor  smallest range of a map that is not noise, at least 0, in the map's unit
LocalMaxima find_local_maxima(const ExpandedMap& map, double floor);

}  // namespace aleph
