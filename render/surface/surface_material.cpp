#include "render/surface/surface_material.h"

#include <cmath>
#include <glm/geometric.hpp>

#include "render/surface/sheen.h"

namespace aleph {

namespace {

/// Texture look-ups of one surface point.
struct Lookup {
    const ShadingScene& shading;
    const SurfacePoint& point;
    UvFootprint footprints[2]{};

    Lookup(const ShadingScene& s, const SurfacePoint& p) : shading(s), point(p) {}
    Lookup(const ShadingScene& s, const SurfacePoint& p, const RayFootprint& footprint)
        : shading(s), point(p), footprints{make_uv_footprint(p, footprint, 0), make_uv_footprint(p, footprint, 1)} {}

    glm::vec4 operator()(const TextureUse& use) const {
        return sample_texture(*shading.textures, use, point.uv[use.uv_set], footprints[use.uv_set]);
    }
};

bool is_used(const TextureUse& use) {
    return use.texture != no_index;
}

/// Along +u and against v, on the surface's front side; 0 where the texture coordinates have no area.
struct TangentFrame {
    glm::vec3 tangent{0.0f}, bitangent{0.0f};
};

TangentFrame find_tangents(const SurfacePoint& point, const TextureUse& use, const glm::vec3& outward) {
    glm::vec2 f1 = point.uv_edges[use.uv_set][0], f2 = point.uv_edges[use.uv_set][1];
    if (use.transformed) {
        f1 = use.matrix * f1;
        f2 = use.matrix * f2;
    }
    // In double: the products of a narrow triangle nearly cancel, and those of floats are exact there.
    const glm::dvec2 d1(f1), d2(f2);
    const glm::dvec3 e1(point.edges[0]), e2(point.edges[1]), up(outward);
    const double determinant = d1.x * d2.y - d1.y * d2.x;
    if (determinant == 0.0 || !std::isfinite(determinant)) return {};
    const glm::dvec3 along_u = (e1 * d2.y - e2 * d1.y) / determinant;
    const glm::vec3 along_v = (e2 * d1.x - e1 * d2.x) / determinant;
    const glm::vec3 flat = along_u - up * glm::dot(up, along_u);
    const float length = glm::length(flat);
    if (!(length > 0.0f) || !std::isfinite(length)) return {};
    TangentFrame frame;
    frame.tangent = flat / length;
    frame.bitangent = glm::cross(outward, frame.tangent);
    if (glm::dot(frame.bitangent, along_v) > 0.0f) frame.bitangent = -frame.bitangent;
    return frame;
}

/// The normal that a normal map gives, on the viewer's side.
glm::vec3 map_normal(const Lookup& look_up, const TextureUse& use, float scale, const glm::vec3& view) {
    const SurfacePoint& point = look_up.point;
    const glm::vec3 outward = point.front ? point.normal : -point.normal;
    const TangentFrame frame = find_tangents(point, use, outward);
    if (frame.tangent == glm::vec3(0.0f)) return point.normal;
    const glm::vec4 texel = look_up(use);
    const glm::vec3 local((2.0f * texel.x - 1.0f) * scale, (2.0f * texel.y - 1.0f) * scale, 2.0f * texel.z - 1.0f);
    const glm::vec3 mapped = frame.tangent * local.x + frame.bitangent * local.y + outward * local.z;
    const float length = glm::length(mapped);
    if (!(length > 0.0f) || !std::isfinite(length)) return point.normal;
    return keep_visible((point.front ? mapped : -mapped) / length, point.normal, point.geometric, view);
}

void add_layers(const MaterialValues& values, const MaterialTextures& textures, const Lookup& look_up,
                SurfaceMaterial& surface) {
    if (values.clearcoat > 0.0f) {
        float roughness = values.clearcoat_roughness;
        surface.coat = values.clearcoat;
        if (is_used(textures.clearcoat)) surface.coat *= look_up(textures.clearcoat).x;
        if (is_used(textures.clearcoat_roughness)) roughness *= look_up(textures.clearcoat_roughness).y;
        surface.coat_alpha = roughness * roughness;
    }
    if (values.sheen_color != Rgb(0.0f)) {
        float roughness = values.sheen_roughness;
        surface.sheen = values.sheen_color;
        if (is_used(textures.sheen_color)) surface.sheen *= Rgb(look_up(textures.sheen_color));
        if (is_used(textures.sheen_roughness)) roughness *= look_up(textures.sheen_roughness).w;
        surface.sheen_alpha = std::max(min_sheen_alpha, roughness * roughness);
    }
    if (values.anisotropy > 0.0f) {
        float strength = values.anisotropy, angle = values.anisotropy_rotation;
        if (is_used(textures.anisotropy)) {
            const glm::vec4 texel = look_up(textures.anisotropy);
            angle += std::atan2(2.0f * texel.y - 1.0f, 2.0f * texel.x - 1.0f);
            strength *= texel.z;
        }
        const SurfacePoint& point = look_up.point;
        const TangentFrame frame =
            find_tangents(point, textures.anisotropy, point.front ? point.normal : -point.normal);
        if (frame.tangent != glm::vec3(0.0f)) {
            surface.stretch = strength * strength;
            surface.tangent = frame.tangent * std::cos(angle) + frame.bitangent * std::sin(angle);
        }
    }
}

/// Beer-Lambert coefficients, 1/m: white becomes the colour over the distance.
Rgb find_attenuation(const MaterialValues& values) {
    if (!(values.attenuation_distance > 0.0f)) return Rgb(0.0f);
    Rgb attenuation;
    for (int c = 0; c < 3; ++c) {
        attenuation[c] = -std::log(std::max(values.attenuation_color[c], 1e-6f)) / values.attenuation_distance;
    }
    return attenuation;
}

/// Sets what glass does to rays that pass it.
void add_refraction(const MaterialValues& values, float thickness, bool front, SurfaceMaterial& surface) {
    surface.ior = values.ior;
    surface.volume = thickness > 0.0f;
    surface.ior_ratio = values.ior;
    if (!surface.volume) return;
    if (!front && values.ior > 0.0f) surface.ior_ratio = 1.0f / values.ior;
    surface.attenuation = find_attenuation(values);
}

void remove_gloss(SurfaceMaterial& material) {
    material.f0 = Rgb(0.0f);
    material.f90 = 0.0f;
}

/// Light that a lobe would have reflected is lost: the Lambert layer does not get it.
void remove_lobes(const EffectSet& skipped, SurfaceMaterial& material) {
    const bool glossy = skipped.contains(Effect::glossy_reflection),
               mirror = skipped.contains(Effect::mirror_reflection);
    if (material.is_mirror() ? mirror : glossy) remove_gloss(material);
    if (material.is_coat_mirror() ? mirror : glossy) material.coat = 0.0f;
    if (glossy) material.sheen = Rgb(0.0f);
    if (skipped.contains(Effect::refraction)) material.glass = 0.0f;
}

}  // namespace

void remove_specular(SurfaceMaterial& material) {
    remove_gloss(material);
    material.coat = material.glass = 0.0f;
    material.sheen = Rgb(0.0f);
}

glm::vec3 keep_visible(const glm::vec3& normal, const glm::vec3& fallback, const glm::vec3& geometric,
                       const glm::vec3& view) {
    const auto is_good = [&](const glm::vec3& n) {
        constexpr float least = 1e-3f;
        const float facing = glm::dot(n, view);
        return facing > least && glm::dot(2.0f * facing * n - view, geometric) > least;
    };
    if (is_good(normal)) return normal;
    float bad = 0.0f, good = 1.0f;  // shares of the fallback
    glm::vec3 best = fallback;
    for (int step = 0; step < 8; ++step) {
        const float share = 0.5f * (bad + good);
        const glm::vec3 between = normal + (fallback - normal) * share;
        const float length = glm::length(between);
        if (length > 0.0f && is_good(between / length)) {
            good = share;
            best = between / length;
        } else {
            bad = share;
        }
    }
    return best;
}

SurfaceMaterial evaluate_material(const ShadingScene& shading, const SurfacePoint& point,
                                  const RayFootprint& footprint) {
    const ShadingMaterial& entry = shading.materials[point.material];
    const MaterialValues& values = entry.values;
    Rgb base = values.base_color * Rgb(point.color);
    float metallic = values.metallic, roughness = values.roughness, specular = values.specular;
    float transmission = values.transmission, thickness = values.thickness;
    Rgb emission = values.emission, specular_color = values.specular_color;
    const MaterialTextures& textures = shading.textures->materials[point.material];
    const auto finish = [&](const Lookup& look_up) {
        SurfaceMaterial surface;
        if (entry.material != nullptr && entry.material->unlit) {
            surface.emission = base;
            return surface;
        }
        const float ior_reflectance = (values.ior - 1.0f) / (values.ior + 1.0f);
        const Rgb dielectric_f0 = glm::min(ior_reflectance * ior_reflectance * specular_color, Rgb(1.0f)) * specular;
        const float dielectric = 1.0f - metallic, opaque = dielectric * (1.0f - transmission);
        surface.diffuse = base * opaque;
        surface.f0 = dielectric_f0 * opaque + base * metallic;
        surface.f90 = specular * opaque + metallic;
        surface.f0_max = std::max({dielectric_f0.x, dielectric_f0.y, dielectric_f0.z});
        surface.f90_max = specular * dielectric + metallic;
        surface.alpha = roughness * roughness;
        if (transmission > 0.0f) {
            surface.glass = dielectric * transmission;
            surface.glass_tint = base;
            surface.glass_specular = specular;
            add_refraction(values, thickness, point.front, surface);
        }
        if (entry.layered) add_layers(values, textures, look_up, surface);
        if (entry.emits && (point.front || entry.double_sided)) surface.emission = emission;
        if (!shading.skipped.empty()) remove_lobes(shading.skipped, surface);
        return surface;
    };
    if (!textures.any) return finish(Lookup(shading, point));
    const Lookup look_up(shading, point, footprint);
    if (is_used(textures.base_color)) base *= Rgb(look_up(textures.base_color));
    if (is_used(textures.metallic_roughness)) {
        const glm::vec4 t = look_up(textures.metallic_roughness);
        roughness *= t.y;
        metallic *= t.z;
    }
    if (entry.emits && is_used(textures.emission)) emission *= Rgb(look_up(textures.emission));
    if (is_used(textures.specular)) specular *= look_up(textures.specular).w;
    if (is_used(textures.specular_color)) specular_color *= Rgb(look_up(textures.specular_color));
    if (is_used(textures.transmission)) transmission *= look_up(textures.transmission).x;
    if (is_used(textures.thickness)) thickness *= look_up(textures.thickness).y;
    return finish(look_up);
}

float surface_coverage(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint) {
    const ShadingMaterial& entry = shading.materials[point.material];
    if (entry.material == nullptr || entry.material->alpha_mode == Material::AlphaMode::opaque) return 1.0f;
    const MaterialTextures& textures = shading.textures->materials[point.material];
    float alpha = entry.values.alpha * point.color.w;
    if (textures.any && is_used(textures.base_color)) alpha *= Lookup(shading, point, footprint)(textures.base_color).w;
    if (entry.material->alpha_mode == Material::AlphaMode::blend) return std::clamp(alpha, 0.0f, 1.0f);
    return alpha < static_cast<float>(entry.material->alpha_cutoff) ? 0.0f : 1.0f;
}

ViewedSurface view_surface(const ShadingScene& shading, const SurfacePoint& point, const glm::vec3& view,
                           const RayFootprint& footprint) {
    ViewedSurface surface{point, evaluate_material(shading, point, footprint), view};
    const MaterialTextures& textures = shading.textures->materials[point.material];
    const Material* const material = shading.materials[point.material].material;
    if (surface.material.has_specular() && point.normal != point.geometric) {
        surface.point.normal = keep_visible(point.normal, point.geometric, point.geometric, view);
    }
    if (!textures.maps_normals || material == nullptr) return surface;
    const SurfacePoint unmapped = surface.point;
    const Lookup look_up(shading, unmapped, footprint);
    if (surface.material.has_coat()) {
        surface.material.coat_normal = is_used(textures.clearcoat_normal)
                                           ? map_normal(look_up, textures.clearcoat_normal,
                                                        static_cast<float>(material->clearcoat_normal_scale), view)
                                           : unmapped.normal;
    }
    if (is_used(textures.normal)) {
        surface.point.normal = map_normal(look_up, textures.normal, static_cast<float>(material->normal_scale), view);
    }
    return surface;
}

}  // namespace aleph
