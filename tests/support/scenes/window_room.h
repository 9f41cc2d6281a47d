#pragma once
// A room that gets light of the sky through a window.

#include "render/light/find_sky_openings.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {

inline constexpr double wall = 0.1;  // m, thick

/// A room of 4 x 3 x 4 m with a window in the middle of its right wall, under a sky of 1 cd/m2.
/// @param half  m, half the window's width and height
inline Scene make_room_with_window(const glm::dvec2& half = glm::dvec2(0.5)) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    const auto add = [&](const glm::dvec3& low, const glm::dvec3& high) {
        add_mesh(scene, make_box(high - low, grey), 0.5 * (low + high));
    };
    add({-2.0, -wall, -2.0}, {2.0, 0.0, 2.0});
    add({-2.0, 3.0, -2.0}, {2.0, 3.0 + wall, 2.0});
    add({-2.0 - wall, -wall, -2.0}, {-2.0, 3.0 + wall, 2.0});
    add({-2.0 - wall, -wall, -2.0 - wall}, {2.0 + wall, 3.0 + wall, -2.0});
    add({-2.0 - wall, -wall, 2.0}, {2.0 + wall, 3.0 + wall, 2.0 + wall});
    add({2.0, -wall, -2.0}, {2.0 + wall, 1.5 - half.y, 2.0});
    add({2.0, 1.5 + half.y, -2.0}, {2.0 + wall, 3.0 + wall, 2.0});
    add({2.0, 1.5 - half.y, -2.0}, {2.0 + wall, 1.5 + half.y, -half.x});
    add({2.0, 1.5 - half.y, half.x}, {2.0 + wall, 1.5 + half.y, 2.0});
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    add_camera(scene, {-1.5, 1.8, 1.5}, {-0.6, 1.0, -1.5}, 1.0);
    return scene;
}

/// The room with a blind of 1.2 x 1.2 m in its window.
inline Scene make_room_with_blind(const Track<glm::dvec3>& place) {
    Scene scene = make_room_with_window();
    const int blind = add_mesh(scene, make_box({0.02, 1.2, 1.2}, 0));
    scene.nodes[blind].transform.translation = place;
    return scene;
}

/// In the wall, beside the middle of the window it by so much. m
inline glm::dvec3 place_blind(double beside) {
    return {2.0 + 0.5 * wall, 1.5, beside};
}

inline std::optional<SkyOpenings> find_openings(const Stage& stage) {
    RayCounts counts;
    return find_sky_openings(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), counts);
}

}  // namespace aleph
