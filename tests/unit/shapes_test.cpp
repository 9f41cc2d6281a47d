// Shapes: closed, outward, analytic normals, upright images.

#include "engine/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <numbers>
#include <tuple>

#include "engine/base/errors.h"

namespace aleph {
namespace {

Shape make_shape(Shape::Kind kind, int segments = 48) {
    Shape shape;
    shape.kind = kind;
    shape.segments = segments;
    shape.size = {1.5, 0.75, 3.0};
    shape.radius = 0.8;
    shape.height = 2.5;
    return shape;
}

Shape make_torus(int segments = 48) {
    Shape shape = make_shape(Shape::Kind::torus, segments);
    shape.tube_radius = 0.3;
    return shape;
}

Shape make_lathe(const std::vector<glm::dvec2>& profile, bool smooth, int segments = 48) {
    Shape shape = make_shape(Shape::Kind::lathe, segments);
    shape.profile = profile;
    shape.smooth = smooth;
    return shape;
}

const std::vector<glm::dvec2> cone = {{0.0, 1.0}, {0.5, 0.0}, {0.0, 0.0}};
const std::vector<glm::dvec2> ring = {{0.5, 0.0}, {0.75, 0.25}, {0.5, 0.5}, {0.25, 0.25}, {0.5, 0.0}};
const std::vector<glm::dvec2> vase = {{0.0, 0.0}, {0.3, 0.0},  {0.3, 0.0},  {0.5, 0.4}, {0.2, 0.9}, {0.3, 1.0},
                                      {0.3, 1.0}, {0.27, 1.0}, {0.17, 0.9}, {0.4, 0.4}, {0.0, 0.05}};

std::vector<Shape> all_lathes() {
    std::vector<Shape> shapes;
    for (const int segments : {3, 5, 48}) {
        for (const bool smooth : {false, true}) {
            for (const auto& profile : {cone, ring, vase}) shapes.push_back(make_lathe(profile, smooth, segments));
        }
    }
    return shapes;
}

std::vector<Shape> all_shapes() {
    std::vector<Shape> shapes = {make_shape(Shape::Kind::quad), make_shape(Shape::Kind::box)};
    for (const int segments : {3, 4, 5, 7, 48}) {
        shapes.push_back(make_shape(Shape::Kind::sphere, segments));
        shapes.push_back(make_shape(Shape::Kind::cylinder, segments));
        shapes.push_back(make_torus(segments));
    }
    const std::vector<Shape> lathes = all_lathes();
    shapes.insert(shapes.end(), lathes.begin(), lathes.end());
    return shapes;
}

struct Corners {
    std::array<glm::dvec3, 3> position, normal;
    std::array<glm::dvec2, 3> uv;
};

Corners corners(const Mesh& mesh, const glm::uvec3& triangle) {
    Corners out;
    for (int i = 0; i < 3; ++i) {
        out.position[i] = mesh.positions.at(triangle[i]);
        out.normal[i] = mesh.normals.at(triangle[i]);
        out.uv[i] = mesh.uv[0].at(triangle[i]);
    }
    return out;
}

glm::dvec3 area_vector(const Corners& c) {
    return 0.5 * glm::cross(c.position[1] - c.position[0], c.position[2] - c.position[0]);
}

double volume(const Mesh& mesh) {
    double sum = 0.0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        const Corners c = corners(mesh, triangle);
        sum += glm::dot(c.position[0], glm::cross(c.position[1], c.position[2])) / 6.0;
    }
    return sum;
}

TEST(Shapes, ArraysAgreeAndNothingIsDegenerate) {
    for (const Shape& shape : all_shapes()) {
        const Mesh mesh = make_shape_mesh(shape, 7, "name");
        EXPECT_EQ(mesh.name, "name");
        EXPECT_EQ(mesh.material, 7);
        EXPECT_EQ(mesh.shape, shape);
        EXPECT_EQ(mesh.triangles.size(), shape_triangle_count(shape));
        ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
        ASSERT_EQ(mesh.uv[0].size(), mesh.positions.size());
        EXPECT_TRUE(mesh.uv[1].empty());
        for (const glm::uvec3& triangle : mesh.triangles)
            EXPECT_GT(glm::length(area_vector(corners(mesh, triangle))), 1e-5);
    }
}

TEST(Shapes, NormalsAreUnitAndTrianglesCounterClockwiseFromTheirSide) {
    for (const Shape& shape : all_shapes()) {
        const Mesh mesh = make_shape_mesh(shape);
        for (const glm::uvec3& triangle : mesh.triangles) {
            const Corners c = corners(mesh, triangle);
            for (int i = 0; i < 3; ++i) {
                EXPECT_NEAR(glm::length(c.normal[i]), 1.0, 2e-7);
                EXPECT_GE(glm::dot(glm::normalize(area_vector(c)), c.normal[i]), 0.2) << "segments " << shape.segments;
            }
        }
    }
}

// Every edge is used once in each direction, once vertices at one place count as one: no cracks, no doubles.
TEST(Shapes, SolidsAreClosed) {
    using Place = std::tuple<float, float, float>;
    for (const Shape& shape : all_shapes()) {
        if (shape.kind == Shape::Kind::quad) continue;
        const Mesh mesh = make_shape_mesh(shape);
        std::map<std::pair<Place, Place>, int> edges;
        const auto place = [&](std::uint32_t i) {
            const glm::vec3& p = mesh.positions[i];
            return Place(p.x, p.y, p.z);
        };
        for (const glm::uvec3& t : mesh.triangles) {
            for (int i = 0; i < 3; ++i) ++edges[{place(t[i]), place(t[(i + 1) % 3])}];
        }
        for (const auto& [edge, count] : edges) {
            EXPECT_EQ(count, 1);
            const auto opposite = edges.find({edge.second, edge.first});
            EXPECT_TRUE(opposite != edges.end() && opposite->second == 1) << "segments " << shape.segments;
        }
    }
}

TEST(Shapes, VolumesAreThoseOfThePolyhedra) {
    EXPECT_NEAR(volume(make_shape_mesh(make_shape(Shape::Kind::box))), 1.5 * 0.75 * 3.0, 1e-6);
    for (const int n : {3, 4, 5, 48}) {
        const double polygon = 0.5 * n * 0.8 * 0.8 * std::sin(2.0 * std::numbers::pi / n);
        EXPECT_NEAR(volume(make_shape_mesh(make_shape(Shape::Kind::cylinder, n))), polygon * 2.5, 1e-6);
        // Between two parallel n-gons: a frustum of a pyramid, h / 3 (A + B + sqrt(A B)).
        const int rows = std::max(2, n / 2);
        double sphere = 0.0;
        for (int row = 0; row < rows; ++row) {
            const double top = std::numbers::pi * row / rows, bottom = std::numbers::pi * (row + 1) / rows;
            const double a = polygon * std::pow(std::sin(top), 2), b = polygon * std::pow(std::sin(bottom), 2);
            sphere += 0.8 * (std::cos(top) - std::cos(bottom)) / 3.0 * (a + b + std::sqrt(a * b));
        }
        EXPECT_NEAR(volume(make_shape_mesh(make_shape(Shape::Kind::sphere, n))), sphere, 1e-6);
    }
}

TEST(Shapes, SphereVerticesAndNormalsAreAnalytic) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::sphere));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(glm::dvec3(mesh.positions[i])), 0.8, 1e-7);
        EXPECT_LT(glm::length(glm::dvec3(mesh.positions[i]) / 0.8 - glm::dvec3(mesh.normals[i])), 2e-7);
    }
}

