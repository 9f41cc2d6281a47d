#include "render/sheen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace aleph {

namespace {

constexpr int size = 32;
constexpr double pi = std::numbers::pi;

/// Rows by roughness (the square root of alpha), columns by the cosine of the view.
using Table = std::array<std::array<float, size>, size>;

float at_step(int i) {
    return static_cast<float>(i) / static_cast<float>(size - 1);
}

/// By the midpoint rule; sqrt-spaced cosines resolve the layer's brightness at grazing light.
float integrate_albedo(float alpha, float cos_view) {
    constexpr int steps = 64;
    const float c = std::max(cos_view, 1e-3f);
    const glm::vec3 view(std::sqrt(1.0f - c * c), 0.0f, c);
    double sum = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double root = (i + 0.5) / steps, z = root * root;
        const double width = 2.0 * root / steps;  // dz
        for (int k = 0; k < steps; ++k) {
            const double phi = 2.0 * pi * (k + 0.5) / steps, s = std::sqrt(1.0 - z * z);
            const glm::vec3 light(s * std::cos(phi), s * std::sin(phi), z);
            sum += evaluate_sheen(alpha, view, light) * z * width * (2.0 * pi / steps);
        }
    }
    return static_cast<float>(std::min(sum, 1.0));
}

Table make_table() {
    Table table{};
    for (int i = 0; i < size; ++i) {
        const float roughness = std::max(at_step(i), 0.03f);
        for (int k = 0; k < size; ++k) table[i][k] = integrate_albedo(roughness * roughness, at_step(k));
    }
    return table;
}

}  // namespace

float evaluate_sheen(float alpha, const glm::vec3& view, const glm::vec3& light) {
    if (!(view.z > 0.0f && light.z > 0.0f)) return 0.0f;
    const glm::vec3 h = glm::normalize(view + light);
    const float sine = std::sqrt(std::min(h.x * h.x + h.y * h.y, 1.0f));
    const float inverse = 1.0f / alpha;
    const float d = (2.0f + inverse) * std::pow(sine, inverse) / (2.0f * std::numbers::pi_v<float>);
    return d / (4.0f * (light.z + view.z - light.z * view.z));
}

float sheen_albedo(float alpha, float cos_view) {
    static const Table table = make_table();
    const float row = std::clamp(std::sqrt(alpha), 0.0f, 1.0f) * (size - 1);
    const float column = std::clamp(cos_view, 0.0f, 1.0f) * (size - 1);
    const int i = std::min(static_cast<int>(row), size - 2), k = std::min(static_cast<int>(column), size - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    return (1.0f - a) * ((1.0f - b) * table[i][k] + b * table[i][k + 1]) +
           a * ((1.0f - b) * table[i + 1][k] + b * table[i + 1][k + 1]);
}

}  // namespace aleph
