#pragma once
// A room with boxes and lamps that cast shadows, for the tests of gathers.

#include "tests/support/render_scenes.h"

namespace aleph {

/// 4 x 3 x 5 m about the origin; all surfaces are Lambert.
inline Scene make_cluttered_room() {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int dark = add_lambert(scene, glm::dvec3(0.05), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(20.0));
    add_mesh(scene, make_box({4.0, 3.0, 5.0}, grey));
    for (int i = 0; i < 32; ++i) {
        const double turn = 2.4 * i, across = 0.6 + 0.035 * i;
        add_mesh(scene, make_box({0.15, 0.3 + 0.02 * i, 0.2}, i % 2 == 0 ? dark : grey),
                 {across * std::cos(turn), -1.2 + 0.08 * i, across * std::sin(turn)},
                 glm::angleAxis(turn, glm::dvec3(0.0, 1.0, 0.0)));
    }
    for (const double x : {-1.2, 0.0, 1.2}) {
        for (const double z : {-1.5, 1.5}) add_mesh(scene, make_quad(0.2, 0.2, lamp), {x, 1.4, z}, z_to_down);
    }
    return scene;
}

}  // namespace aleph
