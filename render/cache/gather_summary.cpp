// Summary of the radiance and the distances over a hemisphere: gradients, noise and free space, beside the irradiance.

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <utility>

#include "render/cache/aimed_rays.h"
#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr float min_distance = 1e-20f;  // m; keeps gradients finite if the median distance is 0

StrataRow make_row(int j, int rows) {
    const float low = static_cast<float>(j) / static_cast<float>(rows);
    const float high = static_cast<float>(j + 1) / static_cast<float>(rows);
    const float middle = 0.5f * (low + high);
    return {std::sqrt(low), std::sqrt(high), 1.0f - low, std::sqrt(middle / (1.0f - middle))};
}

/// 1/m; negative where a cell is below the true surface.
void invert_distances(float shortest, GatherScratch& scratch) {
    scratch.inverse_distances.resize(scratch.distances.size());
    for (std::size_t i = 0; i < scratch.distances.size(); ++i) {
        const float d = scratch.distances[i], inverse = 1.0f / (d > shortest ? d : shortest);
        scratch.inverse_distances[i] = scratch.below[i] != 0 ? -1.0f : inverse;
    }
}

/// Ward and Heckbert 1992, eqs. 1 (rotation) and 2 (translation): sums over all cells. The boundary between two cells
/// moves by the parallax of the nearer surface. The point's own horizon moves with the point: where a cell is below it,
/// the boundary has no parallax.
/// @param shortest  m; distances count as at least this
void add_gradients(const HemisphereStrata& strata, const Basis& basis, GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    const int rows = strata.rows, columns = strata.columns;
    const float column_width = 2.0f * pi / static_cast<float>(columns);
    scratch.rows.clear();
    for (int j = 0; j < rows; ++j) scratch.rows.push_back(make_row(j, rows));
    invert_distances(shortest, scratch);
    const std::vector<float>& inverse = scratch.inverse_distances;
    const auto parallax = [&](int a, int b) {
        const bool below = std::min(inverse[a], inverse[b]) < 0.0f;
        return below ? 0.0f : std::max(inverse[a], inverse[b]);
    };
    for (int k = 0; k < columns; ++k) {
        const int before = k == 0 ? columns - 1 : k - 1;
        Rgb rotation(0.0f), along(0.0f), across(0.0f);
        for (int j = 0; j < rows; ++j) {
            const StrataRow& row = scratch.rows[j];
            const int cell = strata.cell(j, k), beside = strata.cell(j, before);
            const Rgb& here = scratch.radiance[cell];
            rotation += here * row.tangent;
            if (j > 0) {
                const int above = strata.cell(j - 1, k);
                along += (here - scratch.radiance[above]) * (row.sin_low * row.cos2_low * parallax(cell, above));
            }
            across += (here - scratch.radiance[beside]) * ((row.sin_high - row.sin_low) * parallax(cell, beside));
        }
        const float middle = (static_cast<float>(k) + 0.5f) * column_width;
        const float edge = static_cast<float>(k) * column_width;
        const glm::vec3 u = basis.tangent * std::cos(middle) + basis.bitangent * std::sin(middle);
        const glm::vec3 v = basis.bitangent * std::cos(middle) - basis.tangent * std::sin(middle);
        const glm::vec3 v_edge = basis.bitangent * std::cos(edge) - basis.tangent * std::sin(edge);
        for (int c = 0; c < 3; ++c) {
            out.gradients.rotation[c] += v * (rotation[c] * pi / static_cast<float>(strata.count()));
            out.gradients.translation[c] += u * (along[c] * column_width) + v_edge * across[c];
        }
    }
}

/// m. Shorter distances are hits of the point's own surface, by rounding: 1e-4 of the median distance, or of the
/// longest where that makes no difference.
float shortest_true_distance(GatherScratch& scratch) {
    constexpr float share = 1e-4f;
    float least = infinite, most = 0.0f;
    for (const float d : scratch.distances) {
        least = std::min(least, d);
        most = std::max(most, d < infinite ? d : 0.0f);
    }
    if (least >= share * most) return share * most;
    std::vector<float>& met = scratch.sorted;
    met.clear();
    for (const float d : scratch.distances) {
        if (std::isfinite(d)) met.push_back(d);
    }
    const auto middle = met.begin() + std::ssize(met) / 2;
    std::nth_element(met.begin(), middle, met.end());
    return share * *middle;
}

/// The nearest of the distances that count.
float find_nearest(const std::vector<float>& distances, float shortest) {
    float nearest = infinite;
    for (const float d : distances)
        if (d >= shortest) nearest = std::min(nearest, d);
    return nearest;
}

/// Distances to what may stand between this point and a neighbour: along the tangent plane from the rows next to the
/// horizon, above it from all other rows.
void set_clearance(const HemisphereStrata& strata, const Basis& basis, const GatherScratch& scratch, float shortest,
                   IrradianceSample& out) {
    out.space.sectors.fill(infinite);
    // At least two rays per sector: a single one may miss an obstacle.
    const int sectors = static_cast<int>(out.space.sectors.size());
    const int rows = std::clamp((2 * sectors - 1 + strata.columns) / strata.columns, 1, strata.rows);
    const int first_low = (strata.rows - rows) * strata.columns;
    for (std::size_t i = 0; i < scratch.rays_around(); ++i) {
        const int cell = scratch.places[i].cell;
        const float distance = scratch.hits[i].instance == no_index ? infinite : scratch.hits[i].distance;
        if (distance < shortest) continue;
        const glm::vec3 local = basis.to_local(scratch.rays[i].direction);
        if (cell < first_low) {
            out.space.headroom = std::min(out.space.headroom, distance * local.z);
            continue;
        }
        float& clear = out.space.sectors[sector_of(local.x, local.y)];
        clear = std::min(clear, distance * std::sqrt(local.x * local.x + local.y * local.y));
    }
}

