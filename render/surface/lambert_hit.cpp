#include "render/surface/lambert_hit.h"

#include <cmath>

#include "render/surface/texture.h"

namespace aleph {

namespace {

/// Base-colour texture, at the hit of a triangle.
Rgb look_up_albedo(const ShadingScene& shading, const TextureUse& use, const Mesh& mesh, const Hit& hit,
                   float footprint_area, float triangle_area) {
    const std::vector<glm::vec2>& uv = mesh.uv[use.uv_set];
    if (uv.empty()) return Rgb(sample_texture(*shading.textures, use, glm::vec2(0.0f), {}));
    const glm::uvec3& t = mesh.triangles[hit.primitive];
    const glm::vec2 e1 = uv[t.y] - uv[t.x], e2 = uv[t.z] - uv[t.x];
    const float scale = std::sqrt(footprint_area * std::abs(e1.x * e2.y - e1.y * e2.x) / triangle_area);
    const UvFootprint footprint{{scale, 0.0f}, {0.0f, scale}, true};
    return Rgb(sample_texture(*shading.textures, use, uv[t.x] + e1 * hit.u + e2 * hit.v, footprint));
}

}  // namespace

void prefetch_triangle(const ShadingScene& shading, const Hit& hit) {
    if (hit.instance == no_index) return;
    __builtin_prefetch(&shading.instances[hit.instance].mesh->triangles[hit.primitive]);
}

void prefetch_corners(const ShadingScene& shading, const Hit& hit) {
    if (hit.instance == no_index) return;
    const PosedInstance& instance = shading.instances[hit.instance];
    const glm::uvec3& t = instance.mesh->triangles[hit.primitive];
    const PosedMesh* const deformed = instance.deformed;
    for (int k = 0; k < 3; ++k) {
        if (deformed == nullptr) {
            __builtin_prefetch(&instance.mesh->positions[t[k]]);
        } else {
            __builtin_prefetch(&deformed->positions[t[k]]);
        }
    }
}

LambertHit make_lambert_hit(const ShadingScene& shading, const Ray& ray, const Hit& hit, const glm::vec3& normal,
                            float solid_angle) {
    const PosedInstance& instance = shading.instances[hit.instance];
    const glm::vec3 across = instance.flat ? normal : instance.normals * normal;
    const float area = glm::length(across);  // twice the triangle's
    const glm::vec3 unit = area > 0.0f ? across / area : -ray.direction;
    const float cosine = glm::dot(unit, ray.direction);
    LambertHit met{ray.origin + ray.direction * hit.distance, cosine > 0.0f ? -unit : unit,
                   shading.materials[instance.material].values.base_color};
    const Mesh& mesh = *instance.mesh;
    if (!mesh.colors.empty()) {
        const glm::uvec3& t = mesh.triangles[hit.primitive];
        met.albedo *=
            Rgb(mesh.colors[t.x] * (1.0f - hit.u - hit.v) + mesh.colors[t.y] * hit.u + mesh.colors[t.z] * hit.v);
    }
    const TextureUse& use = shading.textures->materials[instance.material][TextureSlot::base_color];
    if (use.texture != no_index) {
        const float footprint_area = cone_footprint_area(std::abs(cosine), hit.distance, solid_angle);
        met.albedo *= look_up_albedo(shading, use, mesh, hit, footprint_area, area);
    }
    met.albedo = glm::clamp(met.albedo, 0.0f, 1.0f);  // as evaluate_material
    return met;
}

}  // namespace aleph
