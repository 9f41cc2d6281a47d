#include "engine/base/sampling.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace aleph {

Basis make_basis(const glm::vec3& n) {
    const float sign = std::copysign(1.0f, n.z);
    const float a = -1.0f / (sign + n.z);
    const float b = n.x * n.y * a;
    return {{1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x}, {b, sign + n.y * n.y * a, -n.y}, n};
}

glm::vec3 sample_cosine_hemisphere(const glm::vec2& u) {
    const float r = std::sqrt(u.x);
    const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
    return {r * std::cos(phi), r * std::sin(phi), std::sqrt(std::max(0.0f, 1.0f - u.x))};
}

float pdf_cosine_hemisphere(float cos_theta) {
    return std::max(0.0f, cos_theta) / std::numbers::pi_v<float>;
}

glm::vec2 sample_triangle(const glm::vec2& u) {
    const float root = std::sqrt(u.x);
    return {root * (1.0f - u.y), root * u.y};
}

float power_heuristic(float pdf_a, float pdf_b) {
    if (!(pdf_a > 0.0f)) return 0.0f;
    const float ratio = pdf_b / pdf_a;
    if (!(ratio >= 0.0f)) return std::isinf(pdf_a) ? 0.5f : 1.0f;  // inf/inf, or a NaN
    return 1.0f / (1.0f + ratio * ratio);
}

}  // namespace aleph
