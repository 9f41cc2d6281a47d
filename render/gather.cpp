#include "render/gather.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/gather_summary.h"

namespace aleph {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float min_ray_cosine = 0.05f;  // limits the solid angle of cells at the horizon
constexpr float least_rise = 1e-6f;      // of a unit direction above the true surface: below it, rounding decides
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Sets how many rays each cell takes. Returns their number.
int divide_cells(const HemisphereStrata& strata, std::span<const DividedCell> divided, GatherScratch& scratch) {
    scratch.sides.assign(static_cast<std::size_t>(strata.count()), 1);
    int rays = strata.count();
    for (const DividedCell& cell : divided) {
        scratch.sides[cell.cell] = static_cast<std::uint8_t>(cell.side);
        rays += cell.side * cell.side - 1;
    }
    return rays;
}

/// The rays of all cells that are above the true surface.
void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePoint& point,
                const CellNumbers& numbers, GatherScratch& scratch) {
    scratch.rays.clear();
    scratch.places.clear();
    scratch.below.assign(static_cast<std::size_t>(strata.count()), 0);
    const glm::vec3 origin = point.ray_origin();
    const auto place_ray = [&](const RayPlace& place, int side) {
        const glm::vec2 parts = glm::vec2(strata.rows, strata.columns) * static_cast<float>(side);
        const glm::vec2 u = (glm::vec2(place.row, place.column) + numbers.place(place.row, place.column)) / parts;
        const glm::vec3 direction = basis.to_world(sample_cosine_hemisphere(u));
        if (glm::dot(direction, point.geometric) <= least_rise) return;
        scratch.rays.push_back({origin, direction});
        scratch.places.push_back(place);
    };
    visit_blocks(strata, [&](int cell, int row, int column) {
        const std::size_t before = scratch.rays.size();
        const int side = scratch.sides[cell];
        const float share = 1.0f / static_cast<float>(side * side);
        for (int part = 0; part < side * side; ++part) {
            place_ray({cell, row * side + part / side, column * side + part % side, share}, side);
        }
        scratch.below[cell] = scratch.rays.size() == before;
    });
    scratch.hits.resize(scratch.rays.size());
}

/// Light that comes back along a path which leaves a hit by another lobe than the Lambert layer's. Lamps that it sees
/// straight through sheets of glass are direct light, which is computed elsewhere.
Rgb follow_lobes(const LightingContext& context, RayTask& task, const LitSurface& lit, const LobeShares& shares,
                 int depth, RandomStream& random) {
    const ScatterSample sample = sample_scatter(lit, shares, random.next(), random.next_2d(), random.next());
    if (sample.lobe == Lobe::diffuse) return Rgb(0.0f);
    PathState state;
    state.left.depth = depth;
    state.emission = EmissionWeight::none;
    return follow_sample(context, task, lit, sample, state, random);
}

/// One gather while its hits are lit.
struct Lighting {
    const LightingContext& context;
    RayTask& task;
    const GatherOptions& options;
    const HemisphereStrata& strata;
    const CellNumbers& numbers;
    const glm::vec3& normal;  ///< of the hemisphere
    RandomStream& random;
    GatherScratch& scratch;

    /// sr, that a ray represents. Cells towards the horizon are 1 / cosine larger.
    float solid_angle(std::size_t ray) const {
        const float cosine = std::max(glm::dot(normal, scratch.rays[ray].direction), min_ray_cosine);
        return pi * scratch.places[ray].share / (static_cast<float>(strata.count()) * cosine);
    }
    /// One light, chosen for a surface that this ray hit.
    ScatteredLight choose(const LitSurface& lit, const LobeShares& shares, std::size_t ray) const {
        const auto& [cell, row, column, share] = scratch.places[ray];
        return choose_light(context, lit, shares,
                            {random.next(), numbers.light(row, column), numbers.light_point(row, column)});
    }
};

