#include "render/surface/bsdf.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "render/settings/numbers.h"

namespace aleph {

namespace {

constexpr int albedo_steps = 24;  // of each side of the table

/// Rows by roughness (the square root of alpha), columns by the square root of the cosine.
using PartsTable = std::array<std::array<AlbedoParts, albedo_steps>, albedo_steps>;

PartsTable make_parts_table() {
    PartsTable table{};
    for (int i = 0; i < albedo_steps; ++i) {
        for (int k = 0; k < albedo_steps; ++k) {
            const float roughness = static_cast<float>(i) / (albedo_steps - 1),
                        root = static_cast<float>(k) / (albedo_steps - 1);
            table[i][k] = integrate_ggx_albedo(roughness * roughness, std::max(root * root, 1e-4f), 512);
        }
    }
    return table;
}

AlbedoParts mix(const AlbedoParts& a, const AlbedoParts& b, float share) {
    return {a.straight + (b.straight - a.straight) * share, a.grazing + (b.grazing - a.grazing) * share};
}

}  // namespace

float diffuse_transmission(const SurfaceMaterial& material, float cosine) {
    return 1.0f - (material.gloss.f0_max + (material.gloss.f90_max - material.gloss.f0_max) * schlick_power(cosine));
}

float mean_diffuse_transmission(const SurfaceMaterial& material) {
    return 1.0f - (material.gloss.f0_max + (material.gloss.f90_max - material.gloss.f0_max) / 21.0f);
}

Rgb evaluate_diffuse(const SurfaceMaterial& material, float cos_view, float cos_light) {
    return material.diffuse *
           (diffuse_transmission(material, cos_view) * diffuse_transmission(material, cos_light) / pi);
}

float relative_transmission(const SurfaceMaterial& material, float cos_light) {
    const float mean = mean_diffuse_transmission(material);
    return mean > 0.0f ? diffuse_transmission(material, cos_light) / mean : 1.0f;
}

Rgb diffuse_radiance(const SurfaceMaterial& material, float cos_view, const Rgb& irradiance) {
    return material.diffuse * irradiance *
           (diffuse_transmission(material, cos_view) * mean_diffuse_transmission(material) / pi);
}

Rgb glossy_reflectance(const SurfaceMaterial& material, float cosine) {
    return material.gloss.f0 + (Rgb(material.gloss.f90) - material.gloss.f0) * schlick_power(cosine);
}

Rgb evaluate_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    const bool above = view.z > 0.0f && light.z > 0.0f && view.z * light.z > 0.0f;  // the product may underflow
    if (!above || material.is_mirror()) return Rgb(0.0f);
    // The angle to h from the length of the sum: the same for both directions, also where they are not exactly unit.
    const glm::vec3 sum = view + light;
    const float length = glm::length(sum);
    const glm::vec2 widths = material.widths();
    return glossy_reflectance(material, 0.5f * length) *
           (ggx_d(widths, sum / length) * smith_g2(widths, view, light) / (4.0f * view.z * light.z));
}

glm::vec3 sample_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u) {
    if (material.is_mirror()) return {-view.x, -view.y, view.z};
    const glm::vec3 h = sample_visible_normal(material.widths(), view, u);
    return 2.0f * glm::dot(view, h) * h - view;
}

float pdf_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    if (!(view.z > 0.0f && light.z > 0.0f) || material.is_mirror()) return 0.0f;
    return pdf_reflected(material.widths(), view, glm::normalize(view + light));
}

AlbedoParts integrate_ggx_albedo(float alpha, float cos_view, int samples) {
    const auto count = static_cast<float>(samples);
    constexpr float golden_ratio = 0.618034f;
    const glm::vec2 widths(std::max(alpha, min_ggx_alpha));
    const glm::vec3 view(std::sqrt((1.0f - cos_view) * (1.0f + cos_view)), 0.0f, cos_view);
    AlbedoParts parts;
    for (int i = 0; i < samples; ++i) {
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

AlbedoParts ggx_albedo(float alpha, float cos_view) {
    static const PartsTable table = make_parts_table();
    const float row = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (albedo_steps - 1);
    const float column = std::sqrt(std::clamp(cos_view, 0.0f, 1.0f)) * (albedo_steps - 1);
    const int i = std::min(static_cast<int>(row), albedo_steps - 2),
              k = std::min(static_cast<int>(column), albedo_steps - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    return mix(mix(table[i][k], table[i][k + 1], b), mix(table[i + 1][k], table[i + 1][k + 1], b), a);
}

}  // namespace aleph
