// Effects of objects: gloss, mirrors and glass; what materials take from textures, masks and their own light; shapes.

#include <algorithm>

#include "render/plan/effect_bounds.h"
#include "render/plan/effect_table.h"

namespace aleph {

namespace {

/// Radiance that pixels can have from lobes that have a width.
double bound_glossy_light(const FrameFacts& facts, int bounces) {
    const double met = largest_radiance(facts, bounces);
    double largest = 0.0;
    for (const ObjectFacts& object : facts.objects) {
        if (!object.material.glossy) continue;
        largest = std::max(largest, object.material.reflectance * met + largest_highlight(facts, object));
    }
    return largest > 0.0 ? largest * (1.0 + bounces) : 0.0;
}

Finding find_gloss(Planning& frame) {
    if (!frame.in.facts.any(&MaterialFacts::glossy)) return skip("no material in use is glossy");
    if (!frame.any_seen(&MaterialFacts::glossy)) return skip("no glossy surface can be seen");
    return simulate_if_visible(frame, bound_glossy_light(frame.in.facts, frame.settings.light.bounces),
                               "glossy surfaces reflect light", "there is no light that glossy surfaces reflect");
}

Finding find_mirrors(Planning& frame) {
    if (!frame.in.facts.any(&MaterialFacts::mirror)) return skip("no material in use is a mirror");
    return simulate_if(frame.any_seen(&MaterialFacts::mirror), "a smooth surface may be seen", "no mirror can be seen");
}

Finding find_glass(Planning& frame) {
    if (!frame.in.facts.any(&MaterialFacts::glass)) return skip("no material in use is glass");
    return simulate_if(frame.any_seen(&MaterialFacts::glass), "glass may be seen", "no glass can be seen");
}

template <bool MaterialFacts::*layer>
bool has(const MaterialFacts& material, const FrameFacts&) {
    return material.*layer;
}

Finding find_emission(Planning& frame) {
    const auto shines = [](const MaterialFacts& m) { return m.radiance > 0.0f; };
    return simulate_if(frame.in.facts.any(shines), "surfaces shine", "no surface shines");
}

void remove_emission(Scene& scene) {
    for (Material& material : scene.materials) material.glow.color = glm::dvec3(0.0);
}

Finding find_textures(Planning& frame) {
    return simulate_if(frame.in.facts.any(&MaterialFacts::textured), "materials in use have textures",
                       "no material in use has a texture");
}

Finding find_normal_maps(Planning& frame) {
    return simulate_if(frame.in.facts.any(&MaterialFacts::maps_normals), "materials in use have normal maps",
                       "no material in use has a normal map");
}

template <bool normal_maps>
void remove_textures(Scene& scene) {
    for (Material& material : scene.materials) {
        for (const auto& [key, slot] : material_textures) {
            if (is_normal_map(slot) == normal_maps) material.textures[slot] = {};
        }
    }
}

Finding find_alpha(Planning& frame) {
    return simulate_if(frame.in.facts.any(&MaterialFacts::alpha), "masks or blended materials are in use",
                       "no mask and no blended material is in use");
}

void make_opaque(Scene& scene) {
    for (Material& material : scene.materials) material.opacity.mode = Opacity::Mode::opaque;
}

Finding find_subdivision(Planning& frame) {
    const Scene& scene = frame.scene;
    int most = no_index;  // level of the cages
    for (const ObjectFacts& object : frame.in.facts.objects) {
        const int cage = scene.meshes[object.mesh].subdivision.cage;
        if (cage != no_index) most = std::max(most, scene.cages[cage].level);
    }
    if (most == no_index) return skip("there is no subdivision cage");
    if (most <= 0) return leave_to_user(frame, "every cage is drawn at level 0", unbounded);
    return simulate("subdivision cages are drawn");
}

void stop_subdivision(RenderSettings& settings) {
    settings.picture.subdivision_level = 0;
}

Finding find_deformation(Planning& frame) {
    return simulate_if(std::ranges::any_of(frame.in.facts.objects, &ObjectFacts::deforms), "meshes deform",
                       "no mesh deforms");
}

/// Point caches hold their first sample from then on. Skinned meshes stand as they were modelled.
void stop_deformation(Scene& scene) {
    for (Mesh& mesh : scene.meshes) {
        mesh.deformation.targets.clear();
        mesh.deformation.target_weights.clear();
        mesh.deformation.skin = no_index;
        mesh.deformation.joint_weights.clear();
        mesh.deformation.joints_per_vertex = 0;
        if (mesh.deformation.normal_samples.size() > 1) {
            mesh.deformation.normal_samples.resize(1);
            mesh.deformation.normal_sampling = {};
        }
    }
    for (PointCache& cache : scene.point_caches) {
        cache.positions.resize(std::min<std::size_t>(cache.positions.size(), 1));
        cache.sampling = {};
    }
}

constexpr Rgb pink{1.0f, 0.0f, 0.8f};

}  // namespace

EffectTable object_effects() {
    return {
        {describe(Effect::glossy_reflection), find_gloss, pink, has<&MaterialFacts::glossy>},
        {describe(Effect::mirror_reflection), find_mirrors, violet, has<&MaterialFacts::mirror>},
        {describe(Effect::refraction), find_glass, violet, has<&MaterialFacts::glass>},
        {.effect = describe(Effect::emission), .find = find_emission, .remove = remove_emission},
        {.effect = describe(Effect::textures), .find = find_textures, .remove = remove_textures<false>},
        {.effect = describe(Effect::normal_maps), .find = find_normal_maps, .remove = remove_textures<true>},
        {.effect = describe(Effect::alpha), .find = find_alpha, .remove = make_opaque},
        {.effect = describe(Effect::subdivision), .find = find_subdivision, .turn_off = stop_subdivision},
        {.effect = describe(Effect::deformation), .find = find_deformation, .remove = stop_deformation},
    };
}

}  // namespace aleph
