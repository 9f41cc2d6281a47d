#pragma once
// Outlines of lamps, windows and the sky. A lamp of a thousand times the brightness around it doubles that of a pixel
// whose filter it covers by a thousandth. Hardly any sample meets it, and without one the pixel's variance looks small.

#include <vector>

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/shade/picture_polygon.h"

namespace aleph {

/// A triangle of a lamp that lies in the filter of a pixel, whether something hides it or not.
struct LampTriangle {
    int x = 0, y = 0;  ///< of the pixel
    int instance = no_index, primitive = no_index;
};

struct BrightEdges {
    Image<std::uint8_t> sky;          ///< 1: an outline of the environment may cross the pixel; else 0
    std::vector<LampTriangle> lamps;  ///< of the pixels that do not show lamps alone, row by row
};

/// The triangle as the picture shows it.
PicturePolygon project_lamp(const CameraView& view, const ShadingScene& shading, const LampTriangle& triangle);

/// @param filter     of the pixels' samples
/// @param exposure   brighter than about half of white counts
/// @param rays_cast  counts those around the picture
BrightEdges find_bright_edges(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              PixelFilter filter, double exposure, std::uint64_t& rays_cast);

}  // namespace aleph
