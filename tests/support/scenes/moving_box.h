#pragma once
// A box that moves across a floor, seen by one camera or two.

#include <array>

#include "tests/support/scenes/render_scenes.h"

namespace aleph {

/// A lamp over a floor, and a box that moves across it.
inline Scene make_moving_scene() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_quad(8.0, 8.0, grey), glm::dvec3(0.0), z_to_up);
    add_mesh(scene, make_box(glm::dvec3(0.6), grey));
    scene.nodes[1].transform.translation.values = {{-1.0, 0.5, 0.0}, {1.0, 0.5, 0.0}};
    add_lamp(scene, 1.0, glm::dvec3(10.0), {0.0, 3.0, 0.0});
    scene.cameras.emplace_back();
    scene.nodes.push_back({.transform = {.translation = glm::dvec3(0.0, 1.0, 5.0)}, .camera = 0});
    for (int i = 0; i < 4; ++i) scene.nodes[i].name = std::array{"floor", "box", "lamp", "eye"}[i];
    return scene;
}

/// make_moving_scene with a second camera, from frame 10 on.
inline Scene make_scene_with_two_cameras() {
    Scene scene = make_moving_scene();
    scene.cameras.emplace_back().fov = 0.4;
    Node close;
    close.name = "close";
    close.camera = 1;
    close.transform.translation.values = {{0.5, 1.0, 3.0}, {0.0, 1.0, 3.0}};
    scene.nodes.push_back(close);
    scene.film.range = FrameRange{0, 30};
    scene.film.camera_keys = {{0, "eye"}, {4, "eye"}, {10, "close"}};
    return scene;
}

}  // namespace aleph
