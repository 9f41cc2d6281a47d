#pragma once
// Outlines of lamps, windows and the sky, and suns. A lamp of a thousand times the brightness around it doubles that of
// a pixel whose filter it covers by a thousandth. Hardly any sample meets it, and without one the pixel's variance
// looks small.

#include <optional>
#include <vector>

#include "render/light/light_choice.h"
#include "render/pixels/pixel_surfaces.h"
#include "render/shade/picture_polygon.h"
#include "render/surface/environment_cells.h"

namespace aleph {

inline constexpr double least_bright = 0.5;  ///< luminance, of white

/// A triangle of a lamp, all of a lamp that is smaller than a pixel, or a bright part of the environment's picture,
/// that lies in the filter of a pixel, whether something hides it or not.
struct BrightPiece {
    int x = 0, y = 0;          ///< of the pixel
    int instance = no_index;   ///< none: the environment
    int primitive = no_index;  ///< none: all of a lamp
    int outline = no_index;    ///< into BrightEdges::outlines, of all of a lamp

    bool contains(int of_instance, int of_primitive) const {
        return instance == of_instance && (primitive == of_primitive || outline != no_index);
    }
};

struct BrightEdges {
    Image<std::uint8_t> sky;  ///< 1: an outline of a surface before the bright environment may cross the pixel; else 0
    std::optional<EnvironmentCells> cells;  ///< of the environment's picture; none: it has no pieces
    std::vector<PicturePolygon> outlines;   ///< of lamps that are pieces as a whole
    std::vector<BrightPiece> pieces;        ///< of the pixels that do not show lamps alone, row by row
};

/// The piece as the picture shows it.
PicturePolygon project_piece(const CameraView& view, const ShadingScene& shading, const BrightEdges& edges,
                             const BrightPiece& piece);

/// @param filter     of the pixels' samples
/// @param exposure   for least_bright
/// @param rays_cast  counts those around the picture
BrightEdges find_bright_edges(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              PixelFilter filter, double exposure, std::uint64_t& rays_cast);

}  // namespace aleph
