// Tori and lathes: analytic values, sharp edges where the profile has them, finite numbers for any profile.

#include "engine/surface/revolved.h"
#include "tests/engine/surface/shape_cases.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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

// Points of a half circle: the spline is nearly a sphere, and round at both poles.
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

TEST(Shapes, FreeEndsOfALatheDoNotBend) {
    // Distances of 1: the tangent at the middle point is the mean of both chords. The second derivative is 0 at the
    // ends.
    const auto outline = make_outline(make_lathe({{1.0, 0.0}, {1.0, 1.0}, {2.0, 1.0}}, true));
    ASSERT_EQ(outline.size(), 1u);
    const OutlineStrip& strip = outline[0];
    ASSERT_EQ(strip.size(), 17u);  // turns by 56 degrees in each half, of 360 in 48
    const glm::dvec2 middle(0.5, 0.5), first(-0.25, 1.25), last(1.25, -0.25);
    for (std::size_t i = 0; i <= 16; ++i) {
        const double s = static_cast<double>(i % 8) / 8.0, r = 1.0 - s;
        const glm::dvec2 from = i < 8 ? glm::dvec2(1.0, 0.0) : glm::dvec2(1.0, 1.0);
        const glm::dvec2 to = i < 8 ? glm::dvec2(1.0, 1.0) : glm::dvec2(2.0, 1.0);
        const glm::dvec2 from_tangent = i < 8 ? first : middle, to_tangent = i < 8 ? middle : last;
        glm::dvec2 point = from * (r * r * (1.0 + 2.0 * s)) + to * (s * s * (3.0 - 2.0 * s)) +
                           from_tangent * (s * r * r) - to_tangent * (s * s * r);
        glm::dvec2 slope =
            6.0 * s * r * (to - from) + (1.0 - s) * (1.0 - 3.0 * s) * from_tangent + s * (3.0 * s - 2.0) * to_tangent;
        if (i == 16) {
            point = {2.0, 1.0};
            slope = last;
        }
        const bool same_way = strip[0].position == glm::dvec2(1.0, 0.0);
        const std::size_t k = same_way ? i : 16 - i;
        const double side = same_way ? 1.0 : -1.0;
        EXPECT_LT(glm::distance(strip[k].position, point), 1e-12) << i;
        const glm::dvec2 outwards = side * glm::normalize(glm::dvec2(-slope.y, slope.x));
        EXPECT_LT(glm::distance(strip[k].normal, outwards), 1e-12) << i;
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
    for (const double bad : {0.0, -1.0, 0.8, 2.0, not_a_number, infinity}) {
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
        {{not_a_number, 0.0}, {1.0, 1.0}},
        {{1.0, 0.0}, {1.0, infinity}},
        {{1.0, 0.0}, {1e19, 1.0}},
    };
    for (const auto& profile : profiles) EXPECT_THROW(make_shape_mesh(make_lathe(profile, true)), InputError);
}

// Points that turn back, touch the axis, or nearly coincide still give finite unit normals.
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

}  // namespace
}  // namespace aleph
