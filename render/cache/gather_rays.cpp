#include "render/cache/gather.h"

#include <array>
#include <cmath>
#include <numbers>

#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr float least_rise = 1e-6f;  // of a unit direction above the true surface: below it, rounding decides

/// Sine and cosine of a share of a full turn in [0, 1], to about 1e-7. Without branches, for loops. The polynomials are
/// those of the Cephes library (Moshier), for an eighth of a turn to either side.
inline void find_sine_cosine(float turn, float& sine, float& cosine) {
    const float quarters = std::floor(4.0f * turn + 0.5f);
    const float angle = 2.0f * std::numbers::pi_v<float> * (turn - 0.25f * quarters), square = angle * angle;
    const float s =
        ((-1.9515295891e-4f * square + 8.3321608736e-3f) * square - 1.6666654611e-1f) * square * angle + angle;
    const float c =
        ((2.443315711809948e-5f * square - 1.388731625493765e-3f) * square + 4.166664568298827e-2f) * square * square -
        0.5f * square + 1.0f;
    const int quarter = static_cast<int>(quarters);
    const bool swapped = (quarter & 1) != 0;
    const float along = swapped ? s : c, up = swapped ? c : s;
    cosine = ((quarter + 1) & 2) != 0 ? -along : along;
    sine = (quarter & 2) != 0 ? -up : up;
}

/// Places of the rays that are handled together, and their directions.
struct RayBlock {
    static constexpr std::size_t most = 64;
    std::array<RayPlace, most> places;
    std::array<float, most> x, y, z;
    std::array<float, most> rise;  ///< cosine with the true normal
    std::size_t count = 0;
};

/// Cosine-weighted directions, as sample_cosine_hemisphere. Copies are given, which the block cannot overlap, so that
/// the loop becomes vector instructions.
void find_directions(const HemisphereStrata strata, const Basis basis, const glm::vec3 geometric,
                     const CellNumbers numbers, RayBlock& block) {
    const float by_row = 1.0f / static_cast<float>(strata.rows), by_column = 1.0f / static_cast<float>(strata.columns);
    for (std::size_t i = 0; i < block.count; ++i) {
        const int row = block.places[i].row, column = block.places[i].column;
        const glm::vec2 place = numbers.place(row, column);
        const float elevation = (static_cast<float>(row) + place.x) * by_row;
        const float azimuth = (static_cast<float>(column) + place.y) * by_column;
        float sine, cosine;
        find_sine_cosine(azimuth, sine, cosine);
        const float radius = std::sqrt(elevation), rest = 1.0f - elevation;
        const float a = radius * cosine, b = radius * sine, c = std::sqrt(rest > 0.0f ? rest : 0.0f);
        const float x = basis.tangent.x * a + basis.bitangent.x * b + basis.normal.x * c;
        const float y = basis.tangent.y * a + basis.bitangent.y * b + basis.normal.y * c;
        const float z = basis.tangent.z * a + basis.bitangent.z * b + basis.normal.z * c;
        block.x[i] = x;
        block.y[i] = y;
        block.z[i] = z;
        block.rise[i] = x * geometric.x + y * geometric.y + z * geometric.z;
    }
}

/// Adds the rays of a block that are above the true surface. @return the number of all rays
std::size_t add_rays(const RayBlock& block, const glm::vec3& origin, std::size_t count, GatherScratch& scratch) {
    for (std::size_t i = 0; i < block.count; ++i) {
        const bool above = block.rise[i] > least_rise;
        scratch.rays[count] = {origin, {block.x[i], block.y[i], block.z[i]}};
        scratch.places[count] = block.places[i];
        if (above) scratch.below[block.places[i].cell] = 0;
        count += above ? 1 : 0;
    }
    return count;
}

}  // namespace

void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePlace& point,
                const CellNumbers& numbers, GatherScratch& scratch) {
    scratch.below.assign(static_cast<std::size_t>(strata.count()), 1);
    // One more is written after the last that counts.
    const std::size_t room = static_cast<std::size_t>(strata.count()) + 1;
    scratch.rays.resize(room);
    scratch.places.resize(room);
    const glm::vec3 origin = point.ray_origin();
    RayBlock block;
    std::size_t count = 0;
    const auto finish = [&] {
        find_directions(strata, basis, point.geometric, numbers, block);
        count = add_rays(block, origin, count, scratch);
        block.count = 0;
    };
    visit_blocks(strata, [&](int cell, int row, int column) {
        block.places[block.count] = {cell, row, column};
        if (++block.count == RayBlock::most) finish();
    });
    finish();
    scratch.rays.resize(count);
    scratch.places.resize(count);
    scratch.hits.resize(count);
    scratch.normals.resize(count);
}

KeptRays keep_rays(const GatherScratch& scratch) {
    KeptRays kept{scratch, {}};
    kept.rays.reserve(scratch.rays.size());
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const Hit& hit = scratch.hits[i];
        kept.rays.push_back({scratch.rays[i].direction, hit.instance == no_index ? infinite : hit.distance,
                             scratch.places[i].cell, scratch.light[i]});
    }
    return kept;
}

void restore_rays(const KeptRays& kept, GatherScratch& scratch) {
    static_cast<GatherState&>(scratch) = kept;
    scratch.rays.resize(kept.rays.size());
    scratch.hits.resize(kept.rays.size());
    scratch.places.resize(kept.rays.size());
    scratch.light.resize(kept.rays.size());
    for (std::size_t i = 0; i < kept.rays.size(); ++i) {
        const KeptRays::KeptRay& ray = kept.rays[i];
        scratch.rays[i].direction = ray.direction;
        scratch.hits[i].instance = std::isfinite(ray.distance) ? 0 : no_index;
        scratch.hits[i].distance = ray.distance;
        scratch.places[i] = {.cell = ray.cell};
        scratch.light[i] = ray.light;
    }
}

}  // namespace aleph
