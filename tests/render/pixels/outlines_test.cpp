// Which pixels show more than one thing: objects, steps, creases, contrasts; and which of them move differently.

#include "render/pixels/outlines.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 40, height = 30;

CameraView test_view() {
    return make_camera_view({}, width, height);
}

/// Hits of an object at distances of the viewer's choice.
Image<Hit> hits_at(const CameraView& view,
                   const std::function<double(const glm::dvec3& direction, int x, int y)>& distance) {
    Image<Hit> hits(width, height);
    for (const auto [x, y] : all_pixels(width, height)) {
        hits(x, y).instance = hits(x, y).primitive = 0;
        hits(x, y).distance = static_cast<float>(distance(make_camera_ray(view, x + 0.5, y + 0.5).direction, x, y));
    }
    return hits;
}

int count(const Image<Outline>& outlines, Outline kind) {
    return static_cast<int>(std::ranges::count(outlines.pixels, kind));
}

TEST(Outlines, APlaneHasNoneAtAnyAngle) {
    const CameraView view = test_view();
    for (const glm::dvec3 normal : {glm::dvec3(0, 0, 1), glm::dvec3(0.6, 0.1, 0.8), glm::dvec3(0.1, 0.85, 0.5)}) {
        const auto hits = hits_at(view, [&](const glm::dvec3& d, int, int) {
            EXPECT_GT(glm::dot(-d, normal), 0.05);
            return 2.0 / glm::dot(-d, normal);
        });
        EXPECT_EQ(count(find_outlines(view, hits, {}), Outline::none), width * height) << normal.x;
    }
}

TEST(Outlines, StepsOfOneObjectAndOtherObjectsAreFound) {
    const CameraView view = test_view();
    const auto plane = [](double z, const glm::dvec3& d) { return z / -d.z; };
    auto hits = hits_at(view, [&](const glm::dvec3& d, int x, int) { return plane(x < 20 ? 2.0 : 2.5, d); });
    Image<Outline> outlines = find_outlines(view, hits, {});
    for (int y = 1; y < height - 1; ++y) {
        for (int x = 1; x < width - 1; ++x) {
            EXPECT_EQ(outlines(x, y) != Outline::none, x == 19 || x == 20) << x << ' ' << y;
        }
    }
    hits = hits_at(view, [&](const glm::dvec3& d, int, int) { return plane(2.0, d); });
    hits(10, 10).instance = 1;
    hits(30, 20).instance = no_index;
    outlines = find_outlines(view, hits, {});
    EXPECT_EQ(count(outlines, Outline::still), 18);
    EXPECT_EQ(outlines(11, 9), Outline::still);
    EXPECT_EQ(outlines(29, 21), Outline::still);
}

TEST(Outlines, ACreaseOfARightAngleIsFound) {
    const CameraView view = test_view();
    const glm::dvec3 left = glm::normalize(glm::dvec3(1, 0, 1)), right = glm::normalize(glm::dvec3(-1, 0, 1));
    const auto hits = hits_at(
        view, [&](const glm::dvec3& d, int, int) { return 2.0 / std::max(glm::dot(-d, left), glm::dot(-d, right)); });
    const Image<Outline> outlines = find_outlines(view, hits, {});
    for (int y = 1; y < height - 1; ++y) {
        EXPECT_TRUE(outlines(19, y) == Outline::still || outlines(20, y) == Outline::still);
        EXPECT_EQ(outlines(5, y), Outline::none);
    }
}

TEST(Outlines, WhatMovesDifferentlyIsTold) {
    const CameraView view = test_view();
    auto hits = hits_at(view, [](const glm::dvec3& d, int, int) { return 2.0 / -d.z; });
    MotionField motion{Image<glm::dvec2>(width, height, glm::dvec2(3.0, 0.0)), {}, {}};
    for (int y = 0; y < height; ++y) {
        for (int x = 20; x < width; ++x) hits(x, y).instance = 1;
    }
    EXPECT_EQ(find_outlines(view, hits, motion)(20, 15), Outline::still);
    for (int y = 0; y < height; ++y) {
        for (int x = 20; x < width; ++x) motion.displacement(x, y) = {3.0, 0.6};
    }
    EXPECT_EQ(find_outlines(view, hits, motion)(20, 15), Outline::moving);
    EXPECT_EQ(find_outlines(view, hits, motion)(19, 15), Outline::moving);
    EXPECT_EQ(find_outlines(view, hits, motion)(22, 15), Outline::none);
}

