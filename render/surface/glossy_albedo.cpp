#include "render/surface/glossy_albedo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>

#include "render/surface/fresnel.h"

namespace aleph {

namespace {

constexpr int steps = 24;  // of each side of the table

/// Rows by roughness (the square root of alpha), columns by the square root of the cosine.
using PartsTable = std::array<std::array<AlbedoParts, steps>, steps>;

AlbedoParts integrate_parts(float alpha, float cos_view) {
    constexpr int count = 512;
    constexpr float golden_ratio = 0.618034f;
    const glm::vec2 widths(std::max(alpha, min_ggx_alpha));
    const glm::vec3 view(std::sqrt((1.0f - cos_view) * (1.0f + cos_view)), 0.0f, cos_view);
    AlbedoParts parts;
    for (int i = 0; i < count; ++i) {
        const auto number = static_cast<float>(i);
        const glm::vec2 u((number + 0.5f) / count, glm::fract(number * golden_ratio));
        const glm::vec3 h = sample_visible_normal(widths, view, u);
        const float cosine = glm::dot(view, h);
        const glm::vec3 light = 2.0f * cosine * h - view;
        if (!(light.z > 0.0f)) continue;
        const float weight = smith_g2(widths, view, light) / (smith_g1(widths, view) * count);
        const float grazing = schlick_power(cosine);
        parts.straight += weight * (1.0f - grazing);
        parts.grazing += weight * grazing;
    }
    return parts;
}

PartsTable make_parts_table() {
    PartsTable table{};
    for (int i = 0; i < steps; ++i) {
        for (int k = 0; k < steps; ++k) {
            const float roughness = static_cast<float>(i) / (steps - 1), root = static_cast<float>(k) / (steps - 1);
            table[i][k] = integrate_parts(roughness * roughness, std::max(root * root, 1e-4f));
        }
    }
    return table;
}

AlbedoParts mix(const AlbedoParts& a, const AlbedoParts& b, float share) {
    return {a.straight + (b.straight - a.straight) * share, a.grazing + (b.grazing - a.grazing) * share};
}

}  // namespace

AlbedoParts ggx_albedo(float alpha, float cos_view) {
    static const PartsTable table = make_parts_table();
    const float row = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (steps - 1);
    const float column = std::sqrt(std::clamp(cos_view, 0.0f, 1.0f)) * (steps - 1);
    const int i = std::min(static_cast<int>(row), steps - 2), k = std::min(static_cast<int>(column), steps - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    return mix(mix(table[i][k], table[i][k + 1], b), mix(table[i + 1][k], table[i + 1][k + 1], b), a);
}

float mean_alpha(const SurfaceMaterial& material) {
    const glm::vec2 widths = material.widths();
    return 0.5f * (widths.x + widths.y);
}

}  // namespace aleph
