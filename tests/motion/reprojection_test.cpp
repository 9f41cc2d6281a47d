// Reprojection of Q(u,v,t) where it is fragile. Expected values by hand or in long double.

#include "motion/velocity.h"
#include "tests/support/model_motion.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// An object that rotates about the camera together with it: its motion must be almost 0.
TEST(Reprojection, RP01_RidingAlongIsStillWithinRounding) {
    Scene scene;
    Node cart{.transform = {.translation = ramp(glm::dvec3(0.0), glm::dvec3(300.0, 5.0, 90.0)),
                            .axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, ramp(0.0, 90.0)}}};
    const int root = add_node(scene, cart);
    Node node{.parent = root, .meshes = {add_point(scene, {0.3f, 0.2f, -5.0f})}};
    add_node(scene, node);
    add_camera(scene, root);
    const PointMotion motion = motion_of_point(scene, 0.0, 1.0 / 30.0);
    EXPECT_LT(glm::length(motion.displacement), 1e-9);
    EXPECT_LT(motion.path_length, 1e-9);  // 170 degrees a frame, but not against the camera
    EXPECT_EQ(motion.validity, MotionValidity::valid);
}

TEST(Reprojection, RP02_TinyMotion) {
    for (const double pixels : {1e-2, 1e-4, 1e-6}) {
        for (const double distance : {0.0, 1e3, 1e6}) {
            const double metres = pixels / 200.0;  // 1000 px at 5 m
            Scene scene = make_point_scene({0.5f, -0.25f, -5.0f});
            // The far keys are rounded to doubles: the rounded values are the truth.
            const double from = distance, to = distance + metres;
            scene.nodes[0].transform.translation = ramp(glm::dvec3(from, 0.0, 0.0), glm::dvec3(to, 0.0, 0.0));
            scene.nodes[1].transform.translation = glm::dvec3(distance, 0.0, 0.0);
            const double expected = 200.0 * (to - from);
            ASSERT_NEAR(expected, pixels, distance < 1e6 ? 1e-2 * pixels : 3e-8);
            const PointMotion motion = motion_of_point(scene);
            EXPECT_NEAR(motion.displacement.x, expected, 1e-10) << pixels << " at " << distance;
            EXPECT_NEAR(motion.displacement.y, 0.0, 1e-10) << pixels << " at " << distance;
            EXPECT_NEAR(motion.path_length, expected, 1e-10) << pixels << " at " << distance;
        }
    }
}

/// Everything turns about a centre by whole turns: the pose is the same up to rounding, the motion must stay below the
/// dead zone of the motion channel.
TEST(Reprojection, RP03_RoundingStaysFarBelowTheDeadZone) {
    Scene scene;
    Node node{.transform = {.translation = glm::dvec3(0.0, 0.0, -10.0),
                            .axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, ramp(0.0, 200.0 * std::numbers::pi)}},
              .meshes = {add_triangle_soup(scene, 100, 1.0f)}};
    add_node(scene, node);
    add_camera(scene);
    const TwoViews views(scene, 0.13, 0.14, 320, 240);  // one full turn
    const Image<Hit> hits = make_random_hits(scene, views.now.pose, 320, 240);
    const MotionField field = compute_model_motion(scene, views.now, views.other, hits);
    double largest = 0.0, shortest_path = 1e9;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        largest = std::max(largest, glm::length(field.displacement.pixels[i]));
        shortest_path = std::min(shortest_path, field.path_length.pixels[i]);
    }
    EXPECT_LT(largest, 1e-8);
    EXPECT_GT(shortest_path, 0.0);  // and yet it is no rest
}

TEST(Reprojection, RP04_BehindTheNextCamera) {
    Scene scene = make_point_scene({0.3f, -0.3f, -1.0f});
    scene.nodes[1].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -2.0));
    const PointMotion motion = motion_of_point(scene);
    EXPECT_EQ(motion.validity, MotionValidity::behind_camera);
    EXPECT_EQ(motion.displacement, glm::dvec2(0.0));
    EXPECT_EQ(motion.path_length, 0.0);
}