/// Adds a sample of direct light, and the light of longer paths by other lobes than Lambert's.
void light_hit(const Lighting& lighting, std::size_t i) {
    GatherScratch& scratch = lighting.scratch;
    const ShadingScene& shading = lighting.context.shading;
    const glm::vec3& direction = scratch.rays[i].direction;
    const SurfacePoint met = make_surface_point(shading, scratch.hits[i], direction);
    const RayFootprint footprint =
        make_cone_footprint(met, direction, scratch.hits[i].distance, lighting.solid_angle(i));
    const ViewedSurface surface = view_surface(shading, met, -direction, footprint);
    const LitSurface lit(surface);
    LobeShares shares{};
    const int depth = lighting.options.depth;
    if (depth > 0 && surface.material.has_specular()) {
        shares = share_lobes(lit, LobeSet::all);
        scratch.light[i] = follow_lobes(lighting.context, lighting.task, lit, shares, depth, lighting.random);
        shares[static_cast<int>(Lobe::diffuse)] = 0.0f;
    }
    const ScatteredLight scattered = lighting.choose(lit, shares, i);
    if (scattered.radiance == Rgb(0.0f)) return;
    scratch.shadow_rays.push_back(scattered.shadow_ray);
    scratch.shadow_samples.push_back({scattered.radiance, Rgb(1.0f), static_cast<int>(i)});
}

/// Finds the hit's cell of the direct grid.
void note_grid_hit(const Lighting& lighting, std::size_t i) {
    GatherScratch& scratch = lighting.scratch;
    const Hit& hit = scratch.hits[i];
    const glm::vec3& direction = scratch.rays[i].direction;
    const float solid_angle = lighting.solid_angle(i);
    GridHit& noted = scratch.grid_hits.emplace_back();
    noted.ray = static_cast<int>(i);
    make_lambert_hit(lighting.context.shading, hit, direction, solid_angle, noted.met);
    const float width = hit.distance * std::sqrt(solid_angle);
    const glm::vec3 from_origin = noted.met.position - lighting.context.shading.instances[hit.instance].translation;
    noted.grid = lighting.options.grid->key_of(hit.instance, from_origin, noted.met.geometric, width);
    lighting.options.grid->prefetch(noted.grid);
}

/// Direct light from the grid's cell. If the cell has too few samples, one more is taken, and counts with them.
void light_grid_hit(const Lighting& lighting, const GridHit& noted) {
    GatherScratch& scratch = lighting.scratch;
    const Rgb& albedo = noted.met.albedo;
    if (albedo == Rgb(0.0f)) return;
    const DirectGrid::Cell& known = lighting.options.grid->find(noted.grid);
    if (known.count >= DirectGrid::enough) {
        scratch.light[noted.ray] = albedo * known.sum / static_cast<float>(known.count);
        return;
    }
    const Rgb scale = albedo / static_cast<float>(known.count + 1);
    scratch.light[noted.ray] = scale * known.sum;
    const glm::vec3& direction = scratch.rays[noted.ray].direction;
    ViewedSurface white;
    white.point = make_surface_point(lighting.context.shading, scratch.hits[noted.ray], direction);
    white.material.diffuse = Rgb(1.0f);
    white.view = -direction;
    const ScatteredLight scattered = lighting.choose(LitSurface(white), {}, noted.ray);
    if (scattered.radiance == Rgb(0.0f)) {
        if (lighting.options.found != nullptr) lighting.options.found->push_back({noted.grid, Rgb(0.0f)});
        return;
    }
    scratch.shadow_rays.push_back(scattered.shadow_ray);
    scratch.shadow_samples.push_back({scattered.radiance, scale, noted.ray, noted.grid});
}

