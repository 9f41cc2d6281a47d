// Reprojection with real rays: single-precision hits must not disturb motion, and points hidden in the other frame are
// found.

#include "engine/surface/shapes.h"
#include "motion/reprojection.h"
#include "tests/support/motion_scenes.h"
#include "tests/support/motion_truth.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ReprojectionRays, RP01_StaticSceneMovesByExactlyZero) {
    for (const double tilt : {45.0, 10.0, 1.0, 0.1}) {
        Scene scene;
        Node plane{.transform = {.translation = glm::dvec3(0.0, -1.0, -3.0),
                                 .axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, (tilt - 90.0) * degrees}},
                   .meshes = {add_grid(scene, 1000.0f, 1000.0f, 8)}};
        add_node(scene, plane);
        Node mount{.transform = {.translation = glm::dvec3(0.1, 0.7, -0.3),
                                 .axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.03}}};
        add_camera(scene, add_node(scene, mount));
        const auto [now, other, hits, field] = SeenMotion(scene, 0.0, 1.0 / 30.0, 320, 240);
        std::size_t surface = 0;
        for (std::size_t i = 0; i < hits.size(); ++i) {
            ASSERT_EQ(field.displacement.pixels[i], glm::dvec2(0.0)) << tilt;
            ASSERT_EQ(field.path_length.pixels[i], 0.0) << tilt;
            if (hits.pixels[i].instance == no_index) continue;
            ++surface;
            ASSERT_EQ(field.validity.pixels[i], MotionValidity::valid) << tilt;
        }
        EXPECT_GT(surface, hits.size() / 10) << tilt;
    }
}

TEST(ReprojectionRays, RP18_BarycentricsOffTheTriangleArePutBack) {
    Scene scene;
    add_point(scene, {1.0f, 2.0f, 3.0f});  // corners p, p + x, p + y
    const struct {
        float u, v;
        glm::dvec2 expected;
    } cases[] = {{0.25f, 0.5f, {0.25, 0.5}},
                 {1.0f, 0.0f, {1.0, 0.0}},
                 {0.0f, 1.0f, {0.0, 1.0}},
                 {1.0000001f, 0.0f, {1, 0}},
                 {-1e-7f, 0.5f, {0.0, 0.5}},
                 {0.5f, -1e-7f, {0.5, 0.0}},
                 {0.75f, 0.75f, {0.5, 0.5}},
                 {0.50000006f, 0.5f, {0.5, 0.5}},
                 {float_nan, 0.5f, {0.0, 0.5}},
                 {0.5f, float_nan, {0.5, 0.0}},
                 {float_infinity, 0.0f, {1.0, 0.0}},
                 {-float_infinity, -float_infinity, {0.0, 0.0}},
                 {float_infinity, float_infinity, {0.5, 0.5}},
                 {-0.0f, 1e-45f, {0.0, 0.0}}};
    for (const auto& c : cases) {
        const glm::dvec3 point = surface_point(scene.meshes[0], {.instance = 0, .primitive = 0, .u = c.u, .v = c.v});
        EXPECT_NEAR(point.x, 1.0 + c.expected.x, 1e-7) << c.u << ' ' << c.v;
        EXPECT_NEAR(point.y, 2.0 + c.expected.y, 1e-7) << c.u << ' ' << c.v;
        EXPECT_EQ(point.z, 3.0);
        EXPECT_LE((point.x - 1.0) + (point.y - 2.0), 1.0 + 1e-15);
        EXPECT_GE(std::min(point.x - 1.0, point.y - 2.0), 0.0);
    }
}