TEST(Reprojection, RP05_OnAndNearTheCameraPlane) {
    for (const glm::vec3& point : {glm::vec3(0.3f, -0.3f, -1.0f), glm::vec3(0.0f, 0.0f, -1.0f)}) {
        for (const double remaining : {0.0, 1e-300, 1e-6, 0.99e-4, 1e-4}) {  // m; the near plane is at 1e-4
            Scene scene = make_point_scene(point);
            // The point moves towards the camera: the rest is exact.
            scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0 - remaining));
            const double depth = 1.0 - (1.0 - remaining);
            const PointMotion motion = motion_of_point(scene);
            if (depth <= 1e-4) {
                EXPECT_EQ(motion.validity, MotionValidity::behind_camera) << remaining;
                EXPECT_EQ(motion.displacement, glm::dvec2(0.0)) << remaining;
                EXPECT_EQ(motion.path_length, 0.0) << remaining;
            } else {
                EXPECT_NE(motion.validity, MotionValidity::behind_camera) << remaining;
            }
        }
    }
    // Just beyond the near plane the displacement is 3000 times the image: capped at its diagonal, direction kept.
    Scene scene = make_point_scene({0.3f, -0.3f, -1.0f});
    scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0 - 1.1e-4));
    const PointMotion motion = motion_of_point(scene);
    EXPECT_EQ(motion.validity, MotionValidity::leaves_screen);
    EXPECT_NEAR(motion.displacement.x, 1000.0, 1e-9);  // diagonal 1000 sqrt 2
    EXPECT_NEAR(motion.displacement.y, 1000.0, 1e-9);
    EXPECT_NEAR(motion.path_length, 1000.0 * std::sqrt(2.0), 1e-9);
}

/// A near plane of almost 0: numbers whose square overflows must be capped too, and not become NaN.
TEST(Reprojection, RP05_NoNearPlane) {
    for (const double near_plane : {0.0, 1e-300, -1.0}) {
        Scene scene = make_point_scene({3.0e30f, -4.0e30f, -1.0f});
        scene.cameras[0].near_plane = near_plane;
        scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0 - 1e-9));
        const PointMotion motion = motion_of_point(scene);
        EXPECT_NEAR(motion.displacement.x, 0.6 * 1000.0 * std::sqrt(2.0), 1e-3) << near_plane;
        EXPECT_NEAR(motion.displacement.y, 0.8 * 1000.0 * std::sqrt(2.0), 1e-3) << near_plane;
        scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
        EXPECT_EQ(motion_of_point(scene).validity, MotionValidity::behind_camera) << near_plane;
    }
}

TEST(Reprojection, RP05_LengthsWhoseSquareOverflows) {
    Scene scene = make_point_scene({3.0f, -4.0f, -2.0f});
    scene.nodes[0].transform.scale = glm::dvec3(1e200, 1e200, 1.0);
    scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.0));
    const PointMotion motion = motion_of_point(scene);
    EXPECT_NEAR(motion.displacement.x, 0.6 * 1000.0 * std::sqrt(2.0), 1e-9);
    EXPECT_NEAR(motion.displacement.y, 0.8 * 1000.0 * std::sqrt(2.0), 1e-9);
}

TEST(Reprojection, RP06_ApproachingSurface) {
    // x = .075 at z = -2 and at z = -.1: f x (1/.1 - 1/2) = 712.5 px, kept although it leaves the screen.
    Scene scene = make_point_scene({0.075f, 0.0f, -2.0f});
    scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 1.9));
    const PointMotion motion = motion_of_point(scene);
    EXPECT_NEAR(motion.displacement.x, 712.5, 1e-4);
    EXPECT_EQ(motion.validity, MotionValidity::leaves_screen);
    const double half_way = motion_of_point(scene, 0.0, 0.5).displacement.x;
    EXPECT_NEAR(half_way, 75.0 * (1.0 / 1.05 - 0.5), 1e-4);
}

/// Focal length 100, 200x100, no surface at all.
MotionField background_motion(const Scene& scene) {
    return motion_between(scene, 0.0, 1.0, Image<Hit>(200, 100));
}
Scene make_empty_scene(const AxisRotation& turn) {
    Scene scene;
    add_camera(scene, no_index, fov_of(100.0, 100));
    scene.nodes[0].transform.axis_rotation = turn;
    return scene;
}

