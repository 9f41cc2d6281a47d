#include "render/surface/bsdf.h"

#include <glm/geometric.hpp>

#include "render/settings/numbers.h"
#include "render/surface/fresnel.h"

namespace aleph {

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
    if (!(view.z > 0.0f && light.z > 0.0f) || material.is_mirror()) return Rgb(0.0f);
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

}  // namespace aleph