TEST(ReprojectionRays, RP18_HitsOnSubPixelTrianglesLieAtTheirPixel) {
    // Triangles 1e-3 px across, upright and grazing, around the centre of pixel (70, 40).
    for (const double tilt : {0.0, 80.0, 89.0}) {
        Scene scene;
        const double metres_per_pixel = 5.0 / 1000.0;
        Node node;
        node.meshes = {add_grid(scene, static_cast<float>(0.04 * metres_per_pixel),
                                static_cast<float>(0.04 * metres_per_pixel / std::cos(tilt * degrees)), 40)};
        node.transform.translation =
            glm::dvec3((70.5 - 50.0) * metres_per_pixel, (50.0 - 40.5) * metres_per_pixel, -5.0);
        node.transform.axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, -tilt * degrees};
        add_node(scene, node);
        add_camera(scene, no_index, fov_of(1000.0, 100));
        const PosedView posed = make_posed_view(scene, 0.0, 0, 100, 100);
        const Image<Hit> hits = cast_first_hits(scene, posed);
        ASSERT_EQ(hits(70, 40).instance, 0) << tilt;
        const CameraFromObject map = make_camera_from_object(posed.view, posed.pose.world[0]);
        const glm::dvec2 pixel = project_camera_point(posed.view, map(surface_point(scene.meshes[0], hits(70, 40))));
        EXPECT_NEAR(pixel.x, 70.5, 1e-4) << tilt;
        EXPECT_NEAR(pixel.y, 40.5, 1e-4) << tilt;
    }
}

TEST(ReprojectionRays, RP19_BarycentricPointsLieOnTheirTriangles) {
    // Long slivers at 500 m whose planes are almost parallel to the ray: the distance along it is inaccurate.
    Scene scene;
    Mesh slivers;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> uniform(-1.0f, 1.0f);
    for (unsigned i = 0; i < 30000; ++i) {
        const glm::vec3 start(40.0f * uniform(random), 30.0f * uniform(random), -500.0f + 50.0f * uniform(random));
        // Towards the camera, nearly.
        const glm::vec3 length = -0.2f * start + 0.02f * glm::vec3(uniform(random), uniform(random), 0.0f);
        const glm::vec3 breadth = -0.1f * start + glm::vec3(uniform(random), uniform(random), 0.0f);
        slivers.positions.push_back(start);
        slivers.positions.push_back(start + length);
        slivers.positions.push_back(start + breadth);
        slivers.triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    }
    scene.meshes = {slivers};
    Node node{.meshes = {0}};
    add_node(scene, node);
    add_camera(scene, no_index, 0.12);
    const PosedView posed = make_posed_view(scene, 0.0, 0, 320, 240);
    const Image<Hit> hits = cast_first_hits(scene, posed);
    Real worst = 0, worst_by_distance = 0;
    std::size_t count = 0;
    for (int y = 0; y < hits.height; ++y) {
        for (int x = 0; x < hits.width; ++x) {
            const Hit& hit = hits(x, y);
            if (hit.instance == no_index) continue;
            ++count;
            const glm::uvec3& triangle = slivers.triangles[hit.primitive];
            const RealVector p0(slivers.positions[triangle.x]), p1(slivers.positions[triangle.y]),
                p2(slivers.positions[triangle.z]);
            const RealVector normal = unit(glm::cross(p1 - p0, p2 - p0));
            const RealVector point(surface_point(slivers, hit));
            worst = std::max(worst,
                             std::abs(glm::dot(point - p0, normal)) / (glm::distance(p0, p1) + glm::distance(p0, p2)));
            const CameraRay ray = make_camera_ray(posed.view, x + 0.5, y + 0.5);
            const glm::dvec3 along = ray.origin + static_cast<double>(hit.distance) * ray.direction;
            worst_by_distance = std::max(worst_by_distance, glm::distance(RealVector(along), point));
        }
    }
    EXPECT_GT(count, 1000u);
    EXPECT_LT(worst, 1e-6L);
    // Where Embree's own distance is off by a good part of a metre: 500 m along slivers that are seen edge-on.
    EXPECT_LT(worst_by_distance, 1e-4L);
}

/// A scene at two times, with the points that are hidden at the second.
struct Hidden {
    TwoViews views;
    RayScene rays, other_rays;
    Image<Hit> hits, other_hits;
    MotionField before, after;
    std::uint64_t rays_cast = 0;

    Hidden(const Scene& scene, int width, int height)
        : views(scene, 0.0, 1.0, width, height), rays(scene), other_rays(rays.share_meshes()) {
        rays.update(views.now.pose, compute_anchor(views.now.view));
        other_rays.update(views.other.pose, compute_anchor(views.other.view));
        hits = cast_first_hits(rays, views.now.view);
        other_hits = cast_first_hits(other_rays, views.other.view);
        before = compute_model_motion(scene, views.now, views.other, hits);
        after = before;
        rays_cast = mark_hidden(after, scene, views.other, hits, other_rays);
    }
};