TEST(Shapes, SphereImageFacesPlusZAndRunsCounterClockwise) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::sphere));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p = mesh.positions[i];
        const glm::dvec2 uv = mesh.uv[0][i];
        EXPECT_NEAR(uv.y, std::acos(std::clamp(p.y / 0.8, -1.0, 1.0)) / std::numbers::pi, 1e-3);
        if (std::abs(p.y) > 0.79 || std::abs(uv.x - 0.5) > 0.49) continue;  // pole and seam: u is free there
        EXPECT_NEAR(uv.x, 0.5 + std::atan2(p.x, p.z) / (2.0 * std::numbers::pi), 1e-6);
    }
}

// Seen from outside an image is never mirrored: counter-clockwise in space is counter-clockwise in (u, -v).
TEST(Shapes, ImagesAreNotMirrored) {
    for (const Shape& shape : all_shapes()) {
        const Mesh mesh = make_shape_mesh(shape);
        for (const glm::uvec3& triangle : mesh.triangles) {
            const Corners c = corners(mesh, triangle);
            const glm::dvec2 a = c.uv[1] - c.uv[0], b = c.uv[2] - c.uv[0];
            EXPECT_GT(-(a.x * b.y - a.y * b.x), 1e-6) << "segments " << shape.segments;
        }
    }
}