TEST(Reprojection, RP09_BackgroundFollowsRotation) {
    for (const double from : {0.0, 30.0}) {
        const MotionField panned =
            background_motion(make_empty_scene({{0.0, 1.0, 0.0}, ramp(from * degrees, (from + 1.0) * degrees)}));
        for (const int x : {0, 57, 100, 199}) {
            for (const int y : {3, 50}) {
                // Seen at atan(x/f) right of the axis; the camera turns left by a degree, so it goes right.
                const double column = x + 0.5 - 100.0, row = y + 0.5 - 50.0;
                const double seen = std::atan2(column, 100.0), next = seen + 1.0 * degrees;
                EXPECT_NEAR(panned.displacement(x, y).x, 100.0 * std::tan(next) - column, 1e-4) << x;
                EXPECT_NEAR(panned.displacement(x, y).y, row * std::cos(seen) / std::cos(next) - row, 1e-4) << x;
                EXPECT_EQ(panned.validity(x, y), MotionValidity::background);
                EXPECT_DOUBLE_EQ(panned.path_length(x, y), glm::length(panned.displacement(x, y)));
            }
        }
    }
}

/// A picture that turns one way moves as the world does before a camera that turns the other way.
TEST(Reprojection, RP09_BackgroundFollowsItsPicture) {
    Scene turning = make_empty_scene({{0.0, 1.0, 0.0}, 0.0});
    turning.environment.axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, ramp(0.0, -1.0 * degrees)};
    const MotionField field = background_motion(turning);
    for (const int x : {0, 57, 199}) {
        const double column = x + 0.5 - 100.0, row = 3.5 - 50.0;
        const double seen = std::atan2(column, 100.0), next = seen + 1.0 * degrees;
        EXPECT_NEAR(field.displacement(x, 3).x, 100.0 * std::tan(next) - column, 1e-9) << x;
        EXPECT_NEAR(field.displacement(x, 3).y, row * std::cos(seen) / std::cos(next) - row, 1e-9) << x;
        EXPECT_EQ(field.validity(x, 3), MotionValidity::background);
    }
    // Turned with its picture, a camera sees it at rest.
    turning.nodes[0].transform.axis_rotation = turning.environment.axis_rotation;
    const MotionField together = background_motion(turning);
    for (const glm::dvec2& moved : together.displacement.pixels) ASSERT_LT(glm::length(moved), 1e-9);
}

TEST(Reprojection, RP09_BackgroundThatDoesNotMove) {
    const auto expect_rest = [](const Scene& scene, const char* name) {
        const MotionField field = background_motion(scene);
        for (std::size_t i = 0; i < field.displacement.size(); ++i) {
            ASSERT_EQ(field.displacement.pixels[i], glm::dvec2(0.0)) << name;
            ASSERT_EQ(field.path_length.pixels[i], 0.0) << name;
            ASSERT_EQ(field.validity.pixels[i], MotionValidity::background) << name;
        }
    };
    Scene still = make_empty_scene({glm::normalize(glm::dvec3(1.0, 2.0, 3.0)), 0.7});
    expect_rest(still, "a camera that stands still");
    still.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(1.0, -2.0, 3.0));
    expect_rest(still, "a camera that only moves");
    expect_rest(make_empty_scene({{0.0, 1.0, 0.0}, ramp(0.0, 180.0 * degrees)}), "behind the turned camera");
    Scene parallel = make_empty_scene({{0.0, 1.0, 0.0}, ramp(0.0, 5.0 * degrees)});
    parallel.cameras[0].orthographic = true;
    expect_rest(parallel, "orthographic");
}

TEST(Reprojection, RP10_AcrossACutNothingMoves) {
    Scene scene = make_point_scene({0.1f, 0.1f, -5.0f});
    scene.nodes[1].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.3, 0.0, 0.0));
    scene.nodes[1].transform.axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, ramp(0.0, 25.0 * degrees)};
    const TwoViews views(scene, 0.0, 1.0, 64, 48);
    Image<Hit> hits(64, 48);
    for (int x = 0; x < 64; ++x) hits(x, 20) = {.instance = 0, .primitive = 0};
    const auto expect_rest = [&](const PosedView& other) {
        const MotionField field = compute_model_motion(scene, views.now, other, hits, OtherFrame::none);
        const Image<float> velocity = compute_image_velocity(field, {}, {});
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                ASSERT_EQ(field.displacement(x, y), glm::dvec2(0.0));
                ASSERT_EQ(field.path_length(x, y), 0.0);
                ASSERT_EQ(velocity(x, y), 0.0f);
                ASSERT_EQ(field.validity(x, y), MotionValidity::no_counterpart);
            }
        }
    };
    expect_rest(views.other);
    expect_rest({});  // RP-11: a single frame has no other
}