/// A card passes before a wall while the camera stands still.
Scene make_card(bool orthographic, double distance_from_origin) {
    Scene scene;
    Node root{
        .transform = {.translation = glm::dvec3(distance_from_origin, -distance_from_origin, distance_from_origin),
                      .axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, -2.0, 0.5)), 0.8}}};
    add_node(scene, root);
    Node wall{.parent = 0,
              .transform = {.translation = glm::dvec3(0.0, 0.0, -10.0)},
              .meshes = {add_grid(scene, 30.0f, 30.0f, 3)}};
    add_node(scene, wall);
    Node card{.parent = 0,
              .transform = {.translation = ramp(glm::dvec3(-0.9, 0.1, -5.0), glm::dvec3(0.7, -0.2, -5.0))},
              .meshes = {add_grid(scene, 1.03f, 1.51f)}};
    add_node(scene, card);
    add_camera(scene, 0);
    scene.cameras[0].orthographic = orthographic;
    scene.cameras[0].half_height = 2.0;
    return scene;
}

TEST(ReprojectionRays, HiddenIsWhatTheCardCoversNext) {
    for (const bool orthographic : {false, true}) {
        for (const double distance : {0.0, 1e6}) {
            const Hidden scene(make_card(orthographic, distance), 161, 120);
            std::size_t hidden = 0, valid_before = 0, wrong = 0;
            for (std::size_t i = 0; i < scene.hits.size(); ++i) {
                const bool was_valid = scene.before.validity.pixels[i] == MotionValidity::valid;
                valid_before += was_valid ? 1 : 0;
                const bool covered =
                    was_valid && scene.hits.pixels[i].instance == 0 && scene.other_hits.pixels[i].instance == 1;
                const bool marked = scene.after.validity.pixels[i] == MotionValidity::hidden;
                hidden += marked ? 1 : 0;
                wrong += marked != covered ? 1 : 0;
            }
            EXPECT_EQ(wrong, 0u) << orthographic << ' ' << distance;
            EXPECT_GT(hidden, 500u) << orthographic << ' ' << distance;
            EXPECT_EQ(scene.rays_cast, valid_before);
            // Displacement and path stay.
            EXPECT_EQ(scene.after.displacement, scene.before.displacement);
            EXPECT_EQ(scene.after.path_length, scene.before.path_length);
        }
    }
}

/// A card slides just before a wall.
TEST(ReprojectionRays, HiddenIsWhatANearCardCovers) {
    for (const double gap : {0.02, 4e-3, 1e-3, 1e-4}) {
        Scene scene;
        Node wall{.transform = {.translation = glm::dvec3(0.0, 0.0, -5.0)}, .meshes = {add_grid(scene, 6.0f, 6.0f)}};
        add_node(scene, wall);
        const double z = gap - 5.0;
        Node card{.transform = {.translation = ramp(glm::dvec3(-1.0, 0.1, z), glm::dvec3(0.2, -0.2, z))},
                  .meshes = {add_grid(scene, 1.03f, 1.51f)}};
        add_node(scene, card);
        add_camera(scene);
        const Hidden motion(scene, 161, 120);
        std::size_t hidden = 0, wrong = 0;
        for (std::size_t i = 0; i < motion.hits.size(); ++i) {
            const bool covered = motion.before.validity.pixels[i] == MotionValidity::valid &&
                                 motion.hits.pixels[i].instance == 0 && motion.other_hits.pixels[i].instance == 1;
            const bool marked = motion.after.validity.pixels[i] == MotionValidity::hidden;
            hidden += marked ? 1 : 0;
            wrong += marked != covered ? 1 : 0;
        }
        EXPECT_EQ(wrong, 0u) << gap;
        EXPECT_GT(hidden, 500u) << gap;
    }
}

