#include "render/shade/bright_edges.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "engine/base/pixel_loops.h"
#include "engine/rays/first_hits.h"
#include "render/shade/bright_sky.h"

namespace aleph {

namespace {

constexpr int reach = 2;            // pixels, of filters
constexpr double covered = 0.9999;  // share of a filter's square that lamps cover where no outline is

constexpr double small_lamp = 0.5;  // pixels: radius
constexpr std::size_t few_triangles = 8;
constexpr double least_filled = 0.8;  // share of an outline

enum Seen : std::uint8_t { seen_surface, seen_lamp, seen_sky, seen_bright_sky };

/// @param direction  of the ray that met it
Seen find_seen(const ShadingScene& shading, const Hit& hit, const glm::vec3& direction, double exposure) {
    if (hit.instance == no_index)
        return luminance(environment_radiance(shading, direction)) * exposure >= least_bright ? seen_bright_sky
                                                                                              : seen_sky;
    const ShadingMaterial& material = shading.materials[shading.instances[hit.instance].material];
    const bool is_bright = material.emits && luminance(material.values.emission) * exposure >= least_bright;
    return is_bright ? seen_lamp : seen_surface;
}

/// Tells what the centres of all pixels show, and of those within reach around the picture.
Image<std::uint8_t> look_at_centers(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                                    double exposure, std::uint64_t& rays_cast) {
    const int width = centers.hits.width, height = centers.hits.height;
    Image<std::uint8_t> seen(width + 2 * reach, height + 2 * reach);
    const auto make_ray = [&](int x, int y) { return make_sample_ray(view, centers.place, x, y); };
    const auto mark = [&](int left, int top, const Image<Hit>& hits) {
        parallel_pixels(hits, 16, [&](int x, int y) {
            const glm::vec3 direction(make_ray(left + x, top + y).direction);
            seen(left + x + reach, top + y + reach) = find_seen(context.shading, hits(x, y), direction, exposure);
        });
    };
    mark(0, 0, centers.hits);
    // Filters of the outermost pixels reach beyond the picture.
    for (const auto& [left, top, columns, rows] :
         {std::array{-reach, -reach, width + 2 * reach, reach}, std::array{-reach, height, width + 2 * reach, reach},
          std::array{-reach, 0, reach, height}, std::array{width, 0, reach, height}}) {
        Image<Hit> hits(columns, rows);
        cast_rays(
            context.rays, [&](int x, int y) { return make_ray(left + x, top + y); }, centers.place.blend, hits);
        rays_cast += hits.size();
        mark(left, top, hits);
    }
    return seen;
}

enum Share : std::uint8_t { share_none, share_some, share_all };

/// Share of the centres around each pixel that show what is asked for.
template <class IsAsked>
Image<std::uint8_t> find_shares(const Image<std::uint8_t>& seen, const IsAsked& is_asked) {
    Image<std::uint8_t> shares(seen.width - 2 * reach, seen.height - 2 * reach);
    parallel_pixels(shares, 16, [&](int x, int y) {
        bool any = false, all = true;
        visit_around(seen, x + reach, y + reach, reach, [&](int nx, int ny) {
            any = any || is_asked(seen(nx, ny));
            all = all && is_asked(seen(nx, ny));
        });
        shares(x, y) = all ? share_all : any ? share_some : share_none;
    });
    return shares;
}

/// Adds a piece of a lamp to the pixels in whose filters it lies, where lamps are not all that they show.
/// @param areas  per pixel: pixels, of all its pieces
void add_piece(const PicturePolygon& polygon, PixelFilter filter, const Image<std::uint8_t>& lamp_shares,
               BrightPiece piece, std::vector<BrightPiece>& out, Image<float>& areas) {
    if (polygon.count < 3) return;
    glm::dvec2 low = polygon.corners[0], high = low;
    for (int i = 1; i < polygon.count; ++i) {
        low = glm::min(low, polygon.corners[i]);
        high = glm::max(high, polygon.corners[i]);
    }
    const double radius = place_in_filter(filter, 1.0);
    const auto begin = [&](double least, int size) {
        return static_cast<int>(std::clamp(std::floor(least - radius - 0.5), 0.0, static_cast<double>(size)));
    };
    const auto end = [&](double most, int size) {
        return static_cast<int>(std::clamp(std::ceil(most + radius + 0.5), 0.0, static_cast<double>(size)));
    };
    for (int y = begin(low.y, areas.height); y < end(high.y, areas.height); ++y) {
        for (int x = begin(low.x, areas.width); x < end(high.x, areas.width); ++x) {
            if (lamp_shares(x, y) == share_all) continue;
            const glm::dvec2 middle(x + 0.5, y + 0.5);
            const double area = area_of(clip_to_rectangle(polygon, middle - radius, middle + radius));
            if (!(area > 0.0)) continue;
            piece.x = x;
            piece.y = y;
            out.push_back(piece);
            areas(x, y) += static_cast<float>(area);
        }
    }
}

/// Returns whether the camera may see the side that emits.
bool faces_camera(const CameraView& view, const ShadingScene& shading, const Emitter::Triangle& triangle) {
    const glm::dvec3 corner = shading.anchor + glm::dvec3(triangle.corner);
    const glm::dvec3 towards = view.orthographic ? view.axes[2] : view.position - corner;
    return glm::dot(towards, glm::dvec3(triangle.normal)) > 0.0;
}

PicturePolygon project(const CameraView& view, const ShadingScene& shading, const Emitter::Triangle& triangle) {
    const glm::dvec3 corner = shading.anchor + glm::dvec3(triangle.corner);
    return project_triangle(view, {corner, corner + glm::dvec3(triangle.edge1), corner + glm::dvec3(triangle.edge2)});
}

/// Visits the triangles whose emission the camera may see.
/// @param visit  (primitive, polygon)
template <class Visit>
void visit_triangles(const CameraView& view, const ShadingScene& shading, const Emitter& lamp, const Visit& visit) {
    for (std::size_t i = 0; i < lamp.size(); ++i) {
        const Emitter::Triangle triangle = lamp.triangle(i);
        if (lamp.double_sided || faces_camera(view, shading, triangle))
            visit(triangle.primitive, project(view, shading, triangle));
    }
}

/// The outline of a lamp of many triangles that is smaller than a pixel and fills it, or no corners.
PicturePolygon find_outline(const CameraView& view, const ShadingScene& shading, const Emitter& lamp) {
    const glm::dvec3 center = shading.anchor + glm::dvec3(lamp.center);
    if (lamp.size() <= few_triangles || !project_small_sphere(view, center, lamp.radius, small_lamp)) return {};
    PictureOutline outline;
    double area = 0.0;
    visit_triangles(view, shading, lamp, [&](int, const PicturePolygon& polygon) {
        outline.add(polygon);
        area += area_of(polygon);
    });
    const PicturePolygon around = outline.polygon();
    return area >= least_filled * area_of(around) ? around : PicturePolygon{};
}

}  // namespace

PicturePolygon project_piece(const CameraView& view, const ShadingScene& shading, const BrightEdges& edges,
                             const BrightPiece& piece) {
    if (piece.instance == no_index) return project_cells(view, shading, *edges.cells, piece.primitive);
    if (piece.outline != no_index) return edges.outlines[piece.outline];
    return project(view, shading, place_triangle(shading.instances[piece.instance], piece.primitive));
}

BrightEdges find_bright_edges(const LightingContext& context, const CameraView& view, const SampleHits& centers,
                              PixelFilter filter, double exposure, std::uint64_t& rays_cast) {
    const Image<std::uint8_t> seen = look_at_centers(context, view, centers, exposure, rays_cast);
    BrightEdges edges;
    edges.sky = find_shares(seen, [](std::uint8_t s) { return s == seen_bright_sky; });
    const Image<std::uint8_t> around = find_shares(seen, [](std::uint8_t s) { return s < seen_sky; });
    for (std::size_t i = 0; i < around.size(); ++i)
        edges.sky.pixels[i] = edges.sky.pixels[i] != share_none && around.pixels[i] != share_none ? 1 : 0;
    const Image<std::uint8_t> shares = find_shares(seen, [](std::uint8_t s) { return s == seen_lamp; });
    Image<float> areas(shares.width, shares.height);
    for (const Emitter& lamp : context.lights.emitters) {
        if (luminance(lamp.brightest) * exposure < least_bright) continue;
        const BrightPiece whole{.instance = lamp.instance, .outline = static_cast<int>(edges.outlines.size())};
        if (const PicturePolygon outline = find_outline(view, context.shading, lamp); outline.count > 0) {
            edges.outlines.push_back(outline);
            add_piece(outline, filter, shares, whole, edges.pieces, areas);
            continue;
        }
        visit_triangles(view, context.shading, lamp, [&](int primitive, const PicturePolygon& polygon) {
            add_piece(polygon, filter, shares, {.instance = lamp.instance, .primitive = primitive}, edges.pieces,
                      areas);
        });
    }
    // A piece that covers a filter and shows at no centre around is hidden.
    const double side = 2.0 * place_in_filter(filter, 1.0);
    std::erase_if(edges.pieces, [&](const BrightPiece& triangle) {
        return shares(triangle.x, triangle.y) == share_none && areas(triangle.x, triangle.y) >= covered * side * side;
    });
    add_bright_sky(context.shading, view, filter, exposure, edges);
    std::ranges::stable_sort(edges.pieces, {}, [](const BrightPiece& t) { return std::pair(t.y, t.x); });
    return edges;
}

}  // namespace aleph
