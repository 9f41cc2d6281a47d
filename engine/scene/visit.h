#pragma once
// Visits every track of a scene: to find what is animated, and over which span of time.

#include "engine/scene/scene.h"

namespace aleph {

/// Calls visit(track or operation stack) for what pose() reads of a node: its transform and visibility.
template <class Visit>
void visit_tracks(const Node& node, const Visit& visit) {
    visit(node.visible);
    visit(node.inherits);
    if (node.operations) {
        visit(*node.operations);
    } else if (node.matrix) {
        visit(*node.matrix);
    } else {
        visit(node.translation);
        visit(node.scale);
        if (node.axis_rotation)
            visit(node.axis_rotation->angle);
        else
            visit(node.rotation);
    }
}

template <class Visit>
void visit_tracks(const Material& m, const Visit& visit) {
    for (const auto* track : {&m.base_color, &m.emission, &m.specular_color, &m.attenuation_color, &m.sheen_color})
        visit(*track);
    for (const auto* track : {&m.alpha, &m.metallic, &m.roughness, &m.emission_strength, &m.specular, &m.ior,
                              &m.transmission, &m.thickness, &m.attenuation_distance, &m.clearcoat,
                              &m.clearcoat_roughness, &m.sheen_roughness, &m.anisotropy, &m.anisotropy_rotation})
        visit(*track);
}

/// The environment's radiance, and the rotation of its picture.
template <class Visit>
void visit_environment(const Scene& scene, const Visit& visit) {
    if (scene.environment) visit(*scene.environment);
    if (scene.environment_axis_rotation)
        visit(scene.environment_axis_rotation->angle);
    else
        visit(scene.environment_rotation);
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
    for (const Track<double>& weight : mesh.target_weights) visit(weight);
}

}  // namespace aleph
