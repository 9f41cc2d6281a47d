// Known answers of engine/pose/camera_view.h.

#include "engine/pose/camera_view.h"
#include "engine/pose/posed_view.h"
#include "engine/scene/transforms.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

CameraValues placed(const glm::dvec3& eye, const glm::dvec3& target) {
    const glm::dmat4 world = look_at(eye, target, {0.0, 1.0, 0.0});
    return {.position = eye, .axes = glm::dmat3(world), .fov = pi / 3.0, .half_height = 2.5};
}

TEST(CameraView, FocalLengthInPixels) {
    CameraValues camera{.fov = pi / 2.0};
    EXPECT_NEAR(make_camera_view(camera, 640, 480).pixels_per_unit, 240.0, 1e-12);
    EXPECT_NEAR(make_camera_view(camera, 64, 480).pixels_per_unit, 240.0, 1e-12);  // the field of view is vertical
    camera.orthographic = true;
    camera.half_height = 3.0;
    EXPECT_DOUBLE_EQ(make_camera_view(camera, 640, 480).pixels_per_unit, 80.0);
}

TEST(CameraView, AFieldOfViewThatOvershootsIsRefusedWithTheNameOfItsCamera) {
    Scene scene;
    scene.source.file = "s.json";
    scene.cameras.push_back(
        {.fov = Track<double>({0.0, 1.0}, {0.0, 1.0, 20.0, -20.0, 1.0, 0.0}, Interpolation::cubic)});
    scene.nodes.push_back({.name = "zoom", .camera = 0});
    EXPECT_NO_THROW(make_posed_view(scene, 0.0, 0, 8, 6));
    const Refusal refusal = find_refusal([&] { make_posed_view(scene, 0.5, 0, 8, 6); });
    EXPECT_EQ(refusal.file, "s.json");
    EXPECT_EQ(refusal.place, "camera \"zoom\"");
}

TEST(CameraView, TheCentreLooksAlongMinusZAndRowsGoDown) {
    CameraValues camera{.fov = pi / 2.0};
    const CameraView view = make_camera_view(camera, 8, 4);
    EXPECT_EQ(make_camera_ray(view, 4.0, 2.0).direction, glm::dvec3(0.0, 0.0, -1.0));
    const double s = std::sqrt(0.5);
    expect_near(make_camera_ray(view, 4.0, 0.0).direction, {0.0, s, -s}, 1e-15);  // upper edge
    expect_near(make_camera_ray(view, 6.0, 2.0).direction, {s, 0.0, -s}, 1e-15);
}

TEST(CameraView, RaysAndProjectionAreInverse) {
    for (const bool orthographic : {false, true}) {
        CameraValues camera = placed({3.0, 4.0, -5.0}, {-1.0, 0.5, 2.0});
        camera.orthographic = orthographic;
        const CameraView view = make_camera_view(camera, 640, 480);
        for (const double x : {0.5, 319.5, 320.0, 639.5})
            for (const double y : {0.5, 100.25, 479.5}) {
                const CameraRay ray = make_camera_ray(view, x, y);
                EXPECT_NEAR(glm::length(ray.direction), 1.0, 1e-15);
                const glm::dvec3 point = to_camera(view, ray.origin + 7.0 * ray.direction);
                EXPECT_LT(point.z, 0.0);
                const glm::dvec2 pixel = project_camera_point(view, point);
                EXPECT_NEAR(pixel.x, x, 1e-10);
                EXPECT_NEAR(pixel.y, y, 1e-10);
            }
    }
}

TEST(CameraView, OrthographicRaysStartOnTheCameraPlane) {
    CameraValues camera = placed({3.0, 4.0, -5.0}, {-1.0, 0.5, 2.0});
    camera.orthographic = true;
    const CameraView view = make_camera_view(camera, 640, 480);
    const CameraRay ray = make_camera_ray(view, 10.0, 20.0);
    EXPECT_EQ(ray.direction, -camera.axes[2]);
    EXPECT_NEAR(to_camera(view, ray.origin).z, 0.0, 1e-14);
    EXPECT_NEAR(to_camera(view, ray.origin).y, 2.5 * (240.0 - 20.0) / 240.0, 1e-14);
}

