#include "render/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "render/lattice.h"

namespace aleph {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr float min_distance = 1e-20f;   // m; keeps gradients finite if the median distance is 0
constexpr float min_ray_cosine = 0.05f;  // limits the solid angle of cells at the horizon
constexpr float infinite = std::numeric_limits<float>::infinity();

/// Angles of a row of strata, measured from the normal.
struct Row {
    float sin_low, sin_high;  ///< of its bounds
    float cos2_low;           ///< squared cosine of the lower bound
    float tangent;            ///< of its middle
};

Row make_row(int j, int rows) {
    const float low = static_cast<float>(j) / static_cast<float>(rows);
    const float high = static_cast<float>(j + 1) / static_cast<float>(rows);
    const float middle = 0.5f * (low + high);
    return {std::sqrt(low), std::sqrt(high), 1.0f - low, std::sqrt(middle / (1.0f - middle))};
}

/// Ward and Heckbert 1992, eqs. 1 (rotation) and 2 (translation): sums over all cells.
/// @param shortest  m; distances count as at least this
void add_gradients(const HemisphereStrata& strata, const Basis& basis, const GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    const int rows = strata.rows, columns = strata.columns;
    const float column_width = 2.0f * pi / static_cast<float>(columns);
    const auto cell = [&](int j, int k) { return j * columns + k; };
    for (int k = 0; k < columns; ++k) {
        const int before = k == 0 ? columns - 1 : k - 1;
        Rgb rotation(0.0f), along(0.0f), across(0.0f);
        for (int j = 0; j < rows; ++j) {
            const Row row = make_row(j, rows);
            const Rgb& here = scratch.radiance[cell(j, k)];
            const float distance = scratch.distances[cell(j, k)];
            rotation += here * row.tangent;
            if (j > 0) {
                const float nearest = std::max(shortest, std::min(distance, scratch.distances[cell(j - 1, k)]));
                along += (here - scratch.radiance[cell(j - 1, k)]) * (row.sin_low * row.cos2_low / nearest);
            }
            const float nearest = std::max(shortest, std::min(distance, scratch.distances[cell(j, before)]));
            across += (here - scratch.radiance[cell(j, before)]) * ((row.sin_high - row.sin_low) / nearest);
        }
        const float middle = (static_cast<float>(k) + 0.5f) * column_width;
        const float edge = static_cast<float>(k) * column_width;
        const glm::vec3 u = basis.tangent * std::cos(middle) + basis.bitangent * std::sin(middle);
        const glm::vec3 v = basis.bitangent * std::cos(middle) - basis.tangent * std::sin(middle);
        const glm::vec3 v_edge = basis.bitangent * std::cos(edge) - basis.tangent * std::sin(edge);
        for (int c = 0; c < 3; ++c) {
            out.rotation_gradient[c] += v * (rotation[c] * pi / static_cast<float>(strata.count()));
            out.translation_gradient[c] += u * (along[c] * column_width) + v_edge * across[c];
        }
    }
}

/// m. Shorter distances are hits of the point's own surface, by rounding: 1e-4 of the median distance.
float shortest_true_distance(GatherScratch& scratch) {
    std::vector<float>& met = scratch.sorted;
    met.clear();
    for (const float d : scratch.distances) {
        if (std::isfinite(d)) met.push_back(d);
    }
    if (met.empty()) return 0.0f;
    const auto middle = met.begin() + std::ssize(met) / 2;
    std::nth_element(met.begin(), middle, met.end());
    return 1e-4f * *middle;
}

/// The harmonic mean (Yee 2000, eq. 6.5) in double, where the inverse of an infinite distance is 0, and the nearest.
void set_distances(const std::vector<float>& distances, float shortest, IrradianceSample& out) {
    double sum = 0.0;
    for (const float d : distances) {
        if (d < shortest) {
            ++out.ignored_distances;
        } else {
            sum += 1.0 / d;
            out.nearest_distance = std::min(out.nearest_distance, d);
        }
    }
    const double mean = static_cast<double>(std::ssize(distances) - out.ignored_distances) / sum;
    out.harmonic_mean_distance = sum > 0.0 ? static_cast<float>(mean) : infinite;
}

/// Distances to what may stand between this point and a neighbour: along the tangent plane from the rows next to the
/// horizon, above it from all other rows.
void set_clearance(const HemisphereStrata& strata, const Basis& basis, const GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    out.clearance.fill(infinite);
    // At least two rays per sector: a single one may miss an obstacle.
    const int sectors = static_cast<int>(out.clearance.size());
    const int rows = std::clamp((2 * sectors - 1 + strata.columns) / strata.columns, 1, strata.rows);
    const int first_low = (strata.rows - rows) * strata.columns;
    for (int i = 0; i < strata.count(); ++i) {
        if (scratch.distances[i] < shortest) continue;
        const glm::vec3 local = basis.to_local(scratch.rays[i].direction);
        if (i < first_low) {
            out.headroom = std::min(out.headroom, scratch.distances[i] * local.z);
            continue;
        }
        float& clear = out.clearance[sector_of(local.x, local.y)];
        clear = std::min(clear, scratch.distances[i] * std::sqrt(local.x * local.x + local.y * local.y));
    }
}

/// One ray per cell. Its place in the cell is a Kronecker sequence: elevation changes by column and azimuth by row, so
/// that no two cells are sampled at the same place.
/// @param shift  random, in [0,1)^2
void place_rays(const HemisphereStrata& strata, const Basis& basis, const glm::vec3& origin, const glm::vec2& shift,
                GatherScratch& scratch) {
    scratch.rays.resize(static_cast<std::size_t>(strata.count()));
    for (int j = 0; j < strata.rows; ++j) {
        for (int k = 0; k < strata.columns; ++k) {
            const float x = fraction(shift.x + static_cast<float>(k) * 0.61803398875f);
            const float y = fraction(shift.y + static_cast<float>(j) * 0.41421356237f);
            const glm::vec2 u((static_cast<float>(j) + x) / static_cast<float>(strata.rows),
                              (static_cast<float>(k) + y) / static_cast<float>(strata.columns));
            scratch.rays[j * strata.columns + k] = {origin, basis.to_world(sample_cosine_hemisphere(u))};
        }
    }
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

/// Fills in distances, and for all hits unshadowed radiance with its shadow rays, and the light of longer paths.
void light_hits(const LightingContext& context, RayTask& task, const SurfacePoint& point, int depth,
                RandomStream& random, GatherScratch& scratch) {
    const std::size_t count = scratch.rays.size();
    scratch.distances.resize(count);
    scratch.radiance.assign(count, Rgb(0.0f));
    scratch.beyond.assign(count, Rgb(0.0f));
    scratch.shadow_rays.clear();
    scratch.shadow_owner.clear();
    // sr, of a cell around the normal; cells towards the horizon are 1 / cosine larger.
    const float cell_angle = pi / static_cast<float>(count);
    for (std::size_t i = 0; i < count; ++i) {
        const Hit& hit = scratch.hits[i];
        scratch.distances[i] = hit.instance == no_index ? infinite : hit.distance;
        if (hit.instance == no_index) continue;
        const glm::vec3& direction = scratch.rays[i].direction;
        const SurfacePoint met = make_surface_point(context.shading, hit, direction);
        const float cosine = std::max(glm::dot(point.normal, direction), min_ray_cosine);
        const RayFootprint footprint = make_cone_footprint(met, direction, hit.distance, cell_angle / cosine);
        const ViewedSurface surface = view_surface(context.shading, met, -direction, footprint);
        const LitSurface lit(surface);
        LobeShares shares{};
        if (depth > 0 && surface.material.has_specular()) {
            shares = share_lobes(lit, LobeSet::all);
            scratch.beyond[i] = follow_lobes(context, task, lit, shares, depth, random);
            shares[static_cast<int>(Lobe::diffuse)] = 0.0f;
        }
        const ScatteredLight scattered = choose_light(context, lit, shares, random);
        if (scattered.radiance == Rgb(0.0f)) continue;
        scratch.radiance[i] = scattered.radiance;
        scratch.shadow_rays.push_back(scattered.shadow_ray);
        scratch.shadow_owner.push_back(static_cast<int>(i));
    }
}

/// Casts the shadow rays; the radiance of hits in shadow becomes 0.
void remove_shadowed(const LightingContext& context, RayTask& task, GatherScratch& scratch) {
    if (context.shading.has_sheets) {
        for (std::size_t s = 0; s < scratch.shadow_rays.size(); ++s) {
            scratch.radiance[scratch.shadow_owner[s]] *= find_transmittance(context, task, scratch.shadow_rays[s]);
        }
        return;
    }
    scratch.blocked.resize(scratch.shadow_rays.size());
    task.tracer.occluded(scratch.shadow_rays, scratch.blocked);
    task.counts.shadow += scratch.shadow_rays.size();
    for (std::size_t s = 0; s < scratch.shadow_rays.size(); ++s) {
        if (scratch.blocked[s]) scratch.radiance[scratch.shadow_owner[s]] = Rgb(0.0f);
    }
}

}  // namespace

HemisphereStrata choose_strata(int samples) {
    HemisphereStrata best{1, std::max(1, samples)};
    double best_cost = 1e30;
    for (int rows = 1; rows * rows <= samples; ++rows) {
        const int columns = samples / rows;
        // With columns = pi rows, cells near the horizon are as wide as high. All samples asked for should be used, so
        // cells may be up to 1.6 times too wide or too narrow before a sample is dropped.
        const double skew = std::abs(std::log(columns / (std::numbers::pi * rows)));
        const double lost = static_cast<double>(samples - rows * columns) / samples;
        const double cost = skew + (lost > 0.0 ? 0.5 + 100.0 * lost : 0.0);
        if (cost < best_cost) {
            best_cost = cost;
            best = {rows, columns};
        }
    }
    return best;
}

IrradianceSample gather_irradiance(const LightingContext& context, RayTask& task, const SurfacePoint& point,
                                   const HemisphereStrata& strata, const RandomKey& key, GatherScratch& scratch,
                                   int depth) {
    RandomStream random(key);
    const Basis basis = make_basis(point.normal);
    place_rays(strata, basis, point.ray_origin(), random.next_2d(), scratch);
    task.tracer.intersect(scratch.rays, scratch.hits, true);
    task.counts.gather += scratch.rays.size();
    light_hits(context, task, point, depth, random, scratch);
    remove_shadowed(context, task, scratch);
    for (std::size_t i = 0; i < scratch.radiance.size(); ++i) scratch.radiance[i] += scratch.beyond[i];

    IrradianceSample out;
    out.rays = strata.count();
    glm::dvec3 sum(0.0);
    for (const Rgb& radiance : scratch.radiance) sum += glm::dvec3(radiance);
    out.irradiance = Rgb(sum * (std::numbers::pi / strata.count()));
    {
        double diff = 0.0;
        for (int j = 0; j < strata.rows; ++j)
            for (int k = 0; k < strata.columns; ++k) {
                const int a = j * strata.columns + k, b = j * strata.columns + (k + 1) % strata.columns;
                const double d = luminance(scratch.radiance[a]) - luminance(scratch.radiance[b]);
                diff += d * d;
            }
        const double n = strata.count(), mean = luminance(out.irradiance) / std::numbers::pi;
        out.relative_error = mean > 0 ? float(std::sqrt(diff / (2 * n * n)) / mean) : 0.0f;
    }
    const float shortest = shortest_true_distance(scratch);
    set_distances(scratch.distances, shortest, out);
    set_clearance(strata, basis, scratch, shortest, out);
    add_gradients(strata, basis, scratch, std::max(shortest, min_distance), out);
    return out;
}

}  // namespace aleph
