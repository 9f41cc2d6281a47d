#include "render/surface/surface_material.h"

#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "render/surface/bsdf.h"
#include "render/surface/sheen.h"

namespace aleph {

namespace {

/// Texture look-ups of one surface point.
struct Lookup {
    const ShadingScene& shading;
    const SurfacePoint& point;
    const MaterialTextures& textures;
    UvFootprint footprints[2]{};

    Lookup(const ShadingScene& s, const SurfacePoint& p, const RayFootprint& footprint)
        : shading(s), point(p), textures(s.textures->materials[p.material]) {
        if (!textures.any) return;
        for (int set = 0; set < 2; ++set) footprints[set] = make_uv_footprint(p, footprint, set);
    }

    bool has(TextureSlot slot) const { return textures.any && textures[slot].texture != no_index; }

    /// 1 without a texture.
    glm::vec4 operator()(TextureSlot slot) const {
        const TextureUse& use = textures[slot];
        if (!has(slot)) return glm::vec4(1.0f);
        return sample_texture(*shading.textures, use, point.uv[use.uv_set], footprints[use.uv_set]);
    }
};

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
glm::vec3 map_normal(const Lookup& look_up, TextureSlot slot, double map_scale, const glm::vec3& view) {
    const SurfacePoint& point = look_up.point;
    if (!look_up.has(slot)) return point.normal;
    const glm::vec3 outward = point.front ? point.normal : -point.normal;
    const TangentFrame frame = find_tangents(point, look_up.textures[slot], outward);
    if (frame.tangent == glm::vec3(0.0f)) return point.normal;
    const glm::vec4 texel = look_up(slot);
    const auto scale = static_cast<float>(map_scale);
    const glm::vec3 local((2.0f * texel.x - 1.0f) * scale, (2.0f * texel.y - 1.0f) * scale, 2.0f * texel.z - 1.0f);
    const glm::vec3 mapped = frame.tangent * local.x + frame.bitangent * local.y + outward * local.z;
    const float length = glm::length(mapped);
    if (!(length > 0.0f) || !std::isfinite(length)) return point.normal;
    return keep_visible((point.front ? mapped : -mapped) / length, point.normal, point.geometric, view);
}

void add_layers(const LayersOf<float, Rgb>& layers, const Lookup& look_up, SurfaceMaterial& surface) {
    if (layers.clearcoat > 0.0f) {
        const float strength = layers.clearcoat * look_up(TextureSlot::clearcoat).x;
        const float roughness =
            std::clamp(layers.clearcoat_roughness * look_up(TextureSlot::clearcoat_roughness).y, 0.0f, 1.0f);
        surface.coat.strength = std::clamp(strength, 0.0f, 1.0f);
        surface.coat.alpha = roughness * roughness;
    }
    if (layers.sheen_color != Rgb(0.0f)) {
        const Rgb color = layers.sheen_color * Rgb(look_up(TextureSlot::sheen_color));
        const float roughness = layers.sheen_roughness * look_up(TextureSlot::sheen_roughness).w;
        surface.sheen.color = glm::clamp(color, 0.0f, 1.0f);
        surface.sheen.alpha = std::clamp(roughness * roughness, min_sheen_alpha, 1.0f);
    }
    if (layers.anisotropy > 0.0f) {
        float strength = layers.anisotropy, angle = layers.anisotropy_rotation;
        if (look_up.has(TextureSlot::anisotropy)) {
            const glm::vec4 texel = look_up(TextureSlot::anisotropy);
            angle += std::atan2(2.0f * texel.y - 1.0f, 2.0f * texel.x - 1.0f);
            strength *= texel.z;
        }
        // A normal map gives the tangent space (KHR_materials_anisotropy).
        const TextureSlot space = look_up.has(TextureSlot::normal) ? TextureSlot::normal : TextureSlot::anisotropy;
        const SurfacePoint& point = look_up.point;
        const TangentFrame frame =
            find_tangents(point, look_up.textures[space], point.front ? point.normal : -point.normal);
        if (frame.tangent != glm::vec3(0.0f)) {
            surface.gloss.stretch = std::min(strength * strength, 1.0f);
            surface.gloss.tangent = frame.tangent * std::cos(angle) + frame.bitangent * std::sin(angle);
        }
    }
}

/// Beer-Lambert coefficients, 1/m: white becomes the colour over the distance.
Rgb find_attenuation(const MaterialValues& values) {
    if (!(values.glass.attenuation_distance > 0.0f)) return Rgb(0.0f);
    return -glm::log(glm::max(values.glass.attenuation_color, 1e-6f)) / values.glass.attenuation_distance;
}

/// Sets what glass does to rays that pass it.
void add_refraction(const MaterialValues& values, float thickness, bool front, SurfaceMaterial& surface) {
    surface.glass.ior = values.gloss.ior;
    surface.glass.volume = thickness > 0.0f;
    surface.glass.ior_ratio = values.gloss.ior;
    if (!surface.glass.volume) return;
    if (!front && values.gloss.ior > 0.0f) surface.glass.ior_ratio = 1.0f / values.gloss.ior;
    surface.glass.attenuation = find_attenuation(values);
}

void remove_gloss(SurfaceMaterial& material) {
    material.gloss.f0 = Rgb(0.0f);
    material.gloss.f90 = 0.0f;
}

/// Light that a lobe would have reflected is lost: the Lambert layer does not get it.
void remove_lobes(const EffectSet& skipped, SurfaceMaterial& material) {
    const bool glossy = skipped.contains(Effect::glossy_reflection),
               mirror = skipped.contains(Effect::mirror_reflection);
    if (material.is_mirror() ? mirror : glossy) remove_gloss(material);
    if (material.is_coat_mirror() ? mirror : glossy) material.coat.strength = 0.0f;
    if (glossy) material.sheen.color = Rgb(0.0f);
    if (skipped.contains(Effect::refraction)) material.glass.share = 0.0f;
}

/// Leaves the Lambert layer and emission alone.
void remove_specular(SurfaceMaterial& material) {
    remove_gloss(material);
    material.coat.strength = material.glass.share = 0.0f;
    material.sheen.color = Rgb(0.0f);
}

/// The widths of an anisotropic lobe count as their mean.
AlbedoParts glossy_albedo(const SurfaceMaterial& material, float cosine) {
    const glm::vec2 widths = material.widths();
    return ggx_albedo(0.5f * (widths.x + widths.y), cosine);
}

/// Returns whether a wide lobe would let light out from inside that is totally reflected, or keep in much that is not.
/// @param width   GGX alpha
/// @param cosine  of the view
bool leaks(const SurfaceMaterial& material, float width, float cosine) {
    const float ratio = material.glass.ior_ratio;
    if (!material.has_glass() || !(ratio < 1.0f)) return false;
    return std::asin(ratio) - std::acos(std::min(cosine, 1.0f)) < 2.0f * width;
}

/// The share of a footprint where a mask does not make a hole, of the points of a lattice (Roberts 2018, "The
/// Unreasonable Effectiveness of Quasirandom Sequences"). The mean of alpha does not tell it.
float masked_coverage(const Lookup& look_up, float alpha, float cutoff) {
    constexpr int most_points = 16;
    const TextureUse& use = look_up.textures[TextureSlot::base_color];
    const UvFootprint& part = look_up.footprints[use.uv_set];
    const bool is_point = !look_up.has(TextureSlot::base_color) || (part.dx == glm::vec2(0.0f) && part.dy == part.dx);
    const int points = is_point ? 1 : most_points;
    int shown = 0;
    for (int i = 0; i < points; ++i) {
        const glm::vec2 shift = glm::fract(0.5f + static_cast<float>(i) * glm::vec2(0.754877666f, 0.569840296f)) - 0.5f;
        const glm::vec2 at = look_up.point.uv[use.uv_set] + part.dx * shift.x + part.dy * shift.y;
        if (!(alpha * sample_texture(*look_up.shading.textures, use, at, {}).w < cutoff)) ++shown;
    }
    return static_cast<float>(shown) / static_cast<float>(points);
}

Rgb emission_of(const ShadingMaterial& material, const Lookup& look_up) {
    if (!material.emits || !(look_up.point.front || material.double_sided)) return Rgb(0.0f);
    return material.values.emission * Rgb(look_up(TextureSlot::emission));
}

}  // namespace

void blur_caustics(const ShadingScene& shading, ViewedSurface& surface) {
    SurfaceMaterial& material = surface.material;
    if (shading.skipped.contains(Effect::caustics)) return remove_specular(material);
    const float width = shading.caustic_width;
    material.coat.alpha = std::max(material.coat.alpha, width);
    const float cosine = std::abs(glm::dot(surface.point.normal, surface.view));
    if (material.passes_straight() || material.gloss.alpha >= width || leaks(material, width, cosine)) return;
    // Wider microfacets hide more of each other, and fewer of them are seen at grazing angles.
    const AlbedoParts narrow = glossy_albedo(material, cosine);
    material.gloss.alpha = width;
    const AlbedoParts wide = glossy_albedo(material, cosine);
    material.gloss.f0 *= narrow.straight / wide.straight;
    material.gloss.f90 *= narrow.grazing / wide.grazing;
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
    const Lookup look_up(shading, point, footprint);
    SurfaceMaterial surface;
    Rgb base = values.base_color * Rgb(point.color) * Rgb(look_up(TextureSlot::base_color));
    if (entry.material != nullptr && entry.material->unlit) {
        surface.emission = base;
        return surface;
    }
    const glm::vec4 gloss = look_up(TextureSlot::metallic_roughness);
    float metallic = values.gloss.metallic * gloss.z, roughness = values.gloss.roughness * gloss.y;
    float specular = values.gloss.specular * look_up(TextureSlot::specular).w;
    float transmission = values.glass.transmission * look_up(TextureSlot::transmission).x;
    // A texture or vertex colour may have more, or less than nothing; no surface reflects more.
    base = glm::clamp(base, 0.0f, 1.0f);
    for (float* share : {&metallic, &roughness, &specular, &transmission}) *share = std::clamp(*share, 0.0f, 1.0f);
    const float ior_reflectance = (values.gloss.ior - 1.0f) / (values.gloss.ior + 1.0f);
    const Rgb specular_color = values.gloss.specular_color * Rgb(look_up(TextureSlot::specular_color));
    const Rgb dielectric_f0 = glm::min(ior_reflectance * ior_reflectance * specular_color, Rgb(1.0f)) * specular;
    const float dielectric = 1.0f - metallic, opaque = dielectric * (1.0f - transmission);
    surface.diffuse = base * opaque;
    surface.gloss.f0 = dielectric_f0 * opaque + base * metallic;
    surface.gloss.f90 = specular * opaque + metallic;
    surface.gloss.f0_max = largest_channel(dielectric_f0);
    surface.gloss.f90_max = specular * dielectric + metallic;
    surface.gloss.alpha = roughness * roughness;
    if (transmission > 0.0f) {
        surface.glass.share = dielectric * transmission;
        surface.glass.tint = base;
        surface.glass.specular = specular;
        add_refraction(values, values.glass.thickness * look_up(TextureSlot::thickness).y, point.front, surface);
    }
    if (entry.layered) add_layers(values.layers, look_up, surface);
    surface.emission = emission_of(entry, look_up);
    if (!shading.skipped.empty()) remove_lobes(shading.skipped, surface);
    return surface;
}

Rgb emission_texel(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint) {
    return Rgb(Lookup(shading, point, footprint)(TextureSlot::emission));
}

Rgb surface_emission(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint) {
    return emission_of(shading.materials[point.material], Lookup(shading, point, footprint));
}

float surface_coverage(const ShadingScene& shading, const SurfacePoint& point, const RayFootprint& footprint) {
    const ShadingMaterial& entry = shading.materials[point.material];
    if (entry.material == nullptr || entry.material->opacity.mode == Opacity::Mode::opaque) return 1.0f;
    const Lookup look_up(shading, point, footprint);
    const float alpha = entry.values.alpha * point.color.w;
    if (entry.material->opacity.mode == Opacity::Mode::mask)
        return masked_coverage(look_up, alpha, static_cast<float>(entry.material->opacity.cutoff));
    return std::clamp(alpha * look_up(TextureSlot::base_color).w, 0.0f, 1.0f);
}

ViewedSurface view_surface(const ShadingScene& shading, const SurfacePoint& point, const glm::vec3& view,
                           const RayFootprint& footprint) {
    ViewedSurface surface{point, evaluate_material(shading, point, footprint), view};
    if (surface.material.has_specular() && point.normal != point.geometric) {
        surface.point.normal = keep_visible(point.normal, point.geometric, point.geometric, view);
    }
    if (!shading.textures->materials[point.material].maps_normals) return surface;
    const SurfacePoint unmapped = surface.point;
    // Averaged normals, made unit again, reflect more light than the normals do. Where several rays share a pixel, each
    // takes the normal at its own point.
    const Lookup look_up(shading, unmapped, footprint.whole_pixel ? footprint : RayFootprint{});
    const auto& scales = shading.materials[point.material].material->textures;
    if (surface.material.has_coat()) {
        surface.material.coat.normal =
            map_normal(look_up, TextureSlot::clearcoat_normal, scales.clearcoat_normal_scale, view);
    }
    surface.point.normal = map_normal(look_up, TextureSlot::normal, scales.normal_scale, view);
    return surface;
}

}  // namespace aleph
