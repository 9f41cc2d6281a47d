#include "render/surface/sheen.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace aleph {

namespace {

constexpr int rows = 32, columns = 80;
const float least_roughness = std::sqrt(min_sheen_alpha);

/// The albedo times the roughness, which varies little. Rows by roughness (the square root of alpha), dense where it is
/// low; columns by spread_cosine.
using Table = std::array<std::array<float, columns>, rows>;

/// A cosine as a number from 0 to 1 that is dense near the horizon, where the layer is bright: within cosines of about
/// the roughness.
float spread_cosine(float roughness, float cosine) {
    const float half = 2.0f * roughness;
    return std::sqrt(cosine * (1.0f + half) / (cosine + half));
}

struct SpreadCosine {
    double cosine, slope;  ///< slope: d cosine / d x
};
SpreadCosine invert_spread(double roughness, double x) {
    const double half = 2.0 * roughness, rest = 1.0 + half - x * x;
    return {x * x * half / rest, 2.0 * x * half * (1.0 + half) / (rest * rest)};
}

float look_up_albedo(const Table& table, float alpha, float cos_view) {
    // Compared so that a number that is none becomes the least one.
    const float root = std::sqrt(alpha), r = root > least_roughness ? std::min(root, 1.0f) : least_roughness;
    const float cosine = cos_view > 0.0f ? std::min(cos_view, 1.0f) : 0.0f;
    const float row = std::sqrt((r - least_roughness) / (1.0f - least_roughness)) * (rows - 1);
    const float column = spread_cosine(r, cosine) * (columns - 1);
    const int i = std::min(static_cast<int>(row), rows - 2), k = std::min(static_cast<int>(column), columns - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    const float scaled = (1.0f - a) * ((1.0f - b) * table[i][k] + b * table[i][k + 1]) +
                         a * ((1.0f - b) * table[i + 1][k] + b * table[i + 1][k + 1]);
    return scaled / r;
}

/// By the midpoint rule.
/// @param limits  divides by the largest of 1 and both directions' albedos in it; null: does not
float integrate_albedo(float roughness, float cos_view, const Table* limits) {
    constexpr int heights = 64, azimuths = 24;  // of half the circle
    const float alpha = roughness * roughness;
    const glm::vec3 view(std::sqrt((1.0f - cos_view) * (1.0f + cos_view)), 0.0f, cos_view);
    double sum = 0.0;
    for (int i = 0; i < heights; ++i) {
        const auto [z, slope] = invert_spread(roughness, (i + 0.5) / heights);
        const double s = std::sqrt(1.0 - z * z);
        double ring = 0.0;
        for (int k = 0; k < azimuths; ++k) {
            const double phi = std::numbers::pi * (k + 0.5) / azimuths;
            ring += evaluate_sheen(alpha, view, glm::vec3(s * std::cos(phi), s * std::sin(phi), z));
        }
        const auto limit = [&](double cosine) {
            return limits == nullptr ? 1.0f : look_up_albedo(*limits, alpha, static_cast<float>(cosine));
        };
        sum += ring * z * slope / std::max({1.0f, limit(cos_view), limit(z)});
    }
    return static_cast<float>(sum * 2.0 * std::numbers::pi / (heights * azimuths));
}

Table make_albedo_table(const Table* limits = nullptr) {
    Table table{};
    for (int i = 0; i < rows; ++i) {
        const float r =
            least_roughness + (1.0f - least_roughness) * static_cast<float>(i * i) / ((rows - 1) * (rows - 1));
        for (int k = 0; k < columns; ++k) {
            const auto cosine = static_cast<float>(invert_spread(r, static_cast<double>(k) / (columns - 1)).cosine);
            table[i][k] = r * integrate_albedo(r, std::clamp(cosine, 1e-6f, 1.0f), limits);
        }
    }
    return table;
}

const Table& albedo_table() {
    static const Table table = make_albedo_table();
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
    return look_up_albedo(albedo_table(), alpha, cos_view);
}

float evaluate_sheen_layer(float alpha, const glm::vec3& view, const glm::vec3& light) {
    return evaluate_sheen(alpha, view, light) /
           std::max({1.0f, sheen_albedo(alpha, view.z), sheen_albedo(alpha, light.z)});
}

float sheen_layer_albedo(float alpha, float cos_view) {
    static const Table table = make_albedo_table(&albedo_table());
    return std::min(look_up_albedo(table, alpha, cos_view), 1.0f);
}

}  // namespace aleph
