#include "render/surface/scatter.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <optional>

#include "render/surface/glass.h"
#include "render/surface/sheen.h"

namespace aleph {

namespace {

Basis make_shading_basis(const SurfacePoint& point, const SurfaceMaterial& material) {
    if (material.gloss.stretch > 0.0f) {
        const glm::vec3 flat = material.gloss.tangent - point.normal * glm::dot(point.normal, material.gloss.tangent);
        const float length = glm::length(flat);
        if (length > 1e-6f) {
            const glm::vec3 tangent = flat / length;
            return {tangent, glm::cross(point.normal, tangent), point.normal};
        }
    }
    return make_basis(point.normal);
}

LobeValue evaluate_coat(const LitSurface& lit, const glm::vec3& direction) {
    const SurfaceMaterial& material = lit.material;
    const glm::vec3 light = lit.coat_basis.to_local(direction);
    if (material.is_coat_mirror() || !(light.z > 0.0f && lit.coat_view.z > 0.0f)) return {};
    const glm::vec2 widths(material.coat.alpha);
    const glm::vec3 sum = lit.coat_view + light;
    const float length = glm::length(sum);
    const glm::vec3 h = sum / length;
    const float value = ggx_d(widths, h) * smith_g2(widths, lit.coat_view, light) / (4.0f * lit.coat_view.z) *
                        coat_reflectance(material.coat, 0.5f * length);
    return {Rgb(value), pdf_reflected(widths, lit.coat_view, h)};
}

/// @param light  in the shading frame; not on the horizon
LobeValue evaluate_lobe(const LitSurface& lit, Lobe lobe, const glm::vec3& direction, const glm::vec3& light) {
    const SurfaceMaterial& material = lit.material;
    if (lobe == Lobe::glass) {
        const LobeValue glass = evaluate_glass(material, lit.view, light);
        return {glass.f_cos * lit.below_both(direction), glass.pdf};
    }
    if (!(light.z > 0.0f)) return {};
    switch (lobe) {
        case Lobe::diffuse:
            return {evaluate_diffuse(material, lit.cos_view, light.z) *
                        (light.z * lit.below_sheen * lit.layers.relative(direction)),
                    pdf_cosine_hemisphere(light.z)};
        case Lobe::gloss:
            return {evaluate_glossy(material, lit.view, light) * (light.z * lit.below_both(direction)),
                    pdf_glossy(material, lit.view, light)};
        case Lobe::coat:
            return evaluate_coat(lit, direction);
        case Lobe::sheen:
            return {material.sheen.color * (evaluate_sheen_layer(material.sheen.alpha, lit.view, light) * light.z *
                                            std::min(lit.below_coat, lit.layers.below_coat(direction))),
                    1.0f / (2.0f * std::numbers::pi_v<float>)};
        case Lobe::glass:
            break;
    }
    return {};
}

/// Which lobes a material has, in the order of Lobe.
std::array<bool, lobe_count> list_lobes(const SurfaceMaterial& material) {
    return {material.has_diffuse(), material.has_glossy(), material.has_coat(), material.has_sheen(),
            material.has_glass()};
}

/// Direction that the coat reflects to, in the frame of the surface; none below the coat.
std::optional<glm::vec3> sample_coat(const LitSurface& lit, const glm::vec2& u) {
    if (!(lit.coat_view.z > 0.0f)) return std::nullopt;
    const SurfaceMaterial& material = lit.material;
    const glm::vec3 h = material.is_coat_mirror()
                            ? glm::vec3(0.0f, 0.0f, 1.0f)
                            : sample_visible_normal(glm::vec2(material.coat.alpha), lit.coat_view, u);
    const glm::vec3 reflected = 2.0f * glm::dot(lit.coat_view, h) * h - lit.coat_view;
    if (!(reflected.z > 0.0f)) return std::nullopt;
    return lit.basis.to_local(lit.coat_basis.to_world(reflected));
}

/// Direction of uniform density over the hemisphere.
glm::vec3 sample_sheen(const glm::vec2& u) {
    const float radius = std::sqrt(std::max(0.0f, 1.0f - u.x * u.x));
    const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
    return {radius * std::cos(phi), radius * std::sin(phi), u.x};
}

}  // namespace

LitSurface::LitSurface(const ViewedSurface& surface)
    : point(surface.point),
      material(surface.material),
      basis(make_shading_basis(point, material)),
      view(basis.to_local(surface.view)),
      cos_view(std::max(view.z, 0.0f)),
      coat_basis(basis),
      coat_view(view),
      layers(material, point.normal),
      below_coat(layers.below_coat(surface.view)),
      below_sheen(layers.below_all(surface.view)) {
    if (material.has_coat() && material.coat.normal != glm::vec3(0.0f)) {
        coat_basis = make_basis(material.coat.normal);
        coat_view = coat_basis.to_local(surface.view);
    }
}

LobeShares share_lobes(const LitSurface& lit, LobeSet set) {
    const SurfaceMaterial& material = lit.material;
    LobeShares shares{};
    const auto set_share = [&](Lobe lobe, float share) { shares[static_cast<int>(lobe)] = share; };
    if (set == LobeSet::all && material.has_diffuse()) {
        set_share(Lobe::diffuse, luminance(material.diffuse) * diffuse_transmission(material, lit.cos_view) *
                                     mean_diffuse_transmission(material) * lit.below_sheen);
    }
    if (material.has_glossy()) {
        // A reflectance of 0 straight on is above 0 at the microfacets of a rough surface.
        constexpr float rough = 1e-3f;
        set_share(Lobe::gloss, luminance(glossy_reflectance(material, lit.cos_view)) * lit.below_sheen +
                                   (material.is_mirror() ? 0.0f : rough * material.gloss.f90));
    }
    if (material.has_coat()) set_share(Lobe::coat, 1.0f - lit.below_coat);
    if (material.has_sheen()) set_share(Lobe::sheen, std::max(lit.below_coat - lit.below_sheen, 1e-4f));
    if (material.has_glass()) set_share(Lobe::glass, material.glass.share * lit.below_sheen);
    const float total = std::accumulate(shares.begin(), shares.end(), 0.0f);
    if (!(total > 0.0f) || !std::isfinite(total)) return {};
    // A lobe that is next to never sampled would be all noise where it matters.
    constexpr float least = 0.02f;
    float sum = 0.0f;
    for (float& share : shares) {
        if (share > 0.0f) share = std::max(share / total, least);
        sum += share;
    }
    for (float& share : shares) share /= sum;
    return shares;
}

Rgb scatter_towards(const LitSurface& lit, const glm::vec3& direction, float pdf_light, const LobeShares& shares) {
    const glm::vec3 light = lit.basis.to_local(direction);
    Rgb sum(0.0f);
    const std::array<bool, lobe_count> lobes = list_lobes(lit.material);
    for (int i = 0; i < lobe_count; ++i) {
        if (!lobes[i]) continue;
        const LobeValue value = evaluate_lobe(lit, static_cast<Lobe>(i), direction, light);
        const float pdf = value.pdf * shares[i];
        sum += value.f_cos * (pdf_light > 0.0f && pdf > 0.0f ? power_heuristic(pdf_light, pdf) : 1.0f);
    }
    return sum;
}

ScatterSample sample_scatter(const LitSurface& lit, const LobeShares& shares, float pick, const glm::vec2& u,
                             float side) {
    int chosen = 0;
    for (float left = pick; chosen + 1 < lobe_count && left >= shares[chosen]; ++chosen) left -= shares[chosen];
    while (chosen > 0 && !(shares[chosen] > 0.0f)) --chosen;  // rounding at the end
    const float share = shares[chosen];
    ScatterSample sample;
    if (!(share > 0.0f)) return sample;
    const SurfaceMaterial& material = lit.material;
    sample.share = share;
    sample.lobe = static_cast<Lobe>(chosen);
    const bool needs_view = sample.lobe != Lobe::diffuse && sample.lobe != Lobe::coat;
    if (needs_view && !(lit.view.z > 0.0f)) return sample;
    bool mirror = false;
    glm::vec3 local(0.0f);
    switch (sample.lobe) {
        case Lobe::diffuse:
            local = sample_cosine_hemisphere(u);
            break;
        case Lobe::gloss:
            local = sample_glossy(material, lit.view, u);
            mirror = material.is_mirror();
            if (mirror) sample.weight = glossy_reflectance(material, lit.view.z);
            break;
        case Lobe::coat: {
            const std::optional<glm::vec3> reflected = sample_coat(lit, u);
            if (!reflected) return sample;
            local = *reflected;
            mirror = material.is_coat_mirror();
            if (mirror) sample.weight = Rgb(coat_reflectance(material.coat, lit.coat_view.z));
            break;
        }
        case Lobe::sheen:
            local = sample_sheen(u);
            break;
        case Lobe::glass: {
            const GlassSample glass = sample_glass(material, lit.view, u, side);
            local = glass.light;
            mirror = material.is_glass_smooth();
            if (mirror) sample.weight = glass.weight;
            sample.passes = local.z < 0.0f;
            sample.straight = sample.passes && material.passes_straight();
            break;
        }
    }
    sample.direction = lit.basis.to_world(local);
    // Also below the true surface for a direction above the shading normal's horizon, or the other way round.
    const float facing = glm::dot(lit.point.geometric, sample.direction);
    if (!(sample.passes ? local.z < 0.0f && facing < 0.0f : facing > 0.0f) || (!sample.passes && !(local.z > 0.0f))) {
        sample.weight = Rgb(0.0f);
        return sample;
    }
    if (mirror) {
        sample.weight *= (sample.lobe == Lobe::coat ? 1.0f : lit.below_both(sample.direction)) / share;
        return sample;
    }
    const LobeValue value = evaluate_lobe(lit, sample.lobe, sample.direction, local);
    sample.pdf = value.pdf * share;
    sample.weight = sample.pdf > 0.0f ? value.f_cos / sample.pdf : Rgb(0.0f);
    return sample;
}

Rgb sheet_transmittance(const LitSurface& lit) {
    return evaluate_sheet(lit.material, lit.cos_view) * lit.below_sheen;
}

}  // namespace aleph
