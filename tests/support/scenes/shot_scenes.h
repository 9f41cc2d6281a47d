#pragma once
// Small animated scenes for the tests of light at lighting keyframes. A lamp without area has no noise of its own.

#include "render/frame/sequence.h"
#include "tests/support/quick_settings.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {

constexpr int shot_frames = 21;

/// A floor, a back wall and a coloured wall under a lamp; frames 0 to 20.
inline Scene make_shot() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.7)), red = add_lambert(scene, {0.7, 0.2, 0.1});
    add_mesh(scene, make_quad(6.0, 6.0, white), glm::dvec3(0.0), z_to_up);
    add_mesh(scene, make_quad(6.0, 3.0, white), {0.0, 1.5, -3.0});
    add_mesh(scene, make_quad(6.0, 3.0, red), {-3.0, 1.5, 0.0}, turn_about_y(std::numbers::pi / 2));
    add_light(scene, Light::Kind::point, glm::dvec3(8.0), {-1.0, 2.5, -1.0});
    add_camera(scene, {0.5, 1.5, 4.0}, {-0.5, 1.0, -2.0});
    scene.film.range = FrameRange{0, shot_frames - 1};
    return scene;
}

/// One second of the way from a place to another, at 30 frames a second.
inline Track<glm::dvec3> move_between(const glm::dvec3& from, const glm::dvec3& to) {
    Track<glm::dvec3> track;
    track.values = {from, to};
    return track;
}

/// make_shot with a small box that moves in the far corner.
inline Scene make_shot_with_mover() {
    Scene scene = make_shot();
    const int node = add_mesh(scene, make_box(glm::dvec3(0.3), 0));
    scene.nodes[node].transform.translation = move_between({1.6, 0.15, -2.6}, {2.2, 0.15, -2.6});
    return scene;
}

/// make_shot with a camera that moves to the side.
inline Scene make_shot_with_moving_camera() {
    Scene scene = make_shot();
    scene.nodes.back().transform.translation = move_between({0.5, 1.5, 4.0}, {1.5, 1.5, 4.0});
    return scene;
}

inline RenderSettings shot_settings(int light_step) {
    RenderSettings settings = quick_settings(48, 36);
    settings.perception.guide = Guide::none;
    settings.cache.accuracy = 0.2;
    settings.cache.light_step = light_step;
    return settings;
}

}  // namespace aleph
