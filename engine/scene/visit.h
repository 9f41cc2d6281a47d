#pragma once
// Visits the lists of a scene, and every track: to find what is animated, and over which span of time.

#include <algorithm>

#include "engine/scene/operations.h"
#include "engine/scene/scene.h"

namespace aleph {

/// Calls visit(kind, list...) with the scenes' lists of each kind of element.
template <class Visit, class... Scenes>
void for_each_list(const Visit& visit, Scenes&... scenes) {
    visit("node", scenes.nodes...);
    visit("mesh", scenes.meshes...);
    visit("points", scenes.point_caches...);
    visit("skin", scenes.skins...);
    visit("cage", scenes.cages...);
    visit("material", scenes.materials...);
    visit("image", scenes.images...);
    visit("light", scenes.lights...);
    visit("camera", scenes.cameras...);
}

/// Calls visit(track or operation stack) for what pose() reads of a transform.
template <class Visit>
void visit_tracks(const LocalTransform& local, const Visit& visit) {
    if (local.operations) {
        visit(*local.operations);
    } else if (local.matrix) {
        visit(*local.matrix);
    } else {
        visit(local.translation);
        visit(local.scale);
        if (local.axis_rotation)
            visit(local.axis_rotation->angle);
        else
            visit(local.rotation);
    }
}

template <class Visit>
void visit_tracks(const Node& node, const Visit& visit) {
    visit(node.visible);
    visit(node.inherits);
    visit_tracks(node.transform, visit);
}

template <class Visit>
void visit_tracks(const Material& m, const Visit& visit) {
    const auto& [metallic, roughness, specular, specular_color, ior] = m.gloss;
    const auto& [transmission, thickness, attenuation_distance, attenuation_color] = m.glass;
    const auto& [clearcoat, clearcoat_roughness, sheen_color, sheen_roughness, anisotropy, anisotropy_rotation] =
        m.layers;
    for (const auto* track : {&m.base_color, &m.glow.color, &specular_color, &attenuation_color, &sheen_color})
        visit(*track);
    for (const auto* track :
         {&m.opacity.alpha, &metallic, &roughness, &m.glow.strength, &specular, &ior, &transmission, &thickness,
          &attenuation_distance, &clearcoat, &clearcoat_roughness, &sheen_roughness, &anisotropy, &anisotropy_rotation})
        visit(*track);
}

/// The environment's radiance, and the rotation of its picture.
template <class Visit>
void visit_tracks(const Environment& environment, const Visit& visit) {
    if (environment.radiance) visit(*environment.radiance);
    if (environment.axis_rotation)
        visit(environment.axis_rotation->angle);
    else
        visit(environment.rotation);
}

template <class Visit>
void visit_tracks(const Light& light, const Visit& visit) {
    visit(light.color);
    for (const auto* track : {&light.intensity, &light.range, &light.inner_cone, &light.outer_cone}) visit(*track);
}

template <class Visit>
void visit_tracks(const Camera& camera, const Visit& visit) {
    for (const auto* track :
         {&camera.fov, &camera.half_height, &camera.shift_x, &camera.shift_y, &camera.aperture, &camera.focus_distance})
        visit(*track);
}

/// Tracks of a mesh; its point cache, normal samples and cage are not tracks.
template <class Visit>
void visit_tracks(const Mesh& mesh, const Visit& visit) {
    visit(mesh.present);
    for (const Track<double>& weight : mesh.deformation.target_weights) visit(weight);
}

/// The tracks of all elements and of the environment.
template <class Visit>
void visit_tracks(const Scene& scene, const Visit& visit) {
    const auto visit_all = [&](const auto&... lists) {
        (std::ranges::for_each(lists, [&](const auto& element) { visit_tracks(element, visit); }), ...);
    };
    visit_all(scene.nodes, scene.meshes, scene.materials, scene.lights, scene.cameras);
    visit_tracks(scene.environment, visit);
}

template <class Element>
bool has_animated_tracks(const Element& element) {
    bool animated = false;
    visit_tracks(element, [&](const auto& property) { animated = animated || is_animated(property); });
    return animated;
}

}  // namespace aleph
