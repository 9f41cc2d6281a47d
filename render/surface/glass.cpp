#include "render/surface/glass.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

/// The direction behind the surface that refraction by the half vector leads to; 0 at total reflection.
glm::vec3 refract(const glm::vec3& view, const glm::vec3& h, float ratio) {
    const float c = glm::dot(view, h), inverse = 1.0f / ratio;
    const float cos2 = 1.0f - inverse * inverse * std::max(0.0f, (1.0f - c) * (1.0f + c));
    if (!(cos2 > 0.0f)) return glm::vec3(0.0f);
    return glm::normalize(h * (inverse * c - std::sqrt(cos2)) - view * inverse);
}

glm::vec3 flip(const glm::vec3& v) {
    return {v.x, v.y, -v.z};
}

/// Share of light that passes an interface, by the cosines on both sides, and not as what is left of the reflectance:
/// that cancels at grazing angles.
/// @param across  of the ray with the normal, in its medium; `along` of the refracted ray times the ratio
double transmittance(double near, double far, double ratio) {
    const double r2 = ratio * ratio, s = near + far, p = r2 * near + far;
    return 2.0 * near * far * (1.0 / (s * s) + r2 / (p * p));
}

/// In double: the half vector is a difference, and the cosines with it cancel.
LobeValue evaluate_refracted(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    const double ratio = material.glass.ior_ratio;
    const glm::dvec3 v(view), l(light);
    glm::dvec3 h = v + l * ratio;
    const double length = glm::length(h);
    if (!(length > 0.0)) return {};
    h /= h.z < 0.0 ? -length : length;
    const double vh = glm::dot(v, h), lh = glm::dot(l, h);
    if (!(vh > 0.0 && lh < 0.0)) return {};
    const glm::vec2 widths = material.widths();
    const double reflected = std::min(1.0, (1.0 - transmittance(vh, -ratio * lh, ratio)) * material.glass.specular);
    const double denominator = vh + ratio * lh;
    const double jacobian = ratio * ratio * -lh / (denominator * denominator);
    const auto common = static_cast<float>(static_cast<double>(ggx_d(widths, glm::vec3(h))) * vh /
                                           static_cast<double>(view.z) * jacobian * (1.0 - reflected));
    const LobeValue value{material.glass.tint * (common * material.glass.share * smith_g2(widths, view, flip(light))),
                          common * smith_g1(widths, view)};
    return std::isfinite(value.pdf) ? value : LobeValue{};
}

}  // namespace

float glass_reflectance(const SurfaceMaterial& material, float cosine) {
    const float full = dielectric_reflectance(cosine, material.glass.ior_ratio);
    return full < 1.0f ? std::min(1.0f, full * material.glass.specular) : 1.0f;
}

LobeValue evaluate_glass(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    if (!(view.z > 0.0f) || light.z == 0.0f || material.is_glass_smooth()) return {};
    const bool passes = light.z < 0.0f;
    if (passes && material.glass.volume) return evaluate_refracted(material, view, light);
    const glm::vec3 mirrored = passes ? flip(light) : light;
    // The angle to h from the length of the sum: the same for both directions, also where they are not exactly unit.
    const glm::vec3 sum = view + mirrored;
    const float length = glm::length(sum);
    const glm::vec2 widths = material.widths();
    const float reflected = glass_reflectance(material, 0.5f * length);
    const float share = passes ? 1.0f - reflected : reflected;
    const float d = share * ggx_d(widths, sum / length) / (4.0f * view.z);
    return {(passes ? material.glass.tint : Rgb(1.0f)) * (d * material.glass.share * smith_g2(widths, view, mirrored)),
            d * smith_g1(widths, view)};
}

GlassSample sample_glass(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u, float side) {
    const bool smooth = material.is_glass_smooth();
    const glm::vec3 h = smooth ? glm::vec3(0.0f, 0.0f, 1.0f) : sample_visible_normal(material.widths(), view, u);
    const float vh = glm::dot(view, h);
    const glm::vec3 reflected = 2.0f * vh * h - view;
    if (side < glass_reflectance(material, vh)) {
        if (!(reflected.z > 0.0f)) return {};
        return {reflected, smooth ? Rgb(material.glass.share) : Rgb(0.0f)};
    }
    const glm::vec3 passed = material.glass.volume ? refract(view, h, material.glass.ior_ratio) : flip(reflected);
    if (!(passed.z < 0.0f)) return {};
    return {passed, smooth ? material.glass.tint * material.glass.share : Rgb(0.0f)};
}

Rgb evaluate_sheet(const SurfaceMaterial& material, float cos_view) {
    return material.glass.tint * (material.glass.share * (1.0f - glass_reflectance(material, cos_view)));
}

}  // namespace aleph
