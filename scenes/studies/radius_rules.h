#pragma once
// Published rules for how far a value of an irradiance cache may be used, for comparison with the cache's own.

#include <optional>

#include "render/cache/irradiance_record.h"

namespace aleph {

enum class RadiusRule {
    /// Ward, Rubinstein and Clear 1988: the harmonic mean of the distances, and the sum of both terms of the error.
    split_sphere,
    /// Tabellion and Lamorlette 2004, Krivanek et al. 2006: the nearest distance, the larger term, neighbour clamping.
    nearest_clamped,
    /// Schwarzhaupt, Jensen and Jarosz 2012: the Hessian of the irradiance.
    hessian,
};

/// Eigenvalues of the Hessian of the irradiance's luminance over the tangent plane, per m2.
struct HessianEigenvalues {
    double first = 0.0, second = 0.0;
    double sum() const { return std::abs(first) + std::abs(second); }
};

/// From the cells of one gather. The samples are joined to a mesh of triangles that each send out the light of their
/// farthest corner, so that an edge of a near surface moves before what is behind it. The irradiance of these triangles
/// is known in closed form (Lambert); its second derivatives are central differences. The sign of a triangle is that of
/// its corners' order, which does not change while it is seen from one side.
/// @param scratch  of gather_irradiance
/// @param nearest  m, above 0; shorter distances count as this
/// @param farthest  m, of a cell whose ray met nothing
HessianEigenvalues find_hessian(const HemisphereStrata& strata, const glm::vec3& normal, const GatherScratch& scratch,
                                double nearest, double farthest);

/// Radius of the disc over which an error of half of (|l1| + |l2|) r^2 integrates to the bound, m:
/// (4 bound E / (pi (|l1| + |l2|)))^(1/4). No error along any direction is larger; the record's reach is a circle, not
/// an ellipse. Infinite where the Hessian is 0.
/// @param bound  relative error times area, m2
double hessian_radius(const HessianEigenvalues& hessian, double irradiance, double bound);

/// A value and how far it may be used.
struct RuledRecord {
    IrradianceRecord value;  ///< its position, normal, irradiance and gradients
    float reach = 0.0f;      ///< m, where the error is 1
    float turn = 1.0f;       ///< sqrt(1 - N.N_i) where the error is 1
    float least = 0.0f;      ///< m, of `reach`
};

/// What a rule needs of a gather besides its sample.
struct RuleInput {
    RadiusRule rule = RadiusRule::split_sphere;
    float accuracy = 0.1f;       ///< alpha; for `hessian` the bound over `area`
    double area = 1.0;           ///< m2
    float least = 0.0f;          ///< m, of the reach
    float most = 1.0f;           ///< m, of the reach
    HessianEigenvalues hessian;  ///< read for `hessian` alone
};

/// The change of normal at which a record of the rule `hessian`, which bounds translation alone, ceases to be used.
inline constexpr float hessian_turn = 0.2f;

/// A record with its gradients (Ward and Heckbert 1992). Where the value would vanish within the reach by its gradient,
/// the reach is shorter. Nothing if the irradiance is not finite.
std::optional<RuledRecord> make_ruled_record(const glm::vec3& position, const glm::vec3& normal,
                                             const IrradianceSample& sample, const RuleInput& input);

/// A record is used where this is below 1. Infinite in front of the record (Ward 1988).
float ruled_error(RadiusRule rule, const RuledRecord& record, const glm::vec3& position, const glm::vec3& normal);

}  // namespace aleph
