#pragma once
// One irradiance value: rays over the hemisphere, the light that they find, and its gradients.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>
#include <vector>

#include "engine/base/color.h"
#include "engine/base/sampling.h"
#include "render/cache/direct_grid.h"
#include "render/cache/hemisphere_strata.h"
#include "render/light/light_choice.h"
#include "render/path/path.h"

namespace aleph {

class IrradianceCache;

/// The light that hits of gather rays scatter in addition to direct light.
struct MultiBounceLight {
    int bounces = 0;  ///< of its irradiance; 0: there is none
    /// Cache of exactly so many bounces; null: every irradiance comes from a random path.
    const IrradianceCache* cache = nullptr;
    float accuracy = 0.0f;  ///< alpha of look-ups
    /// It is not looked up: gathers note where it comes from (FurtherLight).
    bool noted = false;
};

/// Where records do not reach, they are used so many times as far: their error is smaller than that of the one random
/// path in their place, which may meet the brightest spot of the scene.
inline constexpr float gap_reach = 1.4f;

/// Indirect irradiance at a surface point from the cache; nothing where no record reaches, even so.
std::optional<Rgb> find_cached_irradiance(RayTask& task, const SurfacePlace& point,
                                          const MultiBounceLight& multi_bounce);

/// The same without bias from one random path, whose first ray is counted as RayCounts::multi_bounce.
/// @param material  weighs the light by what of it enters (UpperLayers::entering); null: pure Lambert
/// @param depth     surfaces that may scatter on the path
Rgb sample_multi_bounce_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const SurfaceMaterial* material, const MultiBounceLight& multi_bounce, int depth,
                                   RandomStream& random);

/// Free distance along a tangent plane by sectors of azimuth (sector_of), m.
using Clearance = std::array<float, 16>;

constexpr Clearance unlimited_clearance() {
    Clearance all{};
    all.fill(std::numeric_limits<float>::infinity());
    return all;
}

/// Where nothing stands around a point.
struct FreeSpace {
    Clearance sectors = unlimited_clearance();  ///< nearest hits of the rays next to the tangent plane
    /// m, from the tangent plane up to the lowest hit of all other rays.
    float headroom = std::numeric_limits<float>::infinity();
};

/// Change of an irradiance, per colour channel.
struct IrradianceGradients {
    std::array<glm::vec3, 3> rotation{};     ///< dE = dot(cross(N_i, N), gradient)
    std::array<glm::vec3, 3> translation{};  ///< per m, in the tangent plane
};

/// Indirect irradiance at a point with its gradients (Ward and Heckbert 1992, "Irradiance Gradients").
struct IrradianceSample {
    /// Irradiance by reflected light, not straight from the lights; with GatherOptions::material, weighed by it.
    Rgb irradiance{0.0f};
    Rgb rare{0.0f};  ///< irradiance that take_rare_light took from it
    IrradianceGradients gradients{};
    /// m, to the nearest surface met, the point's own left out; infinite if no ray hit anything.
    float nearest_distance = std::numeric_limits<float>::infinity();
    FreeSpace space{};
    int rays = 0;  ///< that were spent, those below the true surface included
    /// Standard error of the irradiance's luminance over the luminance, estimated from this one gather; 0 if all is
    /// dark, infinite if there are too few cells to tell.
    float relative_error = 0.0f;
};

/// Index of the sixteenth of the circle that holds a direction with these tangent-plane coordinates. Neighbouring
/// sectors need not have neighbouring indices.
inline int sector_of(float x, float y) {
    const float across = std::abs(x), along = std::abs(y);
    constexpr float tan_half = 0.41421356f;  // of 22.5 degrees
    const bool diagonal = std::min(across, along) > tan_half * std::max(across, along);
    return (x < 0.0f ? 1 : 0) | (y < 0.0f ? 2 : 0) | (across < along ? 4 : 0) | (diagonal ? 8 : 0);
}

/// The cell of the strata that a ray belongs to.
struct RayPlace {
    int cell = 0;
    int row = 0, column = 0;
};

/// Light of a sampled light, until its shadow ray is cast.
struct ShadowSample {
    Rgb unshadowed{0.0f};
    Rgb scale{1.0f};         ///< of what arrives, to radiance
    Rgb multi_bounce{0.0f};  ///< light of further bounces, which arrives in any case
    int ray = 0;             ///< that hit the surface
    std::uint64_t grid = 0;  ///< cell of the direct grid that the light is a sample of; 0: none
    bool looked_up = false;  ///< multi_bounce, in the cache: the cell keeps it
};

/// A hit of a plain Lambert surface, until its direct light is known.
struct PlainHit {
    Rgb scale{0.0f};  ///< of the light that a white surface would scatter
    int ray = 0;
    std::uint64_t grid = 0;           ///< its cell of the direct grid; 0: none
    std::optional<Rgb> multi_bounce;  ///< that a white surface would scatter, if the cell has it
};

/// Angles of a row of strata, measured from the normal.
struct StrataRow {
    float sin_low, sin_high;  ///< of its bounds
    float cos2_low;           ///< squared cosine of the lower bound
    float tangent;            ///< of its middle
};

/// Light of further bounces that was not looked up: it comes from a surface that a ray of the gather met, or a path
/// that went on from there.
struct FurtherLight {
    int ray = 0;
    Rgb weight{0.0f};  ///< radiance that the ray brings of a unit of the place's irradiance
    SurfacePlace place;
    RandomKey key;  ///< of the place
};

