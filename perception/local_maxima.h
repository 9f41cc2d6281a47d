#pragma once
// Finds the local maxima that N(.) counts: 8-connected plateaus of a map quantised to 16 bits that are higher than all
// their neighbours. The map is |expansion of a small raster|; it is streamed in bands of rows, not stored.

#include <array>
#include <cstddef>
#include <vector>

#include "engine/base/image.h"
#include "engine/base/pyramid.h"

namespace aleph {

/// A map that is only known as a level's raster and the sizes of the levels; level 0: the raster itself.
struct ExpandedMap {
    const Image<float>* image;
    int level;
    const std::vector<LevelSize>* sizes;

    LevelSize size() const { return sizes->front(); }
};

/// A pixel not lower than any neighbour, with what lies around it: most plateaus are decided from that alone.
struct Candidate {
    static constexpr int reach = 3;
    static constexpr int side = 2 * reach + 1;

    int x, y;
    std::array<float, side * side> values;  ///< row by row; -1 outside the map

    float value() const { return values[side * side / 2]; }
};

struct MapScan {
    float minimum = 0.0f, maximum = 0.0f;
    std::vector<Candidate> candidates;  ///< in raster order; none below .1 of the maximum is needed or sure to be here
};

MapScan scan_map(const ExpandedMap& map);

/// Heights in (0, 1] of the map's local maxima after min-max to [0,1], those below .1 left out; one per plateau.
std::vector<double> find_local_maxima(const ExpandedMap& map, const MapScan& scan);

}  // namespace aleph