TEST(Shapes, TorusIsAnalytic) {
    const Mesh mesh = make_shape_mesh(make_torus());
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::dvec3 p = mesh.positions[i];
        const glm::dvec3 core = 0.8 * glm::normalize(glm::dvec3(p.x, 0.0, p.z));
        EXPECT_NEAR(glm::distance(p, core), 0.3, 2e-7);
        EXPECT_LT(glm::length((p - core) / 0.3 - glm::dvec3(mesh.normals[i])), 1e-6);
        // The image's middle faces +z on the outer circle, v grows downwards there.
        const glm::dvec2 uv = mesh.uv[0][i];
        if (uv == glm::dvec2(0.5)) {
            EXPECT_LT(glm::distance(p, glm::dvec3(0.0, 0.0, 1.1)), 1e-6);
        }
        if (uv.y > 0.3 && uv.y < 0.7) {
            EXPECT_EQ(p.y > 1e-6, uv.y < 0.499);
        }
    }
    // Pappus, for polygons: area of the section times the way of its centre, scaled to the polygon around.
    const double section = 0.5 * 24 * 0.3 * 0.3 * std::sin(2.0 * std::numbers::pi / 24);
    EXPECT_NEAR(volume(mesh), section * 0.8 * 48 * std::sin(2.0 * std::numbers::pi / 48), 1e-5);
}

TEST(Shapes, StraightLatheIsMadeOfCones) {
    const Mesh mesh = make_shape_mesh(make_lathe(cone, false));
    EXPECT_EQ(mesh.triangles.size(), 2u * 48u);
    const double polygon = 0.5 * 48 * std::sin(2.0 * std::numbers::pi / 48);
    EXPECT_NEAR(volume(mesh), polygon * 0.25 / 3.0, 1e-7);
    for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
        const double y = mesh.normals[i].y;
        EXPECT_TRUE(std::abs(y - 1.0 / std::sqrt(5.0)) < 1e-6 || y == -1.0) << y;
    }
    // v by the length of the outline: sqrt(1.25) of sqrt(1.25) + 0.5 is the cone.
    const double edge = std::sqrt(1.25) / (std::sqrt(1.25) + 0.5);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const double v = mesh.uv[0][i].y, r = std::hypot(mesh.positions[i].x, mesh.positions[i].z);
        EXPECT_NEAR(v, mesh.positions[i].y > 0.5f ? 0.0 : r > 0.25 ? edge : 1.0, 1e-6);
    }
}

TEST(Shapes, LatheIsTheSameWhicheverWayItsProfileIsListed) {
    for (const Shape& shape : all_lathes()) {
        Shape reversed = shape;
        std::reverse(reversed.profile.begin(), reversed.profile.end());
        Mesh mesh = make_shape_mesh(reversed);
        mesh.shape = shape;
        const Mesh straight = make_shape_mesh(shape);
        EXPECT_EQ(mesh.triangles, straight.triangles);
        ASSERT_EQ(mesh.positions.size(), straight.positions.size());
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            EXPECT_LT(glm::distance(mesh.positions[i], straight.positions[i]), 1e-6f);
            EXPECT_LT(glm::distance(mesh.normals[i], straight.normals[i]), 1e-6f);
        }
        EXPECT_GT(volume(straight), 0.0);
    }
}

TEST(Shapes, FlatLatheFacesUp) {
    const std::vector<std::vector<glm::dvec2>> flat = {{{0.2, 1.0}, {0.6, 1.0}}, {{0.6, 1.0}, {0.0, 1.0}}};
    for (const auto& profile : flat) {
        const Mesh mesh = make_shape_mesh(make_lathe(profile, true));
        for (const glm::vec3& normal : mesh.normals) EXPECT_EQ(normal, glm::vec3(0.0f, 1.0f, 0.0f));
    }
}

