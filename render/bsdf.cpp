#include "render/bsdf.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace aleph {

namespace {

constexpr float pi = std::numbers::pi_v<float>;

/// A narrower lobe is a mirror in single precision.
constexpr float min_alpha = 1e-3f;

float schlick_power(float cosine) {
    const float m = std::clamp(1.0f - cosine, 0.0f, 1.0f);
    return (m * m) * (m * m) * m;
}

/// Walter et al. 2007, eq. 33. sin^2 comes from |h x n|^2: 1 - cos^2 would cancel for narrow lobes.
float ggx_d(float alpha, const glm::vec3& h) {
    const float a2 = alpha * alpha;
    const float sin2 = h.x * h.x + h.y * h.y;
    const float s = a2 * h.z * h.z + sin2;
    return a2 / (pi * s * s);
}

float smith_lambda(float alpha, const glm::vec3& v) {
    const float tan2 = (v.x * v.x + v.y * v.y) / (v.z * v.z);
    return 0.5f * (std::sqrt(1.0f + alpha * alpha * tan2) - 1.0f);
}

}  // namespace

SurfaceMaterial evaluate_material(const ShadingScene& shading, const SurfacePoint& point,
                                  const RayFootprint& footprint) {
    const ShadingMaterial& entry = shading.materials[point.material];
    const MaterialValues& values = entry.values;
    Rgb base = values.base_color * Rgb(point.color);
    float metallic = values.metallic, roughness = values.roughness, specular = values.specular;
    Rgb emission = values.emission, specular_color = values.specular_color;
    const MaterialTextures& textures = shading.textures->materials[point.material];
    if (textures.any) {
        const UvFootprint uv_footprints[2] = {make_uv_footprint(point, footprint, 0),
                                              make_uv_footprint(point, footprint, 1)};
        const auto look_up = [&](const TextureUse& use) {
            return sample_texture(*shading.textures, use, point.uv[use.uv_set], uv_footprints[use.uv_set]);
        };
        if (textures.base_color.texture != no_index) base *= Rgb(look_up(textures.base_color));
        if (textures.metallic_roughness.texture != no_index) {
            const glm::vec4 t = look_up(textures.metallic_roughness);
            roughness *= t.y;
            metallic *= t.z;
        }
        if (entry.emits && textures.emission.texture != no_index) emission *= Rgb(look_up(textures.emission));
        if (textures.specular.texture != no_index) specular *= look_up(textures.specular).w;
        if (textures.specular_color.texture != no_index) specular_color *= Rgb(look_up(textures.specular_color));
    }
    SurfaceMaterial surface;
    if (entry.material != nullptr && entry.material->unlit) {
        surface.emission = base;
        return surface;
    }
    const float ior_reflectance = (values.ior - 1.0f) / (values.ior + 1.0f);
    const Rgb dielectric_f0 = glm::min(ior_reflectance * ior_reflectance * specular_color, Rgb(1.0f)) * specular;
    surface.diffuse = base * (1.0f - metallic);
    surface.f0 = dielectric_f0 * (1.0f - metallic) + base * metallic;
    surface.f90 = specular * (1.0f - metallic) + metallic;
    surface.f0_max = std::max({dielectric_f0.x, dielectric_f0.y, dielectric_f0.z});
    surface.alpha = std::max(roughness * roughness, min_alpha);
    if (entry.emits && (point.front || entry.double_sided)) surface.emission = emission;
    return surface;
}

float diffuse_transmission(const SurfaceMaterial& material, float cosine) {
    return 1.0f - (material.f0_max + (material.f90 - material.f0_max) * schlick_power(cosine));
}

float mean_diffuse_transmission(const SurfaceMaterial& material) {
    return 1.0f - (material.f0_max + (material.f90 - material.f0_max) / 21.0f);
}

Rgb evaluate_diffuse(const SurfaceMaterial& material, float cos_view, float cos_light) {
    return material.diffuse *
           (diffuse_transmission(material, cos_view) * diffuse_transmission(material, cos_light) / pi);
}

Rgb diffuse_radiance(const SurfaceMaterial& material, float cos_view, const Rgb& irradiance) {
    return material.diffuse * irradiance *
           (diffuse_transmission(material, cos_view) * mean_diffuse_transmission(material) / pi);
}

Rgb evaluate_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    if (!(view.z > 0.0f && light.z > 0.0f)) return Rgb(0.0f);
    const glm::vec3 h = glm::normalize(view + light);
    const Rgb fresnel = material.f0 + (Rgb(material.f90) - material.f0) * schlick_power(glm::dot(view, h));
    const float g2 = 1.0f / (1.0f + smith_lambda(material.alpha, view) + smith_lambda(material.alpha, light));
    return fresnel * (ggx_d(material.alpha, h) * g2 / (4.0f * view.z * light.z));
}

glm::vec3 sample_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec2& u) {
    const float alpha = material.alpha;
    const glm::vec3 stretched = glm::normalize(glm::vec3(alpha * view.x, alpha * view.y, view.z));
    const float planar = stretched.x * stretched.x + stretched.y * stretched.y;
    const glm::vec3 t1 =
        planar > 0.0f ? glm::vec3(-stretched.y, stretched.x, 0.0f) / std::sqrt(planar) : glm::vec3(1.0f, 0.0f, 0.0f);
    const glm::vec3 t2 = glm::cross(stretched, t1);
    const float r = std::sqrt(u.x), phi = 2.0f * pi * u.y;
    const float p1 = r * std::cos(phi);
    const float s = 0.5f * (1.0f + stretched.z);
    const float p2 = (1.0f - s) * std::sqrt(std::max(0.0f, 1.0f - p1 * p1)) + s * r * std::sin(phi);
    const glm::vec3 n = t1 * p1 + t2 * p2 + stretched * std::sqrt(std::max(0.0f, 1.0f - p1 * p1 - p2 * p2));
    const glm::vec3 h = glm::normalize(glm::vec3(alpha * n.x, alpha * n.y, std::max(1e-6f, n.z)));
    return 2.0f * glm::dot(view, h) * h - view;
}

float pdf_glossy(const SurfaceMaterial& material, const glm::vec3& view, const glm::vec3& light) {
    if (!(view.z > 0.0f && light.z > 0.0f)) return 0.0f;
    const glm::vec3 h = glm::normalize(view + light);
    const float g1 = 1.0f / (1.0f + smith_lambda(material.alpha, view));
    return g1 * ggx_d(material.alpha, h) / (4.0f * view.z);
}

}  // namespace aleph
