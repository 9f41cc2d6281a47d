#include "engine/gltf/write/decompose.h"

#include <cmath>
#include <glm/matrix.hpp>

#include "engine/scene/transforms.h"

namespace aleph {

namespace {

/// Cosine of the angle between columns that counts as 0.
constexpr double right_angle_cosine = 1e-7;

bool has_right_angles(const glm::dmat3& m) {
    const glm::dvec3 columns[3] = {safe_normalize(m[0]), safe_normalize(m[1]), safe_normalize(m[2])};
    return std::abs(glm::dot(columns[0], columns[1])) <= right_angle_cosine &&
           std::abs(glm::dot(columns[1], columns[2])) <= right_angle_cosine &&
           std::abs(glm::dot(columns[2], columns[0])) <= right_angle_cosine;
}

/// How near two rotations are: 3 where they are the same, -1 at worst.
double nearness(const glm::dmat3& a, const glm::dmat3& b) {
    return glm::dot(a[0], b[0]) + glm::dot(a[1], b[1]) + glm::dot(a[2], b[2]);
}

/// Replaces columns of length 0 by what makes a rotation, near the axes of `before`.
/// @param axes  of length 1 or 0, at right angles
void complete_axes(glm::dmat3& axes, const glm::dmat3& before) {
    for (int i = 0; i < 3; ++i) {
        if (axes[i] != glm::dvec3(0.0)) continue;
        glm::dvec3 axis(0.0);
        for (const int k : {i, (i + 1) % 3, (i + 2) % 3}) {  // the rest of an axis beside the others
            glm::dvec3 rest = before[k];
            for (int j = 0; j < 3; ++j) rest -= axes[j] * glm::dot(axes[j], rest);
            if (glm::length(rest) > 0.1) {
                axis = safe_normalize(rest);
                break;
            }
        }
        axes[i] = axis;
    }
}

/// Rotation and scale of a matrix whose columns are at right angles. The scales keep the signs that they had before, so
/// that a turn stays one; where the matrix begins or ends to mirror, the signs are those whose rotation is nearest.
void split_scale(const glm::dmat3& m, const TransformParts& before, TransformParts& parts) {
    const glm::dmat3 last = glm::mat3_cast(before.rotation);
    glm::dmat3 axes;
    glm::dvec3 lengths;
    for (int i = 0; i < 3; ++i) {
        axes[i] = safe_normalize(m[i]);
        lengths[i] = glm::length(m[i]);
    }
    complete_axes(axes, last);
    const double orientation = glm::determinant(axes);
    double nearest = -4.0;
    for (int bits = 0; bits < 8; ++bits) {
        const glm::dvec3 signs(bits & 1 ? -1.0 : 1.0, bits & 2 ? -1.0 : 1.0, bits & 4 ? -1.0 : 1.0);
        if (orientation * signs.x * signs.y * signs.z < 0.0) continue;  // no rotation
        bool keeps_signs = true;
        for (int i = 0; i < 3; ++i) keeps_signs = keeps_signs && std::signbit(before.scale[i]) == (signs[i] < 0.0);
        const glm::dmat3 rotation(axes[0] * signs.x, axes[1] * signs.y, axes[2] * signs.z);
        const double near = keeps_signs ? 4.0 : nearness(rotation, last);
        if (near <= nearest + 1e-9) continue;
        nearest = near;
        parts.rotation = safe_normalize(glm::quat_cast(rotation));
        parts.scale = lengths * signs;
    }
}

/// The 24 ways to name and turn the axes of a rotation: signed permutations without mirrors.
template <class Visit>
void for_each_naming(const Visit& visit) {
    constexpr int orders[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
    for (const auto& order : orders) {
        for (int signs = 0; signs < 8; ++signs) {
            glm::dmat3 naming(0.0);
            for (int i = 0; i < 3; ++i) naming[i][order[i]] = (signs >> i & 1) != 0 ? -1.0 : 1.0;
            if (glm::determinant(naming) > 0.0) visit(naming);
        }
    }
}

/// The axes along which a matrix stretches, as a rotation near one before.
glm::dmat3 stretch_axes(const glm::dmat3& m, const glm::dmat3& before) {
    glm::dmat3 v = decompose_singular(m).v;
    if (glm::determinant(v) < 0.0) v[0] = -v[0];
    glm::dmat3 best = v;
    double nearest = -4.0;
    for_each_naming([&](const glm::dmat3& naming) {
        const glm::dmat3 named = v * naming;
        const double near = nearness(named, before);
        if (near <= nearest + 1e-9) return;
        nearest = near;
        best = named;
    });
    return best;
}

}  // namespace

TransformParts decompose(const glm::dmat4& matrix, const TransformParts& before) {
    TransformParts parts;
    parts.translation = glm::dvec3(matrix[3]);
    const glm::dmat3 m(matrix);
    // The axes before will do where the matrix stretches along them, or alike in all directions.
    glm::dmat3 along = glm::transpose(glm::mat3_cast(before.inner));
    if (has_right_angles(m * along)) {
        parts.inner = before.inner;
    } else {
        along = stretch_axes(m, along);
        parts.inner = safe_normalize(glm::quat_cast(glm::transpose(along)));
    }
    split_scale(m * along, before, parts);
    return parts;
}

}  // namespace aleph
