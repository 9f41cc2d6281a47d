#pragma once
// Suns, and all that is bright and small in the environment's picture: pieces of BrightEdges.

#include "render/shade/bright_edges.h"

namespace aleph {

/// Parts of the environment's picture as the camera shows them.
PicturePolygon project_cells(const CameraView& view, const ShadingScene& shading, const EnvironmentCells& cells,
                             int part);

/// Adds the parts of the environment in the filter of each pixel that are bright, and four times as bright as three
/// quarters of it or as white. Samples know others, which are not rare. Where all is at least white there are none: it
/// is shown white without them. An orthographic view shows one place of the sky alone: it has none.
void add_bright_sky(const ShadingScene& shading, const CameraView& view, PixelFilter filter, double exposure,
                    BrightEdges& edges);

}  // namespace aleph
