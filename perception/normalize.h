#pragma once
// N(.), the global non-linear normalization of Itti, Koch and Niebur 1998 (thesis 5.3, MODEL 5.3): promotes maps with
// one outstanding peak, suppresses maps with many alike.

#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"

namespace aleph {

/// N(F) = scale() * (F - minimum). A map whose range is not above its floor becomes 0.
struct Normalization {
    double minimum = 0.0, maximum = 0.0;
    double weight = 0.0;  ///< (1 - m)^2; m: mean of all local maxima of the map in [0,1] but one global maximum
    bool empty = true;    ///< range not above the floor

    double scale() const { return empty ? 0.0 : weight / (maximum - minimum); }
};

/// N(.) of the map |expansion of `level_image` to level 0|, which is never stored.
/// Local maxima are 8-connected plateaus of the map quantised to 16 bits that are higher than all their neighbours;
/// those under .1 are dropped; m = 0 where only the global maximum is left.
/// @param level_image  raster of level `level` of `sizes`; level 0: the map itself
/// @param floor        smallest range that is not noise, in the map's unit
Normalization compute_normalization(const Image<float>& level_image, int level, const std::vector<LevelSize>& sizes,
                                    double floor);

/// The same of a whole map.
Normalization compute_normalization(const Image<float>& map, double floor);

}  // namespace aleph
