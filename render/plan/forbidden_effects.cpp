#include "render/plan/forbidden_effects.h"

#include <algorithm>

namespace aleph {

namespace {

bool is_normal_map(TextureRef Material::*texture) {
    return texture == &Material::normal_texture || texture == &Material::clearcoat_normal_texture;
}

void simplify_material(const EffectSet& forbidden, Material& material) {
    for (const MaterialTexture& texture : material_textures) {
        const Effect effect = is_normal_map(texture.member) ? Effect::normal_maps : Effect::textures;
        if (forbidden.contains(effect)) material.*texture.member = {};
    }
    if (forbidden.contains(Effect::alpha)) material.alpha_mode = Material::AlphaMode::opaque;
    if (forbidden.contains(Effect::emission)) material.emission = glm::dvec3(0.0);
}

/// Point caches hold their first sample from then on. Skinned meshes stand as they were modelled.
void stop_deformation(Scene& scene) {
    for (Mesh& mesh : scene.meshes) {
        mesh.targets.clear();
        mesh.target_weights.clear();
        mesh.skin = no_index;
        mesh.joint_weights.clear();
        mesh.joints_per_vertex = 0;
        if (mesh.normal_samples.size() > 1) {
            mesh.normal_samples.resize(1);
            mesh.normal_sampling = {};
        }
    }
    for (PointCache& cache : scene.point_caches) {
        cache.positions.resize(std::min<std::size_t>(cache.positions.size(), 1));
        cache.velocities.clear();
        cache.sampling = {};
    }
}

}  // namespace

void remove_forbidden(const EffectSet& forbidden, Scene& scene) {
    for (Material& material : scene.materials) simplify_material(forbidden, material);
    if (forbidden.contains(Effect::environment)) {
        scene.environment.reset();
        scene.environment_image = no_index;
    }
    if (forbidden.contains(Effect::deformation)) stop_deformation(scene);
}

RenderSettings without_forbidden(RenderSettings settings) {
    const EffectSet& forbidden = settings.forbid;
    if (forbidden.contains(Effect::indirect_diffuse)) settings.bounces = 0;
    if (forbidden.contains(Effect::more_bounces)) settings.bounces = std::min(settings.bounces, 1);
    if (forbidden.contains(Effect::subdivision)) settings.subdivision_level = 0;
    if (forbidden.contains(Effect::cache_carry_over)) settings.light_step = 0;
    const bool salient = settings.perception.guide == Guide::saliency;
    if (forbidden.contains(Effect::saliency) && salient) settings.perception.guide = Guide::full;
    return settings;
}

}  // namespace aleph
