#include "render/path/glossy_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/pixels/lattice.h"
#include "render/settings/numbers.h"
#include "render/surface/fresnel.h"
#include "render/surface/sheen.h"

namespace aleph {

namespace {

constexpr int rows = 24, columns = 24;

/// GGX width (roughness .3) from which irradiance can stand in: highlights of narrower lobes are noise where lights
/// alone are sampled.
constexpr float narrowest = 0.09f;

/// Parts of the albedo that are proportional to the reflectance straight on and at grazing incidence.
struct AlbedoParts {
    float straight = 0.0f, grazing = 0.0f;
};

/// Rows by roughness (the square root of alpha), columns by the square root of the cosine.
using Table = std::array<std::array<AlbedoParts, columns>, rows>;

AlbedoParts integrate_albedo(float alpha, float cos_view) {
    constexpr int count = 512;
    const glm::vec2 widths(std::max(alpha, min_ggx_alpha));
    const glm::vec3 view(std::sqrt((1.0f - cos_view) * (1.0f + cos_view)), 0.0f, cos_view);
    AlbedoParts parts;
    for (int i = 0; i < count; ++i) {
        const glm::vec3 h = sample_visible_normal(widths, view, lattice_point(i, count, glm::vec2(0.0f)));
        const float cosine = glm::dot(view, h);
        const glm::vec3 light = 2.0f * cosine * h - view;
        if (!(light.z > 0.0f)) continue;
        const float weight = smith_g2(widths, view, light) / (smith_g1(widths, view) * static_cast<float>(count));
        const float grazing = schlick_power(cosine);
        parts.straight += weight * (1.0f - grazing);
        parts.grazing += weight * grazing;
    }
    return parts;
}

Table make_table() {
    Table table{};
    for (int i = 0; i < rows; ++i) {
        for (int k = 0; k < columns; ++k) {
            const float roughness = static_cast<float>(i) / (rows - 1), root = static_cast<float>(k) / (columns - 1);
            table[i][k] = integrate_albedo(roughness * roughness, std::max(root * root, 1e-4f));
        }
    }
    return table;
}

AlbedoParts mix(const AlbedoParts& a, const AlbedoParts& b, float share) {
    return {a.straight + (b.straight - a.straight) * share, a.grazing + (b.grazing - a.grazing) * share};
}

AlbedoParts find_parts(float alpha, float cos_view) {
    static const Table table = make_table();
    const float row = std::sqrt(std::clamp(alpha, 0.0f, 1.0f)) * (rows - 1);
    const float column = std::sqrt(std::clamp(cos_view, 0.0f, 1.0f)) * (columns - 1);
    const int i = std::min(static_cast<int>(row), rows - 2), k = std::min(static_cast<int>(column), columns - 2);
    const float a = row - static_cast<float>(i), b = column - static_cast<float>(k);
    return mix(mix(table[i][k], table[i][k + 1], b), mix(table[i + 1][k], table[i + 1][k + 1], b), a);
}

float mean_alpha(const SurfaceMaterial& material) {
    const glm::vec2 widths = material.widths();
    return 0.5f * (widths.x + widths.y);
}

/// Share of uniform light that a lobe reflects, and how far real light is from uniform, relative.
struct LobeStandIn {
    Rgb albedo{0.0f};
    float deviation = 0.0f;  ///< root mean square; infinite: the lobe has to be sampled
};

/// How far the mean of indirect light over a GGX lobe is from its mean over the hemisphere, relative. Fitted to root
/// mean squares over surfaces of cornell, room, art-gallery and antique-room: light varies more from place to place
/// near the horizon, where a lobe that is seen at a grazing angle looks, and where a dielectric reflects most.
/// @param grazing  share of the albedo that is due to more reflectance at grazing incidence than straight on
float lobe_deviation(float alpha, float cos_view, float grazing) {
    const float by_width = 1.6f * std::pow(1.0f - std::sqrt(std::min(alpha, 1.0f)), 1.2f) + 0.08f;
    const float by_view = 1.0f - std::clamp(cos_view - 0.5f, 0.0f, 0.5f);
    return by_view * by_width + 0.4f * grazing;
}

LobeStandIn find_stand_in(const LitSurface& lit, Lobe lobe) {
    const SurfaceMaterial& material = lit.material;
    switch (lobe) {
        case Lobe::gloss: {
            const float alpha = mean_alpha(material);
            if (!(std::min(material.widths().x, material.widths().y) >= narrowest)) break;
            const AlbedoParts parts = find_parts(alpha, lit.view.z);
            const Rgb albedo = glossy_albedo(material, lit.view.z);
            const float more = std::max(material.gloss.f90 - luminance(material.gloss.f0), 0.0f);
            const float grazing = more * parts.grazing / std::max(luminance(albedo), 1e-6f);
            return {albedo * lit.below_sheen, lobe_deviation(alpha, lit.view.z, grazing)};
        }
        case Lobe::coat: {
            if (!(material.coat.alpha >= narrowest)) break;
            const AlbedoParts parts = find_parts(material.coat.alpha, lit.coat_view.z);
            return {Rgb((1.0f - lit.below_coat) * (parts.straight + parts.grazing)),
                    lobe_deviation(material.coat.alpha, lit.coat_view.z, 0.0f)};
        }
        case Lobe::sheen:
            return {material.sheen.color *
                        (sheen_albedo(material.sheen.alpha, lit.cos_view) * lit.sheen_scale * lit.below_coat),
                    lobe_deviation(1.0f, lit.cos_view, 1.0f)};
        case Lobe::diffuse:
        case Lobe::glass:
            break;
    }
    return {Rgb(0.0f), infinite};
}

}  // namespace

Rgb glossy_albedo(const SurfaceMaterial& material, float cos_view) {
    const AlbedoParts parts = find_parts(mean_alpha(material), cos_view);
    return material.gloss.f0 * parts.straight + Rgb(material.gloss.f90 * parts.grazing);
}

SampledLobes choose_sampled_lobes(const LitSurface& lit, const Rgb& irradiance, float tolerance) {
    SampledLobes out;
    out.shares = share_lobes(lit, LobeSet::specular);
    if (!(tolerance > 0.0f)) return out;
    const Rgb uniform = irradiance / pi;
    while (true) {
        int least = no_index;
        float least_error = tolerance - out.error;
        Rgb radiance(0.0f);
        for (const Lobe lobe : {Lobe::gloss, Lobe::coat, Lobe::sheen}) {
            const int i = static_cast<int>(lobe);
            if (!(out.shares[i] > 0.0f)) continue;
            const LobeStandIn stand_in = find_stand_in(lit, lobe);
            const float error = luminance(stand_in.albedo * uniform) * stand_in.deviation;
            if (!(error <= least_error)) continue;
            least = i;
            least_error = error;
            radiance = stand_in.albedo * uniform;
        }
        if (least == no_index) break;
        out.shares[least] = 0.0f;
        out.radiance += radiance;
        out.error += least_error;
    }
    float sum = 0.0f;
    for (const float share : out.shares) sum += share;
    for (float& share : out.shares) share = sum > 0.0f ? share / sum : 0.0f;
    return out;
}

}  // namespace aleph
