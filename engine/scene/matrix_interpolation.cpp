// Keyed matrices: Shoemake and Duff 1992, "Matrix animation and polar decomposition".

#include <algorithm>
#include <glm/gtc/quaternion.hpp>

#include "engine/scene/components.h"
#include "engine/scene/track.h"
#include "engine/scene/transforms.h"

namespace aleph {
namespace {

/// M = sign * rotation * stretch; sign is -1 where M mirrors, and then goes with the stretch.
struct Polar {
    glm::dquat rotation;
    glm::dmat3 stretch;
    double sign;
    bool singular;
};

Polar decompose_polar(const glm::dmat3& m) {
    // Below this ratio of singular values the rotation is rounding error.
    constexpr double singular_ratio = 1e-12;
    const SingularValues svd = decompose_singular(m);
    const glm::dvec3& sigma = svd.sigma;
    const double largest = std::max({sigma.x, sigma.y, sigma.z});
    if (!(std::min({sigma.x, sigma.y, sigma.z}) > singular_ratio * largest)) return {{}, {}, 1.0, true};

    const glm::dmat3 orthogonal = svd.u * glm::transpose(svd.v);
    const double sign = glm::determinant(orthogonal) < 0.0 ? -1.0 : 1.0;
    const glm::dmat3 scaled(svd.v[0] * sigma.x, svd.v[1] * sigma.y, svd.v[2] * sigma.z);
    return {safe_normalize(glm::quat_cast(orthogonal * sign)), scaled * glm::transpose(svd.v), sign, false};
}

}  // namespace

glm::dmat4 interpolate_matrix(const glm::dmat4& a, const glm::dmat4& b, double fraction) {
    if (fraction <= 0.0 || a == b) return a;
    if (fraction >= 1.0) return b;
    glm::dmat4 result = lerp_components(a, b, fraction);
    if (glm::dmat3(a) == glm::dmat3(b)) return result;  // a pure move, exactly

    const Polar from = decompose_polar(glm::dmat3(a)), to = decompose_polar(glm::dmat3(b));
    // On the way into or out of a mirror the object has to pass through flat: it does so without a turn.
    if (from.singular || to.singular || from.sign != to.sign) return result;
    const glm::dmat3 rotation = glm::mat3_cast(slerp_short(from.rotation, to.rotation, fraction));
    const glm::dmat3 linear = rotation * lerp_components(from.stretch, to.stretch, fraction) * from.sign;
    for (int column = 0; column < 3; ++column) result[column] = glm::dvec4(linear[column], 0.0);
    return result;
}

}  // namespace aleph
