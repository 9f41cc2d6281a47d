#pragma once
// Small moving scenes made in code, and hits on them made by hand, for the tests of motion.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>
#include <utility>

#include "engine/pose/posed_view.h"
#include "engine/scene/scene.h"
#include "tests/support/model_motion.h"
#include "tests/support/scenes/deforming_scenes.h"

namespace aleph {

inline constexpr double degrees = std::numbers::pi / 180.0;

/// Linear from one value to the other between two times, held outside.
template <class T>
Track<T> ramp(const T& from, const T& to, double begin = 0.0, double end = 1.0) {
    return Track<T>({begin, end}, {from, to});
}

inline int add_node(Scene& scene, Node node) {
    scene.nodes.push_back(std::move(node));
    return static_cast<int>(scene.nodes.size()) - 1;
}

/// A camera of this vertical field of view under a parent, at its origin.
inline int add_camera(Scene& scene, int parent = no_index, double fov = std::numbers::pi / 4.0) {
    Camera camera{.fov = fov};
    scene.cameras.push_back(camera);
    Node node{.name = "camera", .parent = parent, .camera = static_cast<int>(scene.cameras.size()) - 1};
    return add_node(scene, node);
}

/// One triangle a metre below the origin that reaches from behind a camera there to the horizon.
inline int add_endless_floor(Scene& scene) {
    Mesh mesh;
    mesh.positions = {{-1e7f, -1.0f, 1e7f}, {1e7f, -1.0f, 1e7f}, {0.0f, -1.0f, -1e7f}};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    return add_node(scene, Node{.meshes = {static_cast<int>(scene.meshes.size()) - 1}});
}

/// Random triangles within a box around the origin.
inline int add_triangle_soup(Scene& scene, int triangles, float half_size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> inside(-half_size, half_size);
    Mesh mesh;
    for (unsigned i = 0; i < static_cast<unsigned>(triangles); ++i) {
        for (int corner = 0; corner < 3; ++corner) {
            const float x = inside(random), y = inside(random), z = inside(random);
            mesh.positions.emplace_back(x, y, z);
        }
        mesh.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    scene.meshes.push_back(mesh);
    return static_cast<int>(scene.meshes.size()) - 1;
}

/// A rectangle in the xy plane, facing +z, of this many cells each way.
inline int add_grid(Scene& scene, float width, float height, unsigned cells = 1) {
    Mesh mesh = make_sheet(cells);
    for (glm::vec3& p : mesh.positions) p *= glm::vec3(0.5f * width, 0.5f * height, 1.0f);
    scene.meshes.push_back(mesh);
    return static_cast<int>(scene.meshes.size()) - 1;
}

/// A single triangle whose first corner is the point: a hit with u = v = 0 is exactly there.
inline int add_point(Scene& scene, const glm::vec3& point) {
    Mesh mesh;
    mesh.positions = {point, point + glm::vec3(1.0f, 0.0f, 0.0f), point + glm::vec3(0.0f, 1.0f, 0.0f)};
    mesh.triangles = {{0, 1, 2}};
    scene.meshes.push_back(mesh);
    return static_cast<int>(scene.meshes.size()) - 1;
}

/// A scene at two times, seen by its first camera.
struct TwoViews {
    PosedView now, other;

    TwoViews(const Scene& scene, double seconds, double other_seconds, int width, int height)
        : now(make_posed_view(scene, seconds, 0, width, height)),
          other(make_posed_view(scene, other_seconds, 0, width, height)) {}
};

/// Motion of these hits between two times.
inline MotionField motion_between(const Scene& scene, double now, double other, const Image<Hit>& hits,
                                  OtherFrame which = OtherFrame::next) {
    const TwoViews views(scene, now, other, hits.width, hits.height);
    return compute_model_motion(scene, views.now, views.other, hits, which);
}

inline void expect_same_field(const MotionField& a, const MotionField& b) {
    EXPECT_EQ(a.displacement, b.displacement);
    EXPECT_EQ(a.path_length, b.path_length);
    EXPECT_EQ(a.validity, b.validity);
}

/// A hit on the first corner of the first triangle, in an image otherwise empty.
inline Image<Hit> one_hit(int width, int height, int x, int y) {
    Image<Hit> hits(width, height);
    hits(x, y) = {.instance = 0, .primitive = 0};
    return hits;
}

/// Hits spread over the scene's surfaces, visible or not: motion is exact for any (primitive, u, v).
inline Image<Hit> make_random_hits(const Scene& scene, const ScenePose& frame, int width, int height) {
    std::mt19937 random(11);
    std::uniform_real_distribution<float> fraction(0.0f, 1.0f);
    Image<Hit> hits(width, height);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        Hit& hit = hits.pixels[i];
        hit.instance = static_cast<int>(i % frame.instances.size());
        const Mesh& mesh = scene.meshes[frame.instances[hit.instance].mesh];
        hit.primitive = static_cast<int>(random() % mesh.triangles.size());
        hit.u = fraction(random);
        hit.v = fraction(random) * (1.0f - hit.u);
        hit.distance = 1.0f;
    }
    return hits;
}

struct PointMotion {
    glm::dvec2 displacement{0.0};
    double path_length = 0.0;
    MotionValidity validity = MotionValidity::valid;
};

/// Vertical field of view that gives this focal length in pixels.
inline double fov_of(double focal_length, int height) {
    return 2.0 * std::atan(0.5 * height / focal_length);
}

/// One point before a camera of 1000 px focal length, 1000x1000. Node 0 holds the point, node 1 the camera.
inline Scene make_point_scene(const glm::vec3& point, double focal_length = 1000.0) {
    Scene scene;
    Node node{.meshes = {add_point(scene, point)}};
    add_node(scene, node);
    add_camera(scene, no_index, fov_of(focal_length, 1000));
    return scene;
}
inline PointMotion motion_of_point(const Scene& scene, double now = 0.0, double other = 1.0,
                                   OtherFrame which = OtherFrame::next) {
    const MotionField field = motion_between(scene, now, other, one_hit(1000, 1000, 500, 500), which);
    return {field.displacement(500, 500), field.path_length(500, 500), field.validity(500, 500)};
}

}  // namespace aleph
