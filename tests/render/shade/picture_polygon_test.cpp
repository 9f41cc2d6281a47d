// Triangles in the picture: what the camera's plane and a square leave of them, and places on them.

#include "render/shade/picture_polygon.h"

#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

PicturePolygon make_polygon(std::initializer_list<glm::dvec2> corners) {
    PicturePolygon polygon;
    for (const glm::dvec2& corner : corners) polygon.add(corner);
    return polygon;
}

CameraView look_down_z() {
    return make_camera_view(CameraValues{.fov = 0.8}, 40, 30);
}

TEST(PicturePolygon, RectanglesLeaveThePartWithin) {
    // Legs of 4 from the origin; the square from .5 to 2.5 has one corner beyond x + y = 4.
    const PicturePolygon triangle = make_polygon({{0.0, 0.0}, {4.0, 0.0}, {0.0, 4.0}});
    const auto area_within = [&](const glm::dvec2& low, const glm::dvec2& high) {
        return area_of(clip_to_rectangle(triangle, low, high));
    };
    EXPECT_EQ(area_of(triangle), 8.0);
    EXPECT_NEAR(area_within({0.5, 0.5}, {2.5, 2.5}), 4.0 - 0.5, 1e-12);
    EXPECT_EQ(clip_to_rectangle(triangle, {0.5, 0.5}, {2.5, 2.5}).count, 5);
    EXPECT_NEAR(area_within({0.5, 0.5}, {1.5, 1.0}), 0.5, 1e-12);
    EXPECT_NEAR(area_within({-100.0, -100.0}, {100.0, 100.0}), 8.0, 1e-12);
    EXPECT_EQ(area_within({3.0, 3.0}, {5.0, 5.0}), 0.0);
    const PicturePolygon line = make_polygon({{0.0, 0.0}, {0.0, 0.0}, {3.0, 1.0}});
    EXPECT_NEAR(area_of(clip_to_rectangle(line, {0.0, 0.0}, {2.0, 2.0})), 0.0, 1e-15);
}

TEST(PicturePolygon, PlacesAreEvenOverIt) {
    const PicturePolygon triangle = make_polygon({{0.0, 0.0}, {4.0, 0.0}, {0.0, 4.0}});
    const PicturePolygon part = clip_to_rectangle(triangle, {0.5, 0.5}, {2.5, 2.5});
    constexpr int steps = 1000;
    glm::dvec2 mean(0.0);
    int beyond = 0;
    for (int i = 0; i < steps * steps; ++i) {
        const glm::dvec2 at = sample_polygon(part, {(i % steps + 0.5) / steps, (i / steps + 0.5) / steps});
        mean += at / static_cast<double>(steps * steps);
        beyond += at.x + at.y > 3.5 ? 1 : 0;
        ASSERT_TRUE(std::min(at.x, at.y) >= 0.5 && std::max(at.x, at.y) <= 2.5 && at.x + at.y <= 4.0 + 1e-9);
    }
    // A square without a corner whose centroid is a third of its legs from (2.5, 2.5).
    const double expected = (4.0 * 1.5 - 0.5 * (2.5 - 1.0 / 3.0)) / 3.5;
    EXPECT_NEAR(mean.x, expected, 2e-3);
    EXPECT_NEAR(mean.y, expected, 2e-3);
    EXPECT_NEAR(beyond / static_cast<double>(steps * steps), (0.5 * 1.5 * 1.5 - 0.5) / 3.5, 2e-3);
}

TEST(PicturePolygon, OutlinesAreTheLeastOctagon) {
    PictureOutline outline;
    EXPECT_EQ(outline.polygon().count, 0);
    outline.add(make_polygon({{0.0, 0.0}, {3.0, 0.0}, {3.0, 2.0}, {0.0, 2.0}}));
    EXPECT_NEAR(area_of(outline.polygon()), 6.0, 1e-12);
    // A corner on the right of it: sides of 45 degrees from it to those above and below.
    outline.add(make_polygon({{4.0, 1.0}}));
    EXPECT_NEAR(area_of(outline.polygon()), 6.0 + 1.0, 1e-12);
    outline.add(make_polygon({{3.0, 3.0}}));
    EXPECT_NEAR(area_of(outline.polygon()), 12.0 - 3.0 * 0.5, 1e-12);
    PictureOutline circle;
    for (int i = 0; i < 64; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / 64.0;
        circle.add(make_polygon({{std::cos(angle), std::sin(angle)}}));
    }
    const PicturePolygon around = circle.polygon();
    EXPECT_NEAR(area_of(around), 8.0 * std::tan(std::numbers::pi / 8.0), 1e-12);
    EXPECT_EQ(around.count, 8);
    // Within a square each of its four sides takes the place of one of the octagon's.
    const PicturePolygon cut = clip_to_rectangle(around, glm::dvec2(-0.8), glm::dvec2(0.8));
    EXPECT_EQ(cut.count, 8);
    EXPECT_NEAR(area_of(cut), 4.0 * 0.64 - 2.0 * std::pow(1.6 - std::numbers::sqrt2, 2.0), 1e-12);
}

TEST(PicturePolygon, TheCamerasPlaneCutsTriangles) {
    const CameraView view = look_down_z();
    const auto count = [&](double a, double b, double c) {
        return project_triangle(view, {glm::dvec3(-1.0, 0.0, a), glm::dvec3(1.0, 0.0, b), glm::dvec3(0.0, 1.0, c)})
            .count;
    };
    EXPECT_EQ(count(-2.0, -2.0, -2.0), 3);
    EXPECT_EQ(count(2.0, -2.0, -2.0), 4);
    EXPECT_EQ(count(2.0, 2.0, -2.0), 3);
    EXPECT_EQ(count(2.0, 2.0, 2.0), 0);
    const PicturePolygon whole =
        project_triangle(view, {glm::dvec3(-1.0, 0.0, -2.0), glm::dvec3(1.0, 0.0, -2.0), glm::dvec3(0.0, 1.0, -2.0)});
    EXPECT_NEAR(area_of(whole), std::pow(view.pixels_per_unit / 2.0, 2.0), 1e-9);
}

TEST(PicturePolygon, TrianglesNearerThanTheNearPlaneAreWhole) {
    // Rays start at the camera: they meet what is nearer, too.
    for (const bool orthographic : {false, true}) {
        CameraView view = look_down_z();
        view.orthographic = orthographic;
        const std::array corners{glm::dvec3(-0.1, 0.0, -0.3), glm::dvec3(0.1, 0.0, -0.3), glm::dvec3(0.0, 1.0, -2.0)};
        const auto measure = [&](double near_plane) {
            view.near_plane = near_plane;
            return area_of(project_triangle(view, corners));
        };
        const double height = view.pixels_per_unit * (orthographic ? 1.0 : 0.5);
        const double base = view.pixels_per_unit * 0.2 / (orthographic ? 1.0 : 0.3);
        for (const double near_plane : {1e-4, 0.25, 0.5, 5.0})
            EXPECT_NEAR(measure(near_plane), 0.5 * base * height, 1e-9) << near_plane << orthographic;
    }
}

}  // namespace
}  // namespace aleph
