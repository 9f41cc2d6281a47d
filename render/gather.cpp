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

/// The rays of all cells that are above the true surface.
void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePoint& point,
                const CellNumbers& numbers, GatherScratch& scratch) {
    scratch.rays.clear();
    scratch.cells.clear();
    scratch.below.assign(static_cast<std::size_t>(strata.count()), 0);
    const glm::vec3 origin = point.ray_origin();
    visit_blocks(strata, [&](int cell, int row, int column) {
        const glm::vec2 u =
            (glm::vec2(row, column) + numbers.place(row, column)) / glm::vec2(strata.rows, strata.columns);
        const glm::vec3 direction = basis.to_world(sample_cosine_hemisphere(u));
        if (glm::dot(direction, point.geometric) <= least_rise) {
            scratch.below[cell] = 1;
            return;
        }
        scratch.rays.push_back({origin, direction});
        scratch.cells.push_back(cell);
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

/// Fills in distances, the light of longer paths, and for all hits unshadowed radiance with its shadow rays.
void light_hits(const LightingContext& context, RayTask& task, const SurfacePoint& point,
                const HemisphereStrata& strata, int depth, const CellNumbers& numbers, RandomStream& random,
                GatherScratch& scratch) {
    const std::size_t cells = static_cast<std::size_t>(strata.count());
    scratch.distances.assign(cells, infinite);
    scratch.radiance.assign(cells, Rgb(0.0f));
    scratch.shadow_rays.clear();
    scratch.unshadowed.clear();
    scratch.shadow_cells.clear();
    // sr, of a cell around the normal; cells towards the horizon are 1 / cosine larger.
    const float cell_angle = pi / static_cast<float>(cells);
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const Hit& hit = scratch.hits[i];
        if (hit.instance == no_index) continue;
        const int cell = scratch.cells[i];
        scratch.distances[cell] = hit.distance;
        const glm::vec3& direction = scratch.rays[i].direction;
        const SurfacePoint met = make_surface_point(context.shading, hit, direction);
        const float cosine = std::max(glm::dot(point.normal, direction), min_ray_cosine);
        const RayFootprint footprint = make_cone_footprint(met, direction, hit.distance, cell_angle / cosine);
        const ViewedSurface surface = view_surface(context.shading, met, -direction, footprint);
        const LitSurface lit(surface);
        LobeShares shares{};
        if (depth > 0 && surface.material.has_specular()) {
            shares = share_lobes(lit, LobeSet::all);
            scratch.radiance[cell] = follow_lobes(context, task, lit, shares, depth, random);
            shares[static_cast<int>(Lobe::diffuse)] = 0.0f;
        }
        const int row = cell / strata.columns, column = cell % strata.columns;
        const LightNumbers light{random.next(), numbers.light(row, column), numbers.light_point(row, column)};
        const ScatteredLight scattered = choose_light(context, lit, shares, light);
        if (scattered.radiance == Rgb(0.0f)) continue;
        scratch.shadow_rays.push_back(scattered.shadow_ray);
        scratch.unshadowed.push_back(scattered.radiance);
        scratch.shadow_cells.push_back(cell);
    }
}

/// Casts the shadow rays and adds the light that is not in shadow.
void add_unshadowed(const LightingContext& context, RayTask& task, GatherScratch& scratch) {
    const std::size_t count = scratch.shadow_rays.size();
    if (context.shading.has_sheets) {
        for (std::size_t s = 0; s < count; ++s) {
            scratch.radiance[scratch.shadow_cells[s]] +=
                scratch.unshadowed[s] * find_transmittance(context, task, scratch.shadow_rays[s]);
        }
        return;
    }
    scratch.blocked.resize(count);
    task.tracer.occluded(scratch.shadow_rays, scratch.blocked);
    task.counts.shadow += count;
    for (std::size_t s = 0; s < count; ++s) {
        if (!scratch.blocked[s]) scratch.radiance[scratch.shadow_cells[s]] += scratch.unshadowed[s];
    }
}

}  // namespace

IrradianceSample gather_irradiance(const LightingContext& context, RayTask& task, const SurfacePoint& point,
                                   const HemisphereStrata& strata, const RandomKey& key, GatherScratch& scratch,
                                   int depth) {
    RandomStream random(key);
    const Basis basis = make_basis(point.normal);
    const CellNumbers numbers(random);
    place_rays(strata, basis, point, numbers, scratch);
    task.tracer.intersect(scratch.rays, scratch.hits, true);
    task.counts.gather += scratch.rays.size();
    light_hits(context, task, point, strata, depth, numbers, random, scratch);
    add_unshadowed(context, task, scratch);

    IrradianceSample out;
    out.rays = strata.count();
    glm::dvec3 sum(0.0);
    for (const Rgb& radiance : scratch.radiance) sum += glm::dvec3(radiance);
    out.irradiance = Rgb(sum * (std::numbers::pi / strata.count()));
    summarize_hemisphere(strata, basis, scratch, out);
    return out;
}

}  // namespace aleph
