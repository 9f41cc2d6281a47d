#pragma once
// A scene with one of everything, to make faulty.

#include "engine/surface/shapes.h"

namespace aleph {

/// One of everything that can refer to something else.
inline Scene make_full_scene() {
    Scene scene;
    Shape quad;
    scene.materials.resize(1);
    scene.images.resize(1);
    scene.images[0].floats = Image<glm::vec4>(2, 1);
    scene.meshes = {make_shape_mesh(quad, 0, "rigid"), make_shape_mesh(quad, 0, "skinned"),
                    make_shape_mesh(quad, 0, "cached")};
    Mesh& skinned = scene.meshes[1];
    skinned.deformation.skin = 0;
    skinned.deformation.joints_per_vertex = 1;
    skinned.deformation.joint_weights.resize(skinned.positions.size(), {0, 1.0f});
    skinned.deformation.targets.resize(1);
    skinned.deformation.targets[0].positions.resize(skinned.positions.size());
    skinned.deformation.target_weights = {Track<double>(0.5)};
    scene.meshes[2].deformation.points = 0;
    scene.point_caches.resize(1);
    scene.point_caches[0].positions = {scene.meshes[2].positions, scene.meshes[2].positions};
    scene.skins.resize(1);
    scene.skins[0].joints = {0};
    scene.skins[0].inverse_binds = {glm::dmat4(1.0)};
    scene.lights.resize(1);
    scene.cameras.resize(1);
    scene.nodes.resize(2);
    scene.nodes[0].name = "ball";
    scene.nodes[0].meshes = {0, 1, 2};
    scene.nodes[0].light = 0;
    scene.nodes[1].name = "eye";
    scene.nodes[1].parent = 0;
    scene.nodes[1].camera = 0;
    scene.environment.radiance = glm::dvec3(1.0);
    scene.environment.image = 0;
    return scene;
}

}  // namespace aleph