TEST(Outlines, SmallObjectsAreMarkedUnlessTheyAreHidden) {
    // Off centre, in a corner, behind a wall, too large, and behind the camera.
    const CameraView view = test_view();
    const double pixel = 100.0 / view.pixels_per_unit;
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    const auto place = [&](double x, double y, double z) {
        return view.position + view.axes * glm::dvec3((x - 20.0) * pixel, (15.0 - y) * pixel, z);
    };
    add_mesh(scene, make_quad(0.4 * pixel, 0.4 * pixel, grey), place(10.2, 20.7, -100.0));
    add_mesh(scene, make_quad(0.4 * pixel, 0.4 * pixel, grey), place(0.3, 0.3, -100.0));
    add_mesh(scene, make_quad(0.4 * pixel, 0.4 * pixel, grey), place(30.5, 22.5, -100.0));
    add_mesh(scene, make_quad(4.0 * pixel, 4.0 * pixel, grey), place(30.0, 10.0, -100.0));
    add_mesh(scene, make_quad(0.4 * pixel, 0.4 * pixel, grey), place(25.0, 5.0, 100.0));
    add_camera(scene, view.position, view.position - view.axes[2]);
    const Stage stage(scene, width, height);
    Image<Outline> outlines(width, height, Outline::none);
    outlines(10, 20) = Outline::moving;
    Image<Hit> hits(width, height);
    for (int y = 18; y < height; ++y) {
        for (int x = 25; x < width; ++x) hits(x, y) = {.instance = 9, .distance = 50.0f};
    }
    hits(10, 20) = {.instance = 9, .distance = 50.0f};  // those around it show nothing
    mark_small_objects(outlines, view, hits, stage.shading);
    for (const auto [x, y] : all_pixels(width, height)) {
        const bool near = (std::abs(x - 10) <= 1 && std::abs(y - 20) <= 1) || (x <= 1 && y <= 1);
        EXPECT_EQ(outlines(x, y), near ? Outline::small : Outline::none) << x << ' ' << y;
    }
}

TEST(Outlines, ContrastsBeyondHalfOfWhatIsToleratedAreMarked) {
    Image<Outline> outlines(5, 3, Outline::none);
    outlines(0, 0) = Outline::moving;
    Image<Rgb> estimate(5, 3, Rgb(0.2f));
    estimate(2, 1) = Rgb(0.3f);
    const Image<float> threshold(5, 3, 10.0f);
    Image<Outline> same = outlines;
    mark_contrasts(same, estimate, threshold, 0.021);  // half of it is .105
    EXPECT_EQ(count(same, Outline::none), 14);
    mark_contrasts(outlines, estimate, threshold, 0.019);
    EXPECT_EQ(count(outlines, Outline::still), 9);
    EXPECT_EQ(outlines(0, 0), Outline::moving);
    EXPECT_EQ(outlines(0, 1), Outline::none);
}

TEST(Outlines, ContrastsOfManyTimesWhatIsToleratedAreStrong) {
    Image<Outline> outlines(6, 3, Outline::none);
    outlines(1, 1) = Outline::still;
    outlines(2, 1) = Outline::moving;
    outlines(3, 1) = Outline::small;
    Image<Rgb> estimate(6, 3, Rgb(0.0f));
    estimate(2, 1) = Rgb(1.0f);
    const Image<float> threshold(6, 3, 10.0f);
    Image<Outline> weak = outlines;
    mark_contrasts(weak, estimate, threshold, 0.013);  // eight times as much is 1.04
    EXPECT_EQ(count(weak, Outline::strong), 0);
    mark_contrasts(outlines, estimate, threshold, 0.012);
    EXPECT_EQ(count(outlines, Outline::strong), 7);
    EXPECT_EQ(outlines(1, 1), Outline::strong);
    EXPECT_EQ(outlines(2, 1), Outline::moving);
    EXPECT_EQ(outlines(3, 1), Outline::small);
    EXPECT_EQ(outlines(4, 1), Outline::none);
}

}  // namespace
}  // namespace aleph
