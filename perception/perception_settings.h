#pragma once
// Settings of the vision model.

#include "perception/saliency/saliency_grid.h"
#include "perception/vision/band_frequencies.h"
#include "perception/vision/vision_list.h"

namespace aleph {

enum class Guide {
    none,      ///< no map: uniform accuracy
    spatial,   ///< v_I = 0
    full,      ///< S = .82 everywhere (3.1)
    saliency,  ///< S from the saliency map (5.5)
};

struct PerceptionSettings {
    Guide guide = Guide::saliency;
    const VisionModel* vision = &thesis_vision();  ///< of vision_list.h, or a program's own; never null
    Bands bands = Bands::printed;
    SaliencyGrid grid = SaliencyGrid::full;
    bool neutral_opponent = false;  ///< subtract what grey gives from C1 and C2

    bool operator==(const PerceptionSettings&) const = default;
};

}  // namespace aleph