/// A film offset shows another window of the same, larger picture.
TEST(CameraView, FilmOffsetIsACropOfALargerPicture) {
    for (const bool orthographic : {false, true}) {
        CameraValues camera = placed({3.0, 4.0, -5.0}, {-1.0, 0.5, 2.0});
        camera.orthographic = orthographic;
        // 160 x 120 pixels within 480 x 360 with the same focal length: half an angle whose tangent is three times as
        // large, or three times the half height.
        CameraValues wide = camera;
        wide.fov = 2.0 * std::atan(3.0 * std::tan(0.5 * camera.fov));
        wide.half_height = 3.0 * camera.half_height;
        const CameraView whole = make_camera_view(wide, 480, 360);
        camera.shift_x = 50.0 / 120.0;   // right
        camera.shift_y = -25.0 / 120.0;  // down
        const CameraView cropped = make_camera_view(camera, 160, 120);
        const glm::dvec2 corner(160.0 + 50.0, 120.0 + 25.0);  // of the crop in the larger picture
        for (const glm::dvec2 pixel : {glm::dvec2(0.5, 0.5), glm::dvec2(80.0, 60.0), glm::dvec2(159.5, 31.25)}) {
            const CameraRay a = make_camera_ray(cropped, pixel.x, pixel.y);
            const CameraRay b = make_camera_ray(whole, corner.x + pixel.x, corner.y + pixel.y);
            expect_near(a.origin, b.origin, 1e-12);
            expect_near(a.direction, b.direction, 1e-12);
            const glm::dvec2 back = project_camera_point(cropped, to_camera(cropped, a.origin + 5.0 * a.direction));
            EXPECT_NEAR(back.x, pixel.x, 1e-10);
            EXPECT_NEAR(back.y, pixel.y, 1e-10);
        }
    }
}

TEST(CameraView, RefusesWhatIsNoCamera) {
    CameraValues camera;
    for (const double fov : {0.0, -0.0, -1.0, pi, 4.0, infinity, -infinity, not_a_number, 5e-324}) {
        camera.fov = fov;
        EXPECT_THROW(make_camera_view(camera, 8, 8), InputError) << fov;
    }
    camera.fov = 3.14;
    EXPECT_GT(make_camera_view(camera, 8, 8).pixels_per_unit, 0.0);
    camera.orthographic = true;
    for (const double half : {0.0, -1.0, infinity, not_a_number, 5e-324}) {
        camera.half_height = half;
        EXPECT_THROW(make_camera_view(camera, 8, 8), InputError) << half;
    }
    camera.half_height = 1.0;
    EXPECT_THROW(make_camera_view(camera, 0, 8), InputError);
    EXPECT_THROW(make_camera_view(camera, 8, -1), InputError);
    for (const double bad : {infinity, not_a_number}) {
        camera.shift_x = bad;
        EXPECT_THROW(make_camera_view(camera, 8, 8), InputError);
    }
}

TEST(CameraView, RC05_AnchorLiesOnTheGridNearTheCamera) {
    CameraView view;
    EXPECT_EQ(compute_anchor(view), glm::dvec3(0.0));
    view.position = {7.9, -7.9, 8.1};
    EXPECT_EQ(compute_anchor(view), glm::dvec3(0.0, 0.0, 16.0));
    view.position = {1e6 + 3.0, -1e6, 777.0};
    const glm::dvec3 anchor = compute_anchor(view);
    for (int i = 0; i < 3; ++i) {
        EXPECT_EQ(std::fmod(anchor[i], 16.0), 0.0);
        EXPECT_LE(std::abs(anchor[i] - view.position[i]), 8.0);
    }
    EXPECT_EQ(compute_anchor(view), anchor);
    // The grid is finer where things are nearer, and no finer than a double resolves.
    for (const double near_plane : {5e-5, 1e-7, 1e-30}) {
        view.near_plane = near_plane;
        view.position = {3.3, -2.1, 777.7};
        EXPECT_LE(glm::distance(compute_anchor(view), view.position), 1.8e5 * std::max(near_plane, 1e-10));
    }
}

/// Scales of 1e18 each, as files may hold, multiply. From 1e300 on, Embree ended the program.
TEST(CameraView, AnEyeTooFarAwayIsRefused) {
    CameraValues camera;
    camera.position = {0.0, 0.0, -1e18};
    EXPECT_NO_THROW(make_camera_view(camera, 8, 4));
    for (const double far : {1.1e18, -1e300, not_a_number}) {
        camera.position.y = far;
        EXPECT_NE(find_refusal([&] { make_camera_view(camera, 8, 4); }).message.find("within 1e+18 m"),
                  std::string::npos);
    }
}

}  // namespace
}  // namespace aleph
