#include "render/path/glossy_light.h"

#include <algorithm>
#include <cmath>

#include "render/settings/numbers.h"
#include "render/surface/glossy_albedo.h"
#include "render/surface/sheen.h"

namespace aleph {

namespace {

/// GGX width (roughness .3) from which irradiance can stand in: highlights of narrower lobes are noise where lights
/// alone are sampled.
constexpr float narrowest = 0.09f;

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
            const AlbedoParts parts = ggx_albedo(alpha, lit.view.z);
            const Rgb albedo = glossy_albedo(material, lit.view.z);
            const float more = std::max(material.gloss.f90 - luminance(material.gloss.f0), 0.0f);
            const float grazing = more * parts.grazing / std::max(luminance(albedo), 1e-6f);
            return {albedo * lit.below_sheen, lobe_deviation(alpha, lit.view.z, grazing)};
        }
        case Lobe::coat: {
            if (!(material.coat.alpha >= narrowest)) break;
            const AlbedoParts parts = ggx_albedo(material.coat.alpha, lit.coat_view.z);
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
