#pragma once
// A matrix as translation, rotation, scale and, where it shears, a second rotation below the scale.

#include <glm/gtc/quaternion.hpp>
#include <glm/mat4x4.hpp>

namespace aleph {

/// M = translate(translation) * rotation * scale * inner. Where M mirrors, one scale is negative, or all are.
struct TransformParts {
    glm::dvec3 translation{0.0};
    glm::dquat rotation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 scale{1.0};
    glm::dquat inner{1.0, 0.0, 0.0, 0.0};
};

/// Decomposes a matrix, of the possible ways in the one that continues `before`, so that keys of a motion can be interpolated.
/// Columns at right angles within 1e-7 count as such: the matrix is then off by so much of its size.
/// @param matrix  affine
/// @param before  the parts of the key before; of the first key: TransformParts{}
TransformParts decompose(const glm::dmat4& matrix, const TransformParts& before);

}  // namespace aleph