// Points of a half circle: the spline is a sphere within what so few points can say, round at both poles.
TEST(Shapes, SmoothLatheFollowsACircle) {
    std::vector<glm::dvec2> points;
    for (int i = 0; i <= 8; ++i) {
        const double angle = std::numbers::pi * i / 8;
        points.emplace_back(i == 0 || i == 8 ? 0.0 : std::sin(angle), std::cos(angle));
    }
    const Mesh mesh = make_shape_mesh(make_lathe(points, true));
    EXPECT_GE(mesh.triangles.size(), 48u * 2u * 23u);
    EXPECT_LE(mesh.triangles.size(), 48u * 2u * 32u);
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        EXPECT_NEAR(glm::length(mesh.positions[i]), 1.0, 2e-3);
        EXPECT_GT(glm::dot(glm::normalize(mesh.positions[i]), mesh.normals[i]), 0.9995) << i;
        EXPECT_NEAR(mesh.uv[0][i].y, std::acos(std::clamp(mesh.positions[i].y, -1.0f, 1.0f)) / std::numbers::pi, 5e-3);
    }
}

TEST(Shapes, RepeatedPointsOfALatheAreEdges) {
    const auto normals_at = [](const Mesh& mesh, double r, double y) {
        std::vector<float> slopes;
        for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
            const glm::dvec3 p = mesh.positions[i];
            if (std::abs(std::hypot(p.x, p.z) - r) < 1e-6 && std::abs(p.y - y) < 1e-6) {
                slopes.push_back(mesh.normals[i].y);
            }
        }
        std::sort(slopes.begin(), slopes.end());
        return slopes;
    };
    const std::vector<glm::dvec2> soft = {{0.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}};
    const std::vector<glm::dvec2> edged = {{0.0, 1.0}, {1.0, 1.0}, {1.0, 1.0}, {1.0, 0.0}};
    const auto smooth = normals_at(make_shape_mesh(make_lathe(soft, true)), 1.0, 1.0);
    EXPECT_NEAR(smooth.front(), std::sqrt(0.5), 1e-6);
    EXPECT_NEAR(smooth.back(), smooth.front(), 1e-6);
    const auto sharp = normals_at(make_shape_mesh(make_lathe(edged, true)), 1.0, 1.0);
    EXPECT_NEAR(sharp.front(), 0.0, 1e-6);
    EXPECT_NEAR(sharp.back(), 1.0, 1e-6);
    // A tip: the axis point repeated.
    const std::vector<glm::dvec2> round = {{0.0, 1.0}, {0.5, 0.5}, {1.0, 0.0}};
    const std::vector<glm::dvec2> tip = {{0.0, 1.0}, {0.0, 1.0}, {0.5, 0.5}, {1.0, 0.0}};
    EXPECT_EQ(normals_at(make_shape_mesh(make_lathe(round, true)), 0.0, 1.0).front(), 1.0f);
    EXPECT_NEAR(normals_at(make_shape_mesh(make_lathe(tip, true)), 0.0, 1.0).front(), std::sqrt(0.5), 1e-3);
}

TEST(Shapes, BadToriAndLathesAreRefused) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -1.0, 0.8, 2.0, nan, inf}) {
        Shape torus = make_torus();
        torus.tube_radius = bad;
        EXPECT_THROW(make_shape_mesh(torus), InputError) << bad;
    }
    const std::vector<std::vector<glm::dvec2>> profiles = {
        {},
        {{1.0, 0.0}},
        {{1.0, 0.0}, {1.0, 0.0}},
        {{0.0, 0.0}, {0.0, 1.0}},
        {{-0.1, 0.0}, {1.0, 1.0}},
        {{nan, 0.0}, {1.0, 1.0}},
        {{1.0, 0.0}, {1.0, inf}},
        {{1.0, 0.0}, {1e19, 1.0}},
    };
    for (const auto& profile : profiles) EXPECT_THROW(make_shape_mesh(make_lathe(profile, true)), InputError);
}