/// A gather, but for its rays.
struct GatherState {
    HemisphereStrata strata;
    std::vector<std::uint8_t> below;    ///< of every cell: no ray is cast, all directions are below the true surface
    std::vector<FurtherLight> further;  ///< of MultiBounceLight::noted: light that the rays have not found
    int aims = 0;                       ///< rays towards bright surfaces that were to be found (aimed_rays.h)
    std::vector<BrightSampler::Aim> aimed;  ///< those that were: the last rays
};

/// Buffers that a thread reuses, so that only its first gathers allocate.
struct GatherScratch : GatherState {
    // One for every ray that is cast, in the order of visit_blocks.
    std::vector<Ray> rays;
    std::vector<Hit> hits;
    std::vector<RayPlace> places;
    std::vector<Rgb> light;          ///< radiance that the ray finds
    std::vector<glm::vec3> normals;  ///< of the hits (Tracer::intersect)
    std::vector<float> weights;      ///< by what rays met; set if some are aimed
    std::vector<Rgb> passed;         ///< share of light that sheets let pass; empty: there are none
    /// Rays that sheets turn, in their order.
    struct Reflected {
        std::size_t ray = 0;
        ScatterSample sample;
    };
    std::vector<Reflected> reflected;
    // One for every cell.
    std::vector<Rgb> radiance;     ///< black below the true surface
    std::vector<float> distances;  ///< m; infinite where nothing is met
    // One for every shadow ray.
    std::vector<Ray> shadow_rays;
    std::vector<ShadowSample> shadow_samples;
    std::vector<PlainHit> plain_hits;
    // Buffers of the summary.
    std::vector<float> sorted;
    std::vector<float> inverse_distances;
    std::vector<StrataRow> rows;

    std::size_t rays_around() const { return rays.size() - aimed.size(); }
};

/// The part of a gather that add_up_rays needs, while its rays wait for light of further bounces.
struct KeptRays : GatherState {
    struct KeptRay {
        glm::vec3 direction{0.0f};
        float distance = 0.0f;  ///< infinite: nothing is met
        int cell = 0;
        Rgb light{0.0f};
    };
    std::vector<KeptRay> rays;
};

struct GatherOptions {
    int depth = 0;  ///< surfaces that may scatter after the first on paths by other lobes than Lambert's; 0: none
    /// Direct light of pure Lambert surfaces comes from here where it is known: biased, with far fewer shadow rays.
    /// Null: every hit casts its own shadow ray, without bias.
    const DirectGrid* grid = nullptr;
    std::vector<DirectSample>* found = nullptr;  ///< if given, samples for the grid are added
    MultiBounceLight multi_bounce{};             ///< light of further bounces; none: one bounce only
    /// Weighs the light of each ray by UpperLayers::entering, which is what diffuse_radiance needs. Null: all
    /// alike.
    const SurfaceMaterial* material = nullptr;
    /// Rays towards them join those over the hemisphere; null: none.
    const BrightSurfaces* bright = nullptr;
    bool apart_if_rare = false;  ///< whether light that three rays or fewer find is IrradianceSample::rare
};

/// Where the rays of a gather go.
struct GatherPattern {
    HemisphereStrata strata;
    RandomKey key{};  ///< all random numbers depend on it
};

/// Gathers the light that other surfaces scatter to a point: their direct light, and that of further bounces. The
/// hemisphere lies about the shading normal. Directions below the true surface count as black and infinitely far, and
/// no rays are cast there. At each hit one light is chosen in proportion to its unshadowed contribution, and one shadow
/// ray is cast towards it. Where the surface that is hit reflects or passes light by more than its Lambert layer, a
/// path goes on with that share as its probability.
IrradianceSample gather_irradiance(const LightingContext& context, RayTask& task, const SurfacePlace& point,
                                   const GatherPattern& pattern, GatherScratch& scratch,
                                   const GatherOptions& options = {});

/// Sets the rays of all cells, as far as they are above the true surface, their places, and which cells are below it.
void place_rays(const HemisphereStrata& strata, const Basis& basis, const SurfacePlace& point,
                const CellNumbers& numbers, GatherScratch& scratch);

/// @param scratch  of a gather
KeptRays keep_rays(const GatherScratch& scratch);
/// Sets what add_up_rays reads.
void restore_rays(const KeptRays& kept, GatherScratch& scratch);

/// Takes from the brightest rays over the hemisphere what they find beyond four times the light of the fourth
/// brightest. That three rays or fewer find it is chance: a gather beside this one may find none of it.
/// @return its irradiance
Rgb take_rare_light(const HemisphereStrata& strata, GatherScratch& scratch);

/// The irradiance and its summary from what the rays found, each by its weight.
IrradianceSample add_up_rays(const HemisphereStrata& strata, const glm::vec3& normal, GatherScratch& scratch);

/// Its part over the hemisphere: sets everything in `out` but the irradiance, which must be set.
void summarize_hemisphere(const HemisphereStrata& strata, const Basis& basis, GatherScratch& scratch,
                          IrradianceSample& out);

/// Random numbers of a place on a surface: a cell of the triangle, so that the last bits of the hit hardly ever matter.
RandomKey make_place_key(std::uint32_t seed, const Hit& hit);

}  // namespace aleph
