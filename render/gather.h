#pragma once
// One irradiance value: rays over the hemisphere, the light they bring, and how it changes around the point.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "render/direct_light.h"

namespace aleph {

/// Nothing stands near, in any sector of azimuth.
constexpr std::array<float, 16> unlimited_clearance() {
    std::array<float, 16> all{};
    all.fill(std::numeric_limits<float>::infinity());
    return all;
}

/// Indirect irradiance at a point with its gradients (Ward and Heckbert 1992, "Irradiance Gradients").
struct IrradianceSample {
    Rgb irradiance{0.0f};                             ///< of reflected light; lights seen directly are left out
    std::array<glm::vec3, 3> rotation_gradient{};     ///< per colour channel: dE = dot(cross(N_i, N), gradient)
    std::array<glm::vec3, 3> translation_gradient{};  ///< per colour channel, per m, in the tangent plane
    float harmonic_mean_distance = 0.0f;              ///< m (6.5); infinite where nothing was met
    /// How far the tangent plane is free, by sectors of azimuth (sector_of), m: nearest hit of the lowest row of
    /// strata.
    std::array<float, 16> clearance = unlimited_clearance();
    /// How high the space over the point is free, m: the lowest hit above the tangent plane of all other rows.
    /// Something stands between this point and what lies higher.
    float headroom = std::numeric_limits<float>::infinity();
    int ignored_distances = 0;  ///< hits too near to be true, left out of the mean (HARD_CASES IC-05)
};

/// Which sixteenth of the circle a direction with these tangent-plane coordinates lies in, in no particular order.
inline std::size_t sector_of(float x, float y) {
    const float across = std::abs(x), along = std::abs(y);
    constexpr float tan_half = 0.41421356f;  // of 22.5 degrees
    const bool diagonal = std::min(across, along) > tan_half * std::max(across, along);
    return static_cast<std::size_t>((x < 0.0f ? 1 : 0) | (y < 0.0f ? 2 : 0) | (across < along ? 4 : 0) |
                                    (diagonal ? 8 : 0));
}

/// How a hemisphere is cut: rows in elevation, columns in azimuth, columns about pi times rows.
struct HemisphereStrata {
    int rows = 1;
    int columns = 1;
    int count() const { return rows * columns; }
};

/// Strata with exactly `samples` cells where a divisor pair near the ideal ratio exists, else the most that fit.
HemisphereStrata choose_strata(int samples);

/// Buffers that a gathering task keeps, so that no gather allocates after its first.
struct GatherScratch {
    std::vector<Ray> rays, shadow_rays;
    std::vector<Hit> hits;
    std::vector<std::uint8_t> blocked;
    std::vector<int> shadow_owner;
    std::vector<Rgb> radiance;
    std::vector<float> distances;  ///< m; infinite for a miss
    std::vector<float> sorted;
};

/// Gathers light that surfaces reflect after one bounce. At each hit one light is chosen in proportion to what it would
/// bring unshadowed, and one shadow ray decides.
/// @param key  random numbers depend on this alone
IrradianceSample gather_irradiance(const LightingContext& context, Tracer& tracer, const SurfacePoint& point,
                                   const HemisphereStrata& strata, const RandomKey& key, GatherScratch& scratch,
                                   RayCounts& counts);

}  // namespace aleph
