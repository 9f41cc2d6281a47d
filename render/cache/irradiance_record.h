#pragma once
// One record of an irradiance cache: a gathered value, how far it may be used, and how it is moved to a place nearby.
//
// Error. At a point P with normal N, the relative error of using record i is taken to be the largest of
//     |P - P_i| / R_i                 R_i: 3.5 times the distance to the nearest surface that the record's rays met,
//     |P - P_i|^2 / S_i^2             S_i: from the differences found between this record and its neighbours,
//     sqrt(1 - N.N_i)                 change of the normal (Ward, Rubinstein and Clear 1988).
// It is used where this is less than alpha, the accuracy of the pixel. Ward takes the harmonic mean of the distances
// and the sum of two terms. The harmonic mean overlooks thin objects nearby; the nearest distance and the larger term
// are Tabellion and Lamorlette's (2004, "An Approximate Global Illumination System for Computer Generated Films").
//
// Gradients: a record's value is moved to P and N by its translation and rotation gradients before it is averaged
// (Ward and Heckbert 1992, "Irradiance Gradients"). What is left grows with the square of the distance: S_i.
//
// Clearance (not in these papers): where alpha or the pixel is large, a record reaches past its nearest surface, and
// light would leak behind it. It stores how far the nearest obstacles are (FreeSpace). Beyond them a ray decides.

#include <cmath>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "render/cache/gather.h"

namespace aleph {

/// How far shading uses a record, as a multiple of how far filling the cache does: records on both sides of a point
/// then contribute to it.
inline constexpr float shade_reach = 1.4f;

/// How far a point may lie off the mean of both tangent planes, as a share of R_i: on the record's side of it, where
/// light from over an edge arrives (Ward 1988 rejects it all; rounding and facets need a little), and on the other.
inline constexpr float max_in_front = 0.05f, max_behind = 0.1f;

inline constexpr float inverse_root_two = 0.70710678f;

struct GatherNoise {
    float error = 0.0f;         ///< standard error of the gather's luminance over its value
    float ray_variance = 0.0f;  ///< of a single gather ray, relative: error^2 times their number
};

struct IrradianceRecord {
    glm::vec3 position{0.0f};  ///< m, relative to the frame's anchor
    float radius = 0.0f;       ///< R_i, m; positive and finite; neighbour clamping may shrink it later
    glm::vec3 normal{0.0f};    ///< unit
    float growth = 0.0f;       ///< 1 / S_i^2, 1/m2; 0: no difference found
    Rgb irradiance{0.0f};
    Rgb rare{0.0f};  ///< more irradiance, which few rays found (take_rare_light); 0 after IrradianceCache::finish
    float min_radius = 0.0f;  ///< m; neighbour clamping stops here
    IrradianceGradients gradients{};
    glm::vec3 tangent{0.0f};  ///< of make_basis(normal), for the sectors of `space`
    FreeSpace space{};        ///< beyond its sectors a ray decides; above its headroom the record is not used
    GatherNoise noise{};
    float accuracy = 1.0f;                                      ///< alpha of the pixel that it was computed for
    float max_growth = std::numeric_limits<float>::infinity();  ///< 1/m2: `growth` stops here

    /// S_i, m; infinite where no difference was found.
    float spread() const { return 1.0f / std::sqrt(growth); }
};

/// Bounds for R_i and S_i, m.
struct RadiusBounds {
    float min = 0.0f;         ///< of R_i, from the pixel's footprint
    float max = 0.0f;         ///< of R_i, from the scene's size
    float min_spread = 0.0f;  ///< of S_i, from the pixel's footprint
};

/// A record of a gathered value. Where a gradient is so large that the value would vanish within R_i, R_i is smaller,
/// down to its bound, and only then the gradient is: near a wall its terms grow without bound. Nothing if the
/// irradiance is not finite: one such record would spoil every pixel that uses it.
/// @param accuracy  alpha of the pixel, above 0
std::optional<IrradianceRecord> make_record(const glm::vec3& position, const glm::vec3& normal, float accuracy,
                                            const IrradianceSample& sample, const RadiusBounds& bounds);

/// m, with a tolerance for rounding.
inline float most_headroom(const IrradianceRecord& record) {
    constexpr float tolerance = 1e-3f;
    return record.space.headroom + tolerance * record.radius;
}

/// The error above. The last term is computed as |N - N_i| / sqrt 2, which is equal but does not cancel for small
/// angles. Infinite where the record must not be used: its normal faces away, the point lies out of its tangent plane
/// (under it, above it or behind an edge), or beyond its headroom.
float interpolation_error(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

/// Returns whether the point is beyond the record's clearance, so that something may stand between them.
bool is_beyond_clearance(const IrradianceRecord& record, const glm::vec3& position);

/// A record's irradiance moved to another place by its gradients, within [0, 2 E_i].
Rgb extrapolate(const IrradianceRecord& record, const glm::vec3& position, const glm::vec3& normal);

/// Standard error of the difference of two records, relative to their values.
inline float combined_noise(const IrradianceRecord& a, const IrradianceRecord& b) {
    return std::sqrt(a.noise.error * a.noise.error + b.noise.error * b.noise.error);
}

/// By how much two records that are near each other are found to be wrong: growth, 1/m2, for both. Each is moved to the
/// other's place and compared with the value there, less what the noise of both explains.
float measure_growth(const IrradianceRecord& a, const IrradianceRecord& b);

}  // namespace aleph
