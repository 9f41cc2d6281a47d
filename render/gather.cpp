#include "render/gather.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace aleph {

namespace {

constexpr float pi = std::numbers::pi_v<float>;
constexpr int most_candidates = 16;           // lights compared at a hit
constexpr float smallest_distance = 1e-20f;   // keeps gradients finite where even the median is 0
constexpr float smallest_ray_cosine = 0.05f;  // a cell at the horizon is no wider than this makes it
constexpr float infinite = std::numeric_limits<float>::infinity();

/// The light that one gather hit reflects back, before its shadow ray.
struct Reflected {
    Ray shadow_ray;
    Rgb radiance{0.0f};
};

Reflected choose_light(const LightingContext& context, const SurfacePoint& point, const SurfaceMaterial& material,
                       const glm::vec3& view, RandomStream& random) {
    const int lights = context.lights.count();
    if (!material.has_diffuse() || lights == 0) return {};
    const int candidates = std::min(lights, most_candidates);
    const float share = static_cast<float>(lights) / static_cast<float>(candidates);
    const float cos_view = std::max(glm::dot(point.normal, view), 0.0f);
    std::array<Reflected, most_candidates> reflected;
    std::array<float, most_candidates> cumulative{};
    float total = 0.0f;
    for (int c = 0; c < candidates; ++c) {
        const std::size_t slot = static_cast<std::size_t>(c);
        const int light = candidates == lights
                              ? c
                              : std::min(static_cast<int>((static_cast<float>(c) + random.next()) * share), lights - 1);
        const LightSample sample =
            sample_light(context.shading, context.lights, light, point.ray_origin(), point.normal, random.next_2d());
        const float cosine = glm::dot(point.normal, sample.direction);
        if (cosine > 0.0f && glm::dot(point.geometric, sample.direction) > 0.0f) {
            reflected[slot].radiance =
                evaluate_diffuse(material, cos_view, cosine) * sample.incoming * (cosine * share);
            reflected[slot].shadow_ray = {point.ray_origin(), sample.direction, 0.0f, sample.distance};
            total += luminance(reflected[slot].radiance);
        }
        cumulative[slot] = total;
    }
    if (!(total > 0.0f)) return {};
    const float pick = random.next() * total;
    std::size_t chosen = 0;
    while (chosen + 1 < static_cast<std::size_t>(candidates) && cumulative[chosen] <= pick) ++chosen;
    Reflected& picked = reflected[chosen];
    const float weight = luminance(picked.radiance);
    if (!(weight > 0.0f)) return {};
    picked.radiance *= total / weight;
    return picked;
}

float fraction(float x) {
    return x - std::floor(x);
}

/// The corner directions and sines that a row of the gradient sums needs.
struct Row {
    float sin_low, sin_high;  ///< sine of the elevation angle's bounds, from the normal
    float cos2_low;
    float tangent;  ///< at the row's middle
};

Row make_row(int j, int rows) {
    const float low = static_cast<float>(j) / static_cast<float>(rows);
    const float high = static_cast<float>(j + 1) / static_cast<float>(rows);
    const float middle = 0.5f * (low + high);
    return {std::sqrt(low), std::sqrt(high), 1.0f - low, std::sqrt(middle / (1.0f - middle))};
}

/// Sums of Ward and Heckbert 1992, (1) and (2), over all cells.
void add_gradients(const HemisphereStrata& strata, const Basis& basis, const GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    const int rows = strata.rows, columns = strata.columns;
    const float column_width = 2.0f * pi / static_cast<float>(columns);
    const auto cell = [&](int j, int k) { return static_cast<std::size_t>(j * columns + k); };
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
            const std::size_t channel = static_cast<std::size_t>(c);
            out.rotation_gradient[channel] += v * (rotation[c] * pi / static_cast<float>(strata.count()));
            out.translation_gradient[channel] += u * (along[c] * column_width) + v_edge * across[c];
        }
    }
}

/// Distances under this are a ray's own surface, not a wall (HARD_CASES IC-05): 1e-4 of the median of what was met.
float shortest_true_distance(GatherScratch& scratch) {
    std::vector<float>& met = scratch.sorted;
    met.clear();
    for (const float d : scratch.distances) {
        if (std::isfinite(d)) met.push_back(d);
    }
    if (met.empty()) return 0.0f;
    const auto middle = met.begin() + static_cast<std::ptrdiff_t>(met.size() / 2);
    std::nth_element(met.begin(), middle, met.end());
    return 1e-4f * *middle;
}

