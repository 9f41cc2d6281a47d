#pragma once
// Settings of the vision model.

#include "perception/vision_list.h"

namespace aleph {

enum class Guide {
    none,      ///< no map: uniform accuracy
    spatial,   ///< v_I = 0
    full,      ///< S = .82 everywhere (3.1)
    saliency,  ///< S from the saliency map (5.5)
};

enum class Bands {
    printed,   ///< 16 8 4 2 1 .5 .25 cpd at 31 pixels per degree, as the thesis prints
    measured,  ///< 15.5 3.27 1.57 .79 .36 .18 .12: where these filters really peak
};

enum class SaliencyGrid {
    full,    ///< every level expanded to full size before N(.)
    center,  ///< differences and N(.) on the centre level's own grid: much cheaper, S correlates .99
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
