#include "render/cache/bounce_places.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "engine/base/pixel_loops.h"
#include "render/cache/further_bounces.h"
#include "render/path/path.h"
#include "render/surface/scatter.h"

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

constexpr float narrow_alpha = 0.0625f;  // GGX width up to which a lobe counts as a mirror: roughness .25
constexpr float least_weight = 0.1f;     // share of the light that mirrors have to reflect
constexpr int most_turns = 8;

/// The surface with narrow lobes as mirrors.
ViewedSurface narrow_lobes(ViewedSurface surface) {
    if (surface.material.gloss.alpha <= narrow_alpha && surface.material.gloss.stretch == 0.0f)
        surface.material.gloss.alpha = 0.0f;
    if (surface.material.coat.alpha <= narrow_alpha) surface.material.coat.alpha = 0.0f;
    return surface;
}

/// The turn at a mirror by which most light comes; weight 0 if there is none.
ScatterSample choose_turn(const LitSurface& lit) {
    ScatterSample best;
    for (const Lobe lobe : {Lobe::gloss, Lobe::coat, Lobe::glass}) {
        const SurfaceMaterial& material = lit.material;
        const bool is_smooth = lobe == Lobe::gloss  ? material.has_glossy() && material.is_mirror()
                               : lobe == Lobe::coat ? material.has_coat() && material.is_coat_mirror()
                                                    : material.has_glass() && material.is_glass_smooth();
        if (!is_smooth) continue;
        // Glass is looked through, unless it reflects everything.
        const ScatterSample turn = sample_scatter(lit, only_lobe(lobe), 0.0f, glm::vec2(0.0f), below_one);
        if (largest_channel(turn.weight) > largest_channel(best.weight)) best = turn;
    }
    return best;
}

/// Where a pixel's path arrives.
struct Arrival {
    Hit hit;  ///< its distance is that of the whole path, m
    glm::vec3 direction{0.0f};
    float weight = 0.0f;  ///< of the path
    ViewedSurface surface;
};

/// Follows mirrors from a pixel's surface.
std::optional<Arrival> follow_mirrors(const IndirectContext& context, const PixelSurface& first, RayTask& task) {
    const ShadingScene& shading = context.lighting.shading;
    const int turns = std::min(most_turns, context.settings.light.path_depth - 1 - count_bounces(context.settings));
    Arrival end{first.hit, -first.view, 1.0f, first};
    float distance = first.hit.distance;
    Media media = context.lighting.around;
    for (int turn = 0; turn < turns; ++turn) {
        ViewedSurface mirror = narrow_lobes(end.surface);
        if (mirror.material.glass.volume) mirror.material.glass.ior_ratio = media.ratio_at(mirror);
        const LitSurface lit(mirror);
        const ScatterSample sample = choose_turn(lit);
        end.weight *= largest_channel(sample.weight);
        if (!(end.weight >= least_weight)) return std::nullopt;
        if (sample.passes && mirror.material.glass.volume) media.pass(mirror.point, mirror.material);
        end.direction = sample.direction;
        ++task.counts.specular;
        end.hit = task.tracer.intersect({lit.ray_origin(end.direction), end.direction});
        if (end.hit.instance == no_index) return std::nullopt;
        end.hit.distance = distance += end.hit.distance;
        const SurfacePoint point = make_surface_point(shading, end.hit, end.direction);
        end.surface = view_surface(shading, point, -end.direction, {});
        if (end.surface.material.has_diffuse()) return end;
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

MirrorPlaces cast_mirror_places(const IndirectContext& context, const SampleHits& sample, RayCounts& counts) {
    const int width = sample.hits.width, height = sample.hits.height;
    const float pixel = 1.0f / static_cast<float>(context.view.pixels_per_unit);
    MirrorPlaces out{{Image<Hit>(width, height), Image<glm::vec3>(width, height), pixel * pixel},
                     Image<float>(width, height, 1.0f)};
    cast_parallel(height, 4, context.lighting.rays, counts, [&](int y, RayTask& task) {
        for (int x = 0; x < width; ++x) {
            if (sample.hits(x, y).instance == no_index) continue;
            const std::optional<PixelSurface> first = find_surface(context, sample, x, y);
            if (!first || !first->material.has_specular()) continue;
            const std::optional<Arrival> arrival = follow_mirrors(context, *first, task);
            if (!arrival) continue;
            const float accuracy = loosen_accuracy(context.accuracy(x, y), arrival->weight, 0.0f);
            PixelSurface place{arrival->surface};
            place.hit = arrival->hit;
            if (context.carried != nullptr && context.carried->find(place, accuracy, task)) continue;
            out.places.hits(x, y) = arrival->hit;
            out.places.directions(x, y) = arrival->direction;
            out.accuracy(x, y) = accuracy;
        }
    });
    out.any = std::ranges::any_of(out.places.hits.pixels, [](const Hit& hit) { return hit.instance != no_index; });
    return out;
}

void fill_mirror_places(IrradianceCache& cache, const IndirectContext& context, const SampleHits& sample,
                        FrameTally& tally) {
    MirrorPlaces mirrors = cast_mirror_places(context, sample, tally.counts.rays);
    if (!mirrors.any) return;
    IndirectContext mirrored = make_places_context(context, mirrors.accuracy);
    mirrored.tolerance = context.tolerance;
    fill_places(cache, mirrored, make_fill_places(context.lighting.shading, mirrors.places), tally);
}

}  // namespace aleph