/// (6.5), in double; infinite distances count 0.
void set_mean_distance(const std::vector<float>& distances, float shortest, IrradianceSample& out) {
    double sum = 0.0;
    for (const float d : distances) {
        if (d < shortest) {
            ++out.ignored_distances;
        } else {
            sum += 1.0 / d;
        }
    }
    const double mean = static_cast<double>(distances.size() - static_cast<std::size_t>(out.ignored_distances)) / sum;
    out.harmonic_mean_distance = sum > 0.0 ? static_cast<float>(mean) : infinite;
}

/// What a neighbour of this point may hide behind: along the surface what stands in the rows next to the horizon, above
/// it what hangs in all others.
void set_clearance(const HemisphereStrata& strata, const Basis& basis, const GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    out.clearance.fill(infinite);
    // As many rows as give each sector two rays: one alone may miss what stands there.
    const int rows = std::clamp((31 + strata.columns) / strata.columns, 1, strata.rows);
    const std::size_t first_low = static_cast<std::size_t>((strata.rows - rows) * strata.columns);
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
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

}  // namespace

HemisphereStrata choose_strata(int samples) {
    HemisphereStrata best{1, std::max(1, samples)};
    double best_cost = 1e30;
    for (int rows = 1; rows * rows <= samples; ++rows) {
        const int columns = samples / rows;
        // Cells as wide as high near the horizon at columns = pi rows; but what was asked for is what should be spent,
        // so cells may be up to 1.6 times too wide or narrow before a sample is dropped.
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

IrradianceSample gather_irradiance(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                                   const HemisphereStrata& strata, const RandomKey& key, GatherScratch& scratch,
                                   RayCounts& counts) {
    const std::size_t count = static_cast<std::size_t>(strata.count());
    scratch.rays.resize(count);
    scratch.hits.resize(count);
    scratch.distances.resize(count);
    scratch.radiance.assign(count, Rgb(0.0f));
    scratch.shadow_rays.clear();
    scratch.shadow_owner.clear();
    RandomStream random(key);
    const glm::vec2 shift = random.next_2d();
    const Basis basis = make_basis(point.normal);
    for (int j = 0; j < strata.rows; ++j) {
        for (int k = 0; k < strata.columns; ++k) {
            // Kronecker jitter: elevation by column, azimuth by row, so that every cell is used differently.
            const float x = fraction(shift.x + static_cast<float>(k) * 0.61803398875f);
            const float y = fraction(shift.y + static_cast<float>(j) * 0.41421356237f);
            const glm::vec2 u((static_cast<float>(j) + x) / static_cast<float>(strata.rows),
                              (static_cast<float>(k) + y) / static_cast<float>(strata.columns));
            const std::size_t i = static_cast<std::size_t>(j * strata.columns + k);
            scratch.rays[i] = {point.ray_origin(), basis.to_world(sample_cosine_hemisphere(u))};
        }
    }
    tracer.intersect(scratch.rays, scratch.hits, true);
    counts.gather += count;
    const float cell_angle = pi / static_cast<float>(count);  // of a cell around the normal; 1 / cosine more elsewhere
    for (std::size_t i = 0; i < count; ++i) {
        const Hit& hit = scratch.hits[i];
        scratch.distances[i] = hit.instance == no_index ? infinite : hit.distance;
        if (hit.instance == no_index) continue;
        const glm::vec3& direction = scratch.rays[i].direction;
        const SurfacePoint met = make_surface_point(context.shading, hit, direction);
        const float cosine = std::max(glm::dot(point.normal, direction), smallest_ray_cosine);
        const RayFootprint footprint = make_cone_footprint(met, direction, hit.distance, cell_angle / cosine);
        const Reflected reflected =
            choose_light(context, met, evaluate_material(context.shading, met, footprint), -direction, random);
        if (reflected.radiance == Rgb(0.0f)) continue;
        scratch.radiance[i] = reflected.radiance;
        scratch.shadow_rays.push_back(reflected.shadow_ray);
        scratch.shadow_owner.push_back(static_cast<int>(i));
    }
    scratch.blocked.resize(scratch.shadow_rays.size());
    tracer.occluded(scratch.shadow_rays, scratch.blocked);
    counts.shadow += scratch.shadow_rays.size();
    for (std::size_t s = 0; s < scratch.shadow_rays.size(); ++s) {
        if (scratch.blocked[s]) scratch.radiance[scratch.shadow_owner[s]] = Rgb(0.0f);
    }
    IrradianceSample out;
    glm::dvec3 sum(0.0);
    for (const Rgb& radiance : scratch.radiance) sum += glm::dvec3(radiance);
    out.irradiance = Rgb(sum * (std::numbers::pi / static_cast<double>(count)));
    const float shortest = shortest_true_distance(scratch);
    set_mean_distance(scratch.distances, shortest, out);
    set_clearance(strata, basis, scratch, shortest, out);
    add_gradients(strata, basis, scratch, std::max(shortest, smallest_distance), out);
    return out;
}

}  // namespace aleph
