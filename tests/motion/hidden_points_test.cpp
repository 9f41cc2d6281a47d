// Points that are hidden in the other frame are found, however near before them the cover lies; no others.

#include "engine/surface/shapes.h"
#include "motion/reprojection.h"
#include "tests/support/first_hits.h"
#include "tests/support/motion_truth.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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

TEST(HiddenPoints, HiddenIsWhatTheCardCoversNext) {
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
TEST(HiddenPoints, HiddenIsWhatANearCardCovers) {
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

TEST(HiddenPoints, ASpinningBallHidesWhatTurnsAway) {
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

TEST(HiddenPoints, WhatNothingCoversIsNotHidden) {
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
            EXPECT_LE(count_falsely_hidden(ball, scale, orthographic), 60u) << scale;
        }
    }
}

}  // namespace
}  // namespace aleph