TEST(Reprojection, RP11_LastFrameGoesBackwards) {
    // Constant speed on the screen: frame N-1 forwards and frame N backwards agree.
    Scene scene = make_point_scene({0.1f, 0.2f, -5.0f});
    scene.nodes[0].transform.translation = ramp(glm::dvec3(-0.5, 0.0, 0.0), glm::dvec3(0.7, -0.3, 0.0));
    const double last = 1.0, before = last - 1.0 / 30.0;
    const PointMotion forward = motion_of_point(scene, before, last);
    const PointMotion backward = motion_of_point(scene, last, before, OtherFrame::previous);
    EXPECT_NEAR(backward.displacement.x, forward.displacement.x, 1e-6);
    EXPECT_NEAR(backward.displacement.y, forward.displacement.y, 1e-6);
    EXPECT_NEAR(forward.displacement.x, 1.2 / 30.0 * 200.0, 1e-6);
    EXPECT_NEAR(backward.path_length, forward.path_length, 1e-6);
    EXPECT_EQ(backward.validity, MotionValidity::valid);
}

TEST(Reprojection, RP12_VisibleInOneFrameOnly) {
    Scene scene = make_point_scene({0.1f, 0.2f, -5.0f});
    scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.5, 0.0, 0.0));
    scene.nodes[0].visible = ramp(1.0, 0.0);
    scene.nodes[0].visible.interpolation = Interpolation::step;
    const PointMotion vanishes = motion_of_point(scene);
    EXPECT_EQ(vanishes.validity, MotionValidity::no_counterpart);
    EXPECT_EQ(vanishes.displacement, glm::dvec2(0.0));
    EXPECT_EQ(vanishes.path_length, 0.0);
    // The first reason that applies: it is also behind the camera, but has no counterpart.
    scene.nodes[0].transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, 9.0));
    EXPECT_EQ(motion_of_point(scene).validity, MotionValidity::no_counterpart);
    scene.nodes[0].visible = 1.0;
    EXPECT_EQ(motion_of_point(scene).validity, MotionValidity::behind_camera);
}

TEST(Reprojection, RP12_WhatNoRayCanMeetIsNotInTheOtherFrame) {
    Scene flat = make_point_scene({0.1f, 0.2f, -5.0f});
    flat.nodes[0].transform.scale = ramp(glm::dvec3(1.0), glm::dvec3(0.0, 1.0, 1.0));
    Scene far = make_point_scene({0.1f, 0.2f, -5.0f});
    add_cache(far, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return sample == 0 ? p : p + glm::vec3(0.0f, 0.0f, -1e20f);
    });
    for (const Scene& scene : {flat, far}) {
        const PointMotion motion = motion_of_point(scene);
        EXPECT_EQ(motion.validity, MotionValidity::no_counterpart);
        EXPECT_EQ(motion.displacement, glm::dvec2(0.0));
    }
}

TEST(Reprojection, RP13_LeavingTheScreen) {
    // 200 px per metre at 5 m; the screen ends 500 px right of the axis.
    const struct {
        double metres;
        MotionValidity validity;
    } cases[] = {
        {2.4, MotionValidity::valid},         {2.5, MotionValidity::valid},  {2.5001, MotionValidity::leaves_screen},
        {5.0, MotionValidity::leaves_screen}, {-2.5, MotionValidity::valid}, {-2.5001, MotionValidity::leaves_screen}};
    for (const auto& c : cases) {
        for (const bool vertical : {false, true}) {
            Scene scene = make_point_scene({0.0f, 0.0f, -5.0f});
            scene.nodes[0].transform.translation =
                ramp(glm::dvec3(0.0), vertical ? glm::dvec3(0.0, c.metres, 0.0) : glm::dvec3(c.metres, 0.0, 0.0));
            // A focal length of exactly 1000 px, so that the border case is one.
            TwoViews views(scene, 0.0, 1.0, 1000, 1000);
            for (PosedView* posed : {&views.now, &views.other}) posed->view.pixels_per_unit = 1000.0;
            Image<Hit> hits(1000, 1000);
            hits(500, 500) = {.instance = 0, .primitive = 0};
            const MotionField field = compute_model_motion(scene, views.now, views.other, hits);
            EXPECT_EQ(field.validity(500, 500), c.validity) << c.metres;
            const glm::dvec2 expected = vertical ? glm::dvec2(0.0, -200.0 * c.metres) : glm::dvec2(200.0 * c.metres, 0);
            EXPECT_NEAR(glm::length(field.displacement(500, 500) - expected), 0.0, 1e-9) << c.metres;
        }
    }
}

}  // namespace
}  // namespace aleph
