// Motion from rasterized maps: its error is that of 8 bits for each coordinate, and no more.

#include "motion/raster.h"
#include "motion/reprojection.h"
#include "tests/support/first_hits.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/scenes/motion_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

MotionField find_raster_motion(const Scene& scene, const TwoViews& views, OtherFrame which = OtherFrame::next) {
    const PosePlan plan = make_pose_plan(scene);
    ModelMotion model(scene, plan);
    return compute_raster_motion(model, scene, views.now, views.other, rasterize(scene, views.now), which);
}

/// Largest error, pixels, for a square of two triangles that is so many pixels wide and moves by 7 of them.
double largest_error(double pixels) {
    Scene scene;
    const auto width = static_cast<float>(pixels / 200.0);
    Node square{.meshes = {add_grid(scene, width, width)}};
    square.transform.translation = ramp(glm::dvec3(0.0, 0.0, -3.0), glm::dvec3(7.0 / 200.0, 0.0, -3.0));
    add_node(scene, square);
    add_camera(scene);
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.5;
    const TwoViews views(scene, 0.0, 1.0, 200, 200);
    const MotionField field = find_raster_motion(scene, views);
    double largest = 0.0;
    for (std::size_t i = 0; i < field.displacement.size(); ++i) {
        if (field.validity.pixels[i] != MotionValidity::valid) continue;
        largest = std::max(largest, glm::length(field.displacement.pixels[i] - glm::dvec2(7.0, 0.0)));
        EXPECT_EQ(field.path_length.pixels[i], glm::length(field.displacement.pixels[i]));
    }
    return largest;
}

TEST(RasterMotion, RP20_ErrsByHalfAStepOfTheTriangle) {
    const double small = largest_error(20.0), large = largest_error(180.0);
    // Half a step along both edges of a corner, at right angles or at half of one.
    EXPECT_GT(large, 0.5 * 180.0 / 255.0) << "two coordinates err";
    EXPECT_LT(large, 0.5 * 180.0 / 255.0 * (1.0 + std::sqrt(2.0)));
    EXPECT_NEAR(small / large, 20.0 / 180.0, 0.04) << "the error grows with the triangle";
}

/// Where coordinates of a hit lie in the other frame.
glm::dvec2 find_place(const Scene& scene, const PosedView& view, Hit hit, double u, double v) {
    const auto [node, mesh] = view.pose.instances[static_cast<std::size_t>(hit.instance)];
    hit.u = static_cast<float>(u);
    hit.v = static_cast<float>(v);
    const CameraFromObject place = make_camera_from_object(view.view, view.pose.world[node]);
    return project_camera_point(view.view, place(surface_point(scene.meshes[mesh], view.pose.meshes[mesh], hit)));
}

/// The most that half a step of both coordinates moves a hit's place, pixels.
double error_bound(const Scene& scene, const PosedView& other, const Hit& hit) {
    constexpr double step = 0.5 / 255.0 + 1e-6;
    const glm::dvec2 exact = find_place(scene, other, hit, hit.u, hit.v);
    double most = 0.0;
    for (const double du : {-step, step}) {
        for (const double dv : {-step, step}) {
            const double u = std::max(0.0, hit.u + du), v = std::max(0.0, hit.v + dv);
            most = std::max(most, glm::length(find_place(scene, other, hit, u, v) - exact));
        }
    }
    // Coordinates whose sum is above 1 are put back onto the edge: by another step at most.
    return hit.u + hit.v > 1.0f - 2.0f / 255.0f ? 3.0 * most : most;
}

TEST(RasterMotion, RP20_NoPixelErrsByMoreThanEightBitsExplain) {
    Scene scene = make_sheet_scene(3);
    auto& place = scene.nodes[0].transform;
    place.translation = ramp(glm::dvec3(0.0, 0.0, -3.0), glm::dvec3(0.2, -0.1, -2.5));
    place.axis_rotation = AxisRotation{glm::normalize(glm::dvec3(0.3, 1.0, 0.2)), ramp(0.3, 0.5)};
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, sample == 0 ? 0.0f : 0.3f * p.x * p.y);
    });
    add_camera(scene);
    const TwoViews views(scene, 0.0, 1.0, 320, 240);
    const Image<Hit> hits = cast_first_hits(scene, views.now), items = rasterize(scene, views.now);
    const MotionField exact = compute_model_motion(scene, views.now, views.other, hits);
    const MotionField field = find_raster_motion(scene, views);
    std::size_t compared = 0, off = 0;
    for (std::size_t i = 0; i < hits.size(); ++i) {
        const Hit& hit = hits.pixels[i];
        if (hit.primitive == no_index || hit.primitive != items.pixels[i].primitive) continue;
        const double error = glm::length(field.displacement.pixels[i] - exact.displacement.pixels[i]);
        EXPECT_LE(error, error_bound(scene, views.other, hit) + 1e-3) << i;
        ++compared;
        off += error > 0.1;
    }
    EXPECT_GT(compared, hits.size() / 5);
    EXPECT_GT(off, compared / 10) << "8 bits are seen";
}

TEST(RasterMotion, TheFrameBeforeAndNone) {
    Scene scene;
    Node square{.meshes = {add_grid(scene, 0.5f, 0.5f)}};
    square.transform.translation = ramp(glm::dvec3(0.0, 0.0, -3.0), glm::dvec3(0.1, 0.0, -3.0));
    add_node(scene, square);
    add_camera(scene);
    const TwoViews views(scene, 0.5, 0.0, 80, 60);
    const double truth = 0.05 / 3.0 * views.now.view.pixels_per_unit;
    EXPECT_NEAR(find_raster_motion(scene, views, OtherFrame::previous).displacement(40, 30).x, truth, 0.1);
    const MotionField none = find_raster_motion(scene, views, OtherFrame::none);
    EXPECT_EQ(none.displacement(40, 30), glm::dvec2(0.0));
    EXPECT_EQ(none.validity(40, 30), MotionValidity::no_counterpart);
}

/// A full turn in a frame ends where it began.
TEST(RasterMotion, RP07_PathsOfTurnsAreArcs) {
    Scene scene;
    Node square{.meshes = {add_grid(scene, 1.0f, 1.0f)}};
    square.transform.translation = glm::dvec3(0.0, 0.0, -3.0);
    square.transform.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, ramp(0.0, 360.0 * degrees)};
    add_node(scene, square);
    add_camera(scene);
    const TwoViews views(scene, 0.0, 1.0, 80, 60);
    const MotionField field = find_raster_motion(scene, views);
    for (const int x : {45, 50}) {
        const double arc = 2.0 * std::numbers::pi * std::hypot(x + 0.5 - 40.0, 0.5);
        EXPECT_NEAR(field.path_length(x, 30), arc, 0.02 * arc + 0.5);
        EXPECT_LT(glm::length(field.displacement(x, 30)), 0.2);
    }
}

TEST(RasterMotion, IsNoLongerThanThePictureNorWithoutANumber) {
    Scene scene;
    add_endless_floor(scene);
    Node mount{};
    mount.transform.translation = ramp(glm::dvec3(0.0), glm::dvec3(0.0, 0.0, -1.0));
    add_camera(scene, add_node(scene, mount));
    const MotionField field = find_raster_motion(scene, TwoViews(scene, 0.0, 1.0, 80, 60));
    for (std::size_t i = 0; i < field.displacement.size(); ++i) {
        EXPECT_LE(glm::length(field.displacement.pixels[i]), 100.0 + 1e-9);
        EXPECT_LE(field.path_length.pixels[i], 100.0);
    }
}

}  // namespace
}  // namespace aleph
