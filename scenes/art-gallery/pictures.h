#pragma once
// The paintings and surfaces of the gallery, drawn from formulas. Deterministic.

#include <vector>

#include "scenes/common/generator.h"

namespace aleph {

/// Fourteen paintings, with the aspect ratios of their frames.
std::vector<DrawnTexture> make_painted_pictures();   ///< strokes and marks on a ground
std::vector<DrawnTexture> make_computed_pictures();  ///< a colour for every point

/// "parquet", "marble", "oak", "weave", "terracotta", "top", "ball_0" to "ball_5": all repeat without a seam.
std::vector<DrawnTexture> make_gallery_surfaces();

/// All of these.
std::vector<DrawnTexture> make_gallery_textures();

}  // namespace aleph
