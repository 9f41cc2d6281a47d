#pragma once
// N(.), the global non-linear normalization of Itti, Koch and Niebur 1998 (Yee 2000, section 5.3): promotes maps with
// one outstanding peak, suppresses maps with many peaks of similar height.

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

/// N(F) = scale() * (F - minimum). A map whose range is not above its floor becomes 0.
struct Normalization {
    double minimum = 0.0, maximum = 0.0;
    double weight = 0.0;  ///< (1 - m)^2, m: mean of all local maxima of the map in [0,1] except one global maximum
    bool empty = true;    ///< range not above the floor

    double scale() const { return empty ? 0.0 : weight / (maximum - minimum); }
};

/// N(.) of |map|. If the global maximum is the only local maximum, m = 0.
/// @param floor  smallest range that is not noise, in the map's unit
Normalization compute_normalization(const ExpandedMap& map, double floor);

/// The same of a raster.
Normalization compute_normalization(const Image<float>& map, double floor);

}  // namespace aleph
