#include "render/surface/layers.h"

#include <array>
#include <cmath>

#include "render/surface/bsdf.h"
#include "render/surface/sheen.h"

namespace aleph {

namespace {

constexpr int coat_rows = 32, coat_columns = 48;
const float least_coat_roughness = std::sqrt(min_ggx_alpha);

/// Albedo over the reflectance of a smooth coat, which varies little. Rows by roughness (the square root of alpha),
/// dense where it is low, columns by coat_column.
using CoatTable = std::array<std::array<float, coat_columns>, coat_rows>;

/// From 0 to 1, dense where microfacets hide each other: within cosines of about alpha.
float coat_column(float alpha, float cosine) {
    const float half = 2.0f * alpha;
    return std::sqrt(cosine * (1.0f + half) / (cosine + half));
}
float coat_cosine(float alpha, float column) {
    const float half = 2.0f * alpha, square = column * column;
    return square * half / (1.0f + half - square);
}

CoatTable make_coat_table() {
    constexpr int samples = 1024;
    CoatTable table{};
    for (int i = 0; i < coat_rows; ++i) {
        const float share = static_cast<float>(i * i) / ((coat_rows - 1) * (coat_rows - 1));
        const float roughness = least_coat_roughness + (1.0f - least_coat_roughness) * share;
        const float alpha = roughness * roughness;
        for (int k = 0; k < coat_columns; ++k) {
            const float cosine =
                std::clamp(coat_cosine(alpha, static_cast<float>(k) / (coat_columns - 1)), 1e-6f, 1.0f);
            const AlbedoParts parts = integrate_ggx_albedo(alpha, cosine, samples);
            table[i][k] = (coat_f0 * parts.straight + parts.grazing) / coat_reflectance({.strength = 1.0f}, cosine);
        }
    }
    return table;
}

/// Nodes and weights of Gauss and Legendre's rule on [0, 1].
constexpr std::array<std::array<float, 2>, 8> legendre{{{0.01985507f, 0.05061427f},
                                                        {0.10166676f, 0.11119052f},
                                                        {0.23723380f, 0.15685332f},
                                                        {0.40828268f, 0.18134189f},
                                                        {0.59171732f, 0.18134189f},
                                                        {0.76276620f, 0.15685332f},
                                                        {0.89833324f, 0.11119052f},
                                                        {0.98014493f, 0.05061427f}}};

}  // namespace

float coat_reflectance(const CoatLayer& coat, float cosine) {
    return coat.strength * (coat_f0 + (1.0f - coat_f0) * schlick_power(cosine));
}

float coat_albedo(const CoatLayer& coat, float cosine) {
    static const CoatTable table = make_coat_table();
    const float c = std::clamp(cosine, 0.0f, 1.0f), smooth = coat_reflectance(coat, c);
    if (coat.alpha < min_ggx_alpha) return smooth;
    const float alpha = std::min(coat.alpha, 1.0f);
    const float share = (std::sqrt(alpha) - least_coat_roughness) / (1.0f - least_coat_roughness);
    const float row = std::sqrt(std::max(share, 0.0f)) * (coat_rows - 1);
    const float column = coat_column(alpha, c) * (coat_columns - 1);
    const int i = std::min(static_cast<int>(row), coat_rows - 2),
              k = std::min(static_cast<int>(column), coat_columns - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    return smooth * ((1.0f - a) * ((1.0f - b) * table[i][k] + b * table[i][k + 1]) +
                     a * ((1.0f - b) * table[i + 1][k] + b * table[i + 1][k + 1]));
}

UpperLayers::UpperLayers(const SurfaceMaterial& material, const glm::vec3& normal)
    : material_(material),
      normal_(normal),
      coat_normal_(material.coat.normal == glm::vec3(0.0f) ? normal : material.coat.normal),
      any_(material.has_coat() || material.has_sheen()) {
    if (!any_ || !material.has_diffuse()) return;
    // With the coat's normal along the surface's. Any other lets less light in, so that none is added.
    float sum = 0.0f, total = 0.0f;
    for (const auto& [root, width] : legendre) {  // by the square root of the cosine
        const float cosine = root * root, weight = width * cosine * root * diffuse_transmission(material, cosine);
        sum += weight * left_by(cosine, cosine);
        total += weight;
    }
    if (total > 0.0f && sum > 0.0f) mean_ = sum / total;
}

float UpperLayers::left_by(float cos_coat, float cos_sheen) const {
    const float left = material_.has_coat() ? 1.0f - coat_albedo(material_.coat, cos_coat) : 1.0f;
    if (!material_.has_sheen()) return left;
    return left *
           (1.0f - largest_channel(material_.sheen.color) * sheen_layer_albedo(material_.sheen.alpha, cos_sheen));
}

float UpperLayers::below_coat(const glm::vec3& direction) const {
    if (!material_.has_coat()) return 1.0f;
    return 1.0f - coat_albedo(material_.coat, std::abs(glm::dot(coat_normal_, direction)));
}

float UpperLayers::below_all(const glm::vec3& direction) const {
    if (!any_) return 1.0f;
    return left_by(std::abs(glm::dot(coat_normal_, direction)), std::abs(glm::dot(normal_, direction)));
}

float UpperLayers::entering(const glm::vec3& direction, float cosine) const {
    return relative_transmission(material_, cosine) * relative(direction);
}

}  // namespace aleph
