#include "render/cache/bounce_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/pixel_loops.h"
#include "render/cache/gather_at.h"

namespace aleph {

namespace {

constexpr double pixels_per_surface = 10.0, fewest_surfaces = 300.0, most_surfaces = 2000.0;  // per view, about
constexpr int rays_per_surface = 16;
constexpr float filling_rays = 1024.0f;  // of the gather whose ray has the footprint that bounds radii

/// Keeps the directions apart from those of gathers at the same places.
constexpr std::uint32_t places_seed_mask = 0x626f756eu;

/// The first pixel of a few in this tile whose light has to be computed.
std::optional<PixelSurface> find_in_tile(const IndirectContext& context, const SampleHits& sample, glm::ivec2 corner,
                                         int size, RayTask& task) {
    constexpr int tries = 2;  // along each side
    for (int i = 0; i < tries * tries; ++i) {
        const int x = corner.x + (2 * (i % tries) + 1) * size / (2 * tries);
        const int y = corner.y + (2 * (i / tries) + 1) * size / (2 * tries);
        if (x >= sample.hits.width || y >= sample.hits.height) continue;
        if (std::optional<PixelSurface> surface = find_needed(context, sample, x, y, task)) return surface;
    }
    return std::nullopt;
}

}  // namespace

void add_seen_surfaces(const IndirectContext& context, const SampleHits& sample, std::vector<PixelSurface>& surfaces,
                       RayCounts& counts) {
    const double pixels = static_cast<double>(sample.hits.size());
    const double wanted = std::clamp(pixels / pixels_per_surface, fewest_surfaces, most_surfaces);
    const int size = std::max(1, static_cast<int>(std::lround(std::sqrt(pixels / wanted))));
    RayTask task(context.lighting.rays);
    for (int y = 0; y < sample.hits.height; y += size) {
        for (int x = 0; x < sample.hits.width; x += size) {
            const std::optional<PixelSurface> surface = find_in_tile(context, sample, {x, y}, size, task);
            if (surface) surfaces.push_back(*surface);
        }
    }
    counts += task.counts;
}

BouncePlaces cast_bounce_places(const LightingContext& lighting, const std::vector<PixelSurface>& surfaces,
                                std::uint32_t seed, RayCounts& counts) {
    const HemisphereStrata strata = choose_strata(rays_per_surface);
    const int rows = static_cast<int>(surfaces.size());
    BouncePlaces places{Image<Hit>(strata.count(), rows), Image<glm::vec3>(strata.count(), rows),
                        std::numbers::pi_v<float> / filling_rays};
    cast_parallel(surfaces.size(), 8, lighting.rays, counts, [&](int y, RayTask& task) {
        const SurfacePoint& point = surfaces[y].point;
        RandomStream random(make_place_key(seed ^ places_seed_mask, surfaces[y].hit));
        const CellNumbers numbers(random);
        const Basis basis = make_basis(point.normal);
        for (int cell = 0; cell < strata.count(); ++cell) {
            const int row = cell / strata.columns, column = cell % strata.columns;
            const glm::vec2 u =
                (glm::vec2(row, column) + numbers.place(row, column)) / glm::vec2(strata.rows, strata.columns);
            const glm::vec3 direction = basis.to_world(sample_cosine_hemisphere(u));
            places.directions(cell, y) = direction;
            if (!(glm::dot(direction, point.geometric) > 0.0f)) continue;
            places.hits(cell, y) = task.tracer.intersect({point.ray_origin(), direction});
            ++task.counts.gather;
        }
    });
    return places;
}

PixelSurface make_bounce_surface(const ShadingScene& shading, const BouncePlaces& places, int x, int y) {
    const Hit& hit = places.hits(x, y);
    const glm::vec3& direction = places.directions(x, y);
    const SurfacePoint point = make_surface_point(shading, hit, direction);
    const RayFootprint footprint = make_cone_footprint(point, direction, hit.distance, places.solid_angle);
    PixelSurface surface{view_surface(shading, point, -direction, footprint)};
    surface.hit = hit;
    surface.distance = hit.distance;
    surface.footprint = hit.distance * std::sqrt(places.solid_angle);
    surface.x = x;
    surface.y = y;
    surface.pixel = static_cast<std::uint32_t>(places.hits.index(x, y));
    return surface;
}

FillPlaces make_fill_places(const ShadingScene& shading, const BouncePlaces& places) {
    FillPlaces fill;
    fill.points = Image<FillPoint>(places.hits.width, places.hits.height);
    fill.surface_at = [&](int x, int y) { return make_bounce_surface(shading, places, x, y); };
    parallel_pixels(places.hits, 8, [&](int x, int y) {
        if (places.hits(x, y).instance == no_index) return;
        const PixelSurface surface = make_bounce_surface(shading, places, x, y);
        if (surface.material.has_diffuse()) fill.points(x, y) = make_fill_point(surface);
    });
    return fill;
}

}  // namespace aleph