/// Neighbouring cells' numbers are spread evenly, so the error is smaller than of independent ones. Measured: without
/// this factor the estimate is .5 to 1.5 times the spread over seeds in three scenes: most where the light varies
/// smoothly, and least where a few rays meet something very bright. In a bare room it is twice the spread.
constexpr float share_of_independent = 0.8f;

/// Variance of the brightness that one ray finds in a cell of the strata, from mixed differences a - b - c + d over
/// squares of four cells, whose variance is that of four cells. Light that varies along rows and columns smoothly, and
/// edges along either, cancel in them.
double estimate_cell_variance(const HemisphereStrata& strata, const std::vector<float>& brightness) {
    double squares = 0.0;
    for (int j = 1; j < strata.rows; ++j) {
        for (int k = 0; k < strata.columns; ++k) {
            const int before = k == 0 ? strata.columns - 1 : k - 1;
            const int a = strata.cell(j, k), b = strata.cell(j - 1, k);
            const int c = strata.cell(j, before), d = strata.cell(j - 1, before);
            const float mixed = brightness[a] - brightness[b] - brightness[c] + brightness[d];
            squares += static_cast<double>(mixed) * mixed;
        }
    }
    return squares / (4.0 * (strata.rows - 1) * strata.columns);
}

/// The standard error of the irradiance's luminance over the luminance itself. With one sample in each cell, the
/// variance is estimated from differences of neighbouring cells, as for systematic samples (Cochran 1977, "Sampling
/// Techniques", ch. 8; Wolter 2007, "Introduction to Variance Estimation", ch. 8).
float estimate_relative_error(const HemisphereStrata& strata, GatherScratch& scratch) {
    std::vector<float>& brightness = scratch.sorted;
    brightness.resize(scratch.radiance.size());
    double sum = 0.0;
    for (std::size_t i = 0; i < brightness.size(); ++i) {
        brightness[i] = luminance(scratch.radiance[i]);
        sum += brightness[i];
    }
    if (!(sum > 0.0)) return 0.0f;
    if (strata.rows < 2 || strata.columns < 2) return infinite;
    const double variance = strata.count() * estimate_cell_variance(strata, brightness);
    return share_of_independent * static_cast<float>(std::sqrt(variance) / sum);
}

/// Light is rare that fewer rays than these find.
constexpr std::size_t common_rays = 4;
constexpr float rare_over_common = 4.0f;

/// From what the rays found to the radiance and the distance of every cell.
void sort_by_cell(const HemisphereStrata& strata, GatherScratch& scratch) {
    scratch.distances.assign(static_cast<std::size_t>(strata.count()), infinite);
    scratch.radiance.assign(static_cast<std::size_t>(strata.count()), Rgb(0.0f));
    for (std::size_t i = 0; i < scratch.rays_around(); ++i) {
        const int cell = scratch.places[i].cell;
        scratch.radiance[cell] = scratch.light[i];
        if (scratch.hits[i].instance != no_index) scratch.distances[cell] = scratch.hits[i].distance;
    }
}

}  // namespace

void summarize_hemisphere(const HemisphereStrata& strata, const Basis& basis, GatherScratch& scratch,
                          IrradianceSample& out) {
    const float shortest = shortest_true_distance(scratch);
    out.nearest_distance = find_nearest(scratch.distances, shortest);
    set_clearance(strata, basis, scratch, shortest, out);
    add_gradients(strata, basis, scratch, std::max(shortest, min_distance), out);
    out.relative_error = estimate_relative_error(strata, scratch);
}

Rgb take_rare_light(const HemisphereStrata& strata, GatherScratch& scratch) {
    const std::span<Rgb> light(scratch.light.data(), scratch.rays_around());
    std::array<float, common_rays> most{};  // largest first
    for (const Rgb& found : light) {
        float value = luminance(found);
        for (float& larger : most)
            if (value > larger) std::swap(value, larger);
    }
    const float limit = rare_over_common * most.back();
    glm::dvec3 taken(0.0);
    if (!(most.front() > limit)) return taken;
    for (Rgb& found : light) {
        const float value = luminance(found);
        if (!(value > limit)) continue;
        const Rgb left = found * (limit / value);
        taken += glm::dvec3(found - left);
        found = left;
    }
    return Rgb(taken * (std::numbers::pi / strata.count()));
}

IrradianceSample add_up_rays(const HemisphereStrata& strata, const glm::vec3& normal, GatherScratch& scratch) {
    sort_by_cell(strata, scratch);
    IrradianceSample out;
    out.rays = strata.count();
    glm::dvec3 sum(0.0);
    for (const Rgb& radiance : scratch.radiance) sum += glm::dvec3(radiance);
    out.irradiance = Rgb(sum * (std::numbers::pi / strata.count()));
    summarize_hemisphere(strata, make_basis(normal), scratch, out);
    if (scratch.aims > 0) add_aimed(normal, scratch, out);
    return out;
}

}  // namespace aleph