// Points that turn back, touch the axis, or lie absurdly near each other still give finite unit normals.
TEST(Shapes, AwkwardLathesStayFinite) {
    const std::vector<std::vector<glm::dvec2>> profiles = {
        {{1.0, 0.0}, {1.0, 1.0}, {1.0, 0.0}},
        {{0.0, 0.0}, {1.0, 0.5}, {0.0, 1.0}, {1.0, 1.5}, {0.0, 2.0}},
        {{0.0, 0.0}, {0.0, 1.0}, {1.0, 1.0}, {0.0, 3.0}, {0.0, 4.0}},
        {{1.0, 0.0}, {1.0 + 1e-13, 0.0}, {1.0, 1e-200}, {2.0, 1.0}},
        {{1e18, 0.0}, {1e-18, 1e18}},
        {{0.0, 0.0}, {1e-18, 1e-18}},
    };
    for (const auto& profile : profiles) {
        for (const bool smooth : {false, true}) {
            const Shape shape = make_lathe(profile, smooth, 8);
            const Mesh mesh = make_shape_mesh(shape);
            EXPECT_EQ(mesh.triangles.size(), shape_triangle_count(shape));
            for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
                EXPECT_TRUE(std::isfinite(glm::length(glm::dvec3(mesh.positions[i]))));
                EXPECT_NEAR(glm::length(glm::dvec3(mesh.normals[i])), 1.0, 1e-6);
            }
        }
    }
}

TEST(Shapes, QuadFacesPlusZWithItsImageUpright) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::quad));
    ASSERT_EQ(mesh.positions.size(), 4u);
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_EQ(mesh.normals[i], glm::vec3(0.0f, 0.0f, 1.0f));
        const glm::vec2 uv = mesh.uv[0][i];
        EXPECT_EQ(mesh.positions[i], glm::vec3(1.5f * (uv.x - 0.5f), 0.75f * (0.5f - uv.y), 0.0f));
    }
}

TEST(Shapes, BoxSidesHaveTheirImagesUpright) {
    const Mesh mesh = make_shape_mesh(make_shape(Shape::Kind::box));
    ASSERT_EQ(mesh.positions.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
        if (mesh.normals[i].y == 0.0f) {
            EXPECT_EQ(mesh.uv[0][i].y, mesh.positions[i].y > 0.0f ? 0.0f : 1.0f);
        } else {
            EXPECT_EQ(mesh.uv[0][i].y, mesh.positions[i].z * mesh.normals[i].y > 0.0f ? 1.0f : 0.0f);
        }
    }
}

TEST(Shapes, TextureRepeats) {
    Shape shape = make_shape(Shape::Kind::quad);
    shape.uv_scale = {4.0, 0.5};
    const Mesh mesh = make_shape_mesh(shape);
    EXPECT_EQ(mesh.uv[0][2], glm::vec2(4.0f, 0.5f));
}

TEST(Shapes, LargestAndSmallestSegmentsAreTaken) {
    EXPECT_EQ(make_shape_mesh(make_shape(Shape::Kind::cylinder, 4096)).triangles.size(), 4u * 4096u);
    EXPECT_EQ(make_shape_mesh(make_shape(Shape::Kind::sphere, 3)).triangles.size(), 6u);
}

TEST(Shapes, SizesAreChecked) {
    const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
    for (const double bad : {0.0, -0.0, -1.0, 5e-324, inf, -inf, nan, 1e19}) {
        Shape quad = make_shape(Shape::Kind::quad), box = make_shape(Shape::Kind::box);
        Shape sphere = make_shape(Shape::Kind::sphere), cylinder = make_shape(Shape::Kind::cylinder);
        quad.size.y = bad;
        box.size.z = bad;
        sphere.radius = bad;
        cylinder.height = bad;
        for (const Shape& shape : {quad, box, sphere, cylinder})
            EXPECT_THROW(make_shape_mesh(shape), InputError) << bad;
    }
    for (const double bad : {inf, nan}) {
        Shape quad = make_shape(Shape::Kind::quad);
        quad.uv_scale.x = bad;
        EXPECT_THROW(make_shape_mesh(quad), InputError);
    }
    for (const int segments : {-1, 0, 2, 4097, std::numeric_limits<int>::max()}) {
        EXPECT_THROW(make_shape_mesh(make_shape(Shape::Kind::sphere, segments)), InputError);
        EXPECT_THROW(make_shape_mesh(make_shape(Shape::Kind::cylinder, segments)), InputError);
    }
    try {
        validate(make_shape(Shape::Kind::sphere, 2), "a.json", "/nodes/0/shape");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_EQ(error.file(), "a.json");
        EXPECT_EQ(error.place(), "/nodes/0/shape");
    }
}

}  // namespace
}  // namespace aleph
