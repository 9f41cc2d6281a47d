#pragma once
// A scene of several instances, and random rays into it.

#include <cmath>
#include <limits>
#include <random>

#include "engine/rays/hit.h"
#include "tests/support/numbers.h"
#include "tests/support/render_scenes.h"

namespace aleph {

/// Several instances, two of one mesh, some turned and scaled.
inline Scene make_many() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_faceted_sphere(1.0, 24, white), {0.0, 0.0, -5.0});
    add_mesh(scene, make_box({1.0, 2.0, 1.0}, white), {2.0, 0.0, -6.0}, glm::angleAxis(0.5, glm::dvec3(0.0, 1.0, 0.0)));
    const int squashed = add_node(scene, {-2.0, 0.5, -5.0}, glm::angleAxis(1.0, glm::dvec3(0.0, 0.0, 1.0)));
    scene.nodes[squashed].meshes = {0};
    scene.nodes[squashed].transform.scale = glm::dvec3(-0.5, 1.0, 0.3);
    add_mesh(scene, make_quad(20.0, 20.0, white), {0.0, -2.0, 0.0}, z_to_up);
    return scene;
}

class RandomRays {
  public:
    float uniform(float low, float high) { return std::uniform_real_distribution<float>(low, high)(engine_); }
    glm::vec3 in_cube(float half) { return {uniform(-half, half), uniform(-half, half), uniform(-half, half)}; }
    Ray next() {
        return {in_cube(8.0f) - glm::vec3(0.0f, 0.0f, 5.0f), in_cube(1.0f), 0.0f,
                uniform(0.0f, 1.0f) < 0.5f ? float_infinity : 5.0f};
    }
    /// A number such as a broken computation gives.
    float special() {
        const float values[] = {0.0f,
                                -0.0f,
                                1e-45f,
                                -1e-39f,
                                1.0f,
                                -1.0f,
                                9.9e8f,
                                1.843e18f,
                                1.85e18f,
                                -3.4e38f,
                                3.4e38f,
                                float_infinity,
                                -float_infinity,
                                float_nan,
                                uniform(-9.0f, 9.0f),
                                uniform(-9.0f, 9.0f)};
        return values[std::uniform_int_distribution<std::size_t>(0, 15)(engine_)];
    }

  private:
    std::mt19937 engine_{11};
};

}  // namespace aleph