/// Fills in light that is known, and for all other hits unshadowed light with its shadow rays.
void light_hits(const Lighting& lighting) {
    GatherScratch& scratch = lighting.scratch;
    const ShadingScene& shading = lighting.context.shading;
    scratch.light.assign(scratch.rays.size(), Rgb(0.0f));
    scratch.shadow_rays.clear();
    scratch.shadow_samples.clear();
    scratch.grid_hits.clear();
    constexpr std::size_t ahead = 8;  // hits, of prefetching
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        if (i + 2 * ahead < scratch.rays.size()) prefetch_triangle(shading, scratch.hits[i + 2 * ahead]);
        if (i + ahead < scratch.rays.size()) prefetch_corners(shading, scratch.hits[i + ahead]);
        const Hit& hit = scratch.hits[i];
        if (hit.instance == no_index) continue;
        if (lighting.options.grid != nullptr && is_plain_lambert(shading, shading.instances[hit.instance].material)) {
            note_grid_hit(lighting, i);
        } else {
            light_hit(lighting, i);
        }
    }
    for (const GridHit& noted : scratch.grid_hits) light_grid_hit(lighting, noted);
}

/// Casts the shadow rays and adds the light that is not in shadow.
void add_unshadowed(const LightingContext& context, RayTask& task, const GatherOptions& options,
                    GatherScratch& scratch) {
    const std::size_t count = scratch.shadow_rays.size();
    if (!context.shading.has_sheets) {
        scratch.blocked.resize(count);
        task.tracer.occluded(scratch.shadow_rays, scratch.blocked);
        task.counts.shadow += count;
    }
    for (std::size_t s = 0; s < count; ++s) {
        const ShadowSample& sample = scratch.shadow_samples[s];
        const Rgb passed = context.shading.has_sheets ? find_transmittance(context, task, scratch.shadow_rays[s])
                                                      : Rgb(scratch.blocked[s] ? 0.0f : 1.0f);
        const Rgb arrives = passed == Rgb(0.0f) ? passed : sample.unshadowed * passed;
        scratch.light[sample.ray] += sample.scale * arrives;
        if (sample.grid != 0 && options.found != nullptr) options.found->push_back({sample.grid, arrives});
    }
}

/// From what the rays found to the radiance and the distance of every cell.
void merge_rays(const HemisphereStrata& strata, GatherScratch& scratch) {
    scratch.distances.assign(static_cast<std::size_t>(strata.count()), infinite);
    scratch.radiance.assign(static_cast<std::size_t>(strata.count()), Rgb(0.0f));
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const RayPlace& place = scratch.places[i];
        scratch.radiance[place.cell] += scratch.light[i] * place.share;
        if (scratch.hits[i].instance == no_index) continue;
        scratch.distances[place.cell] = std::min(scratch.distances[place.cell], scratch.hits[i].distance);
    }
}

}  // namespace

IrradianceSample gather_irradiance(const LightingContext& context, RayTask& task, const SurfacePoint& point,
                                   const HemisphereStrata& strata, const RandomKey& key, GatherScratch& scratch,
                                   const GatherOptions& options) {
    RandomStream random(key);
    const Basis basis = make_basis(point.normal);
    const CellNumbers numbers(random);
    const int ray_count = divide_cells(strata, options.divided, scratch);
    place_rays(strata, basis, point, numbers, scratch);
    task.tracer.intersect(scratch.rays, scratch.hits, true);
    task.counts.gather += scratch.rays.size();
    light_hits({context, task, options, strata, numbers, point.normal, random, scratch});
    add_unshadowed(context, task, options, scratch);
    merge_rays(strata, scratch);

    IrradianceSample out;
    out.rays = ray_count;
    glm::dvec3 sum(0.0);
    for (const Rgb& radiance : scratch.radiance) sum += glm::dvec3(radiance);
    out.irradiance = Rgb(sum * (std::numbers::pi / strata.count()));
    summarize_hemisphere(strata, basis, scratch, out);
    if (options.bright != nullptr) list_bright_hits(strata, scratch, *options.bright);
    return out;
}

}  // namespace aleph