/// A ball of radius 1 m turns and moves a little.
void expect_ball_hides(double distance, double fov, double turn) {
    Scene scene;
    const Mesh ball = make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 96});
    scene.meshes = {ball};
    Node node{.transform = {.translation = ramp(glm::dvec3(-0.3, 0.0, -distance), glm::dvec3(0.3, 0.2, -distance)),
                            .axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, ramp(0.0, turn * degrees)}},
              .meshes = {0}};
    add_node(scene, node);
    add_camera(scene, no_index, fov);
    const Hidden motion(scene, 200, 150);
    std::size_t hidden = 0, kept = 0;
    for (std::size_t i = 0; i < motion.hits.size(); ++i) {
        if (motion.hits.pixels[i].instance == no_index) continue;
        // On a ball a point is its own normal; it faces the camera where that leans towards it.
        const RealVector normal = real_turned(surface_point(ball, motion.hits.pixels[i]), {0, 1, 0},
                                              static_cast<Real>(turn) * std::numbers::pi_v<Real> / 180);
        const RealVector place = normal + RealVector(0.3L, 0.2L, -static_cast<Real>(distance));
        const Real facing = -glm::dot(unit(place), unit(normal));
        const MotionValidity validity = motion.after.validity.pixels[i];
        if (facing > 0.05L) {
            EXPECT_EQ(validity, MotionValidity::valid) << i << ' ' << distance;
            ++kept;
        } else if (facing < -0.05L) {
            EXPECT_EQ(validity, MotionValidity::hidden) << i << ' ' << distance;
            ++hidden;
        }
    }
    EXPECT_GT(kept, 1000u) << distance;
    EXPECT_GT(hidden, 300u) << distance;
}

TEST(ReprojectionRays, ASpinningBallHidesWhatTurnsAway) {
    expect_ball_hides(6.0, std::numbers::pi / 4.0, 40.0);
    for (const double distance : {100.0, 1000.0, 10000.0}) expect_ball_hides(distance, 3.0 / distance, 60.0);
}

/// The points of a scene in which nothing covers anything, seen from a camera that moves, that are taken for hidden.
std::size_t count_falsely_hidden(Scene scene, double scale, bool orthographic) {
    for (Node& node : scene.nodes) {
        node.transform.translation.values[0] *= scale;
        node.transform.scale = glm::dvec3(scale);
    }
    Node mount{};
    mount.transform.translation = ramp(glm::dvec3(0.0), scale * glm::dvec3(0.037, 0.011, -0.23));
    mount.transform.axis_rotation = AxisRotation{glm::normalize(glm::dvec3(1.0, 2.0, 0.5)), ramp(0.0, 0.02)};
    add_camera(scene, add_node(scene, mount));
    scene.cameras[0].orthographic = orthographic;
    scene.cameras[0].half_height = scale;
    scene.cameras[0].near_plane = 1e-4 * scale;
    const Hidden motion(scene, 161, 121);
    std::size_t seen = 0, hidden = 0;
    for (std::size_t i = 0; i < motion.hits.size(); ++i) {
        seen += motion.before.validity.pixels[i] == MotionValidity::valid ? 1 : 0;
        hidden += motion.after.validity.pixels[i] == MotionValidity::hidden ? 1 : 0;
    }
    EXPECT_GT(seen, 1000u);
    return hidden;
}

TEST(ReprojectionRays, WhatNothingCoversIsNotHidden) {
    for (const bool orthographic : {false, true}) {
        for (const double scale : {1e-3, 1.0, 1e4}) {
            for (const double tilt : {90.0, 45.0, 10.0, 1.0, 0.1}) {
                Scene plane;  // of tiles that are objects of their own, finely cut
                const int mesh = add_grid(plane, 1.0f, 200.0f, 40);
                for (int tile = -10; tile <= 10; ++tile) {
                    Node node{.transform = {.translation = glm::dvec3(tile, -0.05, -3.0),
                                            .axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, (tilt - 90.0) * degrees}},
                              .meshes = {mesh}};
                    add_node(plane, node);
                }
                EXPECT_EQ(count_falsely_hidden(plane, scale, orthographic), 0u) << scale << ' ' << tilt;
            }
            Scene ball;
            ball.meshes = {make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 500})};
            Node node{.transform = {.translation = glm::dvec3(0.0, 0.0, -3.0)}, .meshes = {0}};
            add_node(ball, node);
            // Nearing, a camera without perspective sees the same; with it, a ring of the ball turns away.
            EXPECT_LE(count_falsely_hidden(ball, scale, orthographic), 20u) << scale;
        }
    }
}

}  // namespace
}  // namespace aleph
