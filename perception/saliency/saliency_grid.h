#pragma once
// On which grids saliency is computed.

namespace aleph {

enum class SaliencyGrid {
    full,    ///< every level expanded to full size before N(.)
    center,  ///< differences and N(.) on the centre level's own grid: much cheaper, S correlates .99
};

}  // namespace aleph
