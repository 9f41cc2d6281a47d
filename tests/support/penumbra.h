#pragma once
// The penumbra of a square lamp behind a straight edge, in closed form.

#include <algorithm>

#include "tests/support/numbers.h"
#include "tests/support/scenes/render_scenes.h"

namespace aleph {

/// Share of a point's hemisphere that a parallel rectangle takes, one corner straight above it (Howell's catalogue,
/// B-4). Negative where one side is.
inline double corner_factor(double width, double depth, double height) {
    const double x = width / height, y = depth / height, a = std::sqrt(1.0 + x * x), b = std::sqrt(1.0 + y * y);
    return (x / a * std::atan(y / a) + y / b * std::atan(x / b)) / (2.0 * pi);
}

struct Penumbra {
    static constexpr double height = 2.0, edge = 1.0;  ///< of the lamp and of the edge above the floor, m
    static constexpr double half = 0.4;                ///< of the lamp's side, m
    static constexpr double radiance = 10.0, albedo = 0.6;

    /// The lamp, and a half-plane over x < 0 that hides what lies beyond -x of it. Without the floor at y = 0.
    static Scene make_scene() {
        Scene scene;
        add_lamp(scene, 2.0 * half, glm::dvec3(radiance), {0.0, height, 0.0});
        add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true)),
                 {-10.0, edge, 0.0}, z_to_up);
        return scene;
    }

    /// Radiance of the floor.
    static double at(double x, double z) {
        const double first = std::clamp(x * (1.0 - height / edge), -half, half);  // the first visible point of the lamp
        const auto factor = [&](double to) {
            return corner_factor(to - x, half - z, height) + corner_factor(to - x, half + z, height);
        };
        return albedo * radiance * (factor(half) - factor(first));
    }
};

}  // namespace aleph
