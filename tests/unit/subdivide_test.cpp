// Subdivision surfaces against closed forms: B-splines, limit masks, explicit subdivision.
#include "engine/subdivide.h"

#include <gtest/gtest.h>

#include <array>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>
#include <set>

#include "engine/base/errors.h"
#include "tests/unit/subdivision_cages.h"
#include "tests/unit/subdivision_reference.h"

namespace aleph {
namespace {

struct Vertices {
    std::vector<glm::dvec3> positions;
    std::vector<glm::vec3> normals;
};

Vertices vertices_of(const LimitSurface& surface, const std::vector<glm::dvec3>& points, int part = 0) {
    Vertices vertices;
    surface.evaluate_vertices(part, surface.make_control_points(points), vertices.positions, vertices.normals);
    return vertices;
}

/// The limit point at (s, t) of drawn face f of a cage of quads, through a surface of level 0.
glm::dvec3 limit_at(const LimitSurface& surface, const std::vector<glm::dvec3>& control, int f, double s, double t) {
    return s >= t ? surface.evaluate(0, control, 2 * f, s - t, t) : surface.evaluate(0, control, 2 * f + 1, s, t - s);
}

/// Largest distance of a reference point to the nearest vertex, and the other way round.
double distance_between(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double worst = 0.0;
    const auto one_way = [&](const auto& from, const auto& to) {
        for (const glm::dvec3& p : from) {
            double nearest = std::numeric_limits<double>::infinity();
            for (const glm::dvec3& q : to) nearest = std::min(nearest, glm::length(p - q));
            worst = std::max(worst, nearest);
        }
    };
    one_way(a, b);
    one_way(b, a);
    return worst;
}

/// Largest error of a surface's vertices at a level against explicit subdivision and the limits' closed forms.
double error_against_reference(const TestCage& from, int level) {
    ReferenceMesh mesh = make_reference(from);
    const bool loop = from.cage.scheme == Cage::Scheme::loop;
    // Until every semi-sharp edge is smooth, and its quads are the level's.
    for (int i = 0; i < level; ++i) mesh = loop ? subdivide_loop(mesh) : subdivide_catmull_clark(mesh);
    const std::size_t count = mesh.points.size();
    const bool semi_sharp = [&] {
        for (const auto& [edge, sharpness] : mesh.creases) {
            if (sharpness < reference_infinite) return true;
        }
        return std::any_of(mesh.corners.begin(), mesh.corners.end(),
                           [](const auto& corner) { return corner.second < reference_infinite; });
    }();
    EXPECT_FALSE(semi_sharp) << "the test's level is too low";
    std::vector<glm::dvec3> limits = reference_limits(mesh, loop);
    const LimitSurface surface(from.cage, from.points.size(), level);
    const Vertices vertices = vertices_of(surface, from.points);
    std::vector<glm::dvec3> distinct;  // sharp edges have a vertex per side
    std::set<std::array<double, 3>> seen;
    for (const glm::dvec3& p : vertices.positions) {
        if (seen.insert({p.x, p.y, p.z}).second) distinct.push_back(p);
    }
    EXPECT_EQ(distinct.size(), count);
    return distance_between(distinct, limits);
}

std::array<double, 4> bspline(double t) {
    const double r = 1.0 - t;
    return {r * r * r / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
            (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) / 6.0, t * t * t / 6.0};
}
std::array<double, 4> bspline_slope(double t) {
    const double r = 1.0 - t;
    return {-r * r / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, (-3.0 * t * t + 2.0 * t + 1.0) / 2.0, t * t / 2.0};
}

/// Tensor product over 4 x 4 points.
glm::dvec3 tensor(const std::vector<glm::dvec3>& points, const std::array<double, 4>& wx,
                  const std::array<double, 4>& wy) {
    glm::dvec3 sum(0.0);
    for (std::size_t y = 0; y < 4; ++y) {
        for (std::size_t x = 0; x < 4; ++x) sum += wx[x] * wy[y] * points[y * 4 + x];
    }
    return sum;
}

TestCage make_bspline_cage() {
    TestCage result = make_grid_cage(4, 4);
    result.cage.boundary = Cage::Boundary::none;
    return result;
}

TEST(LimitSurface, RegularFaceIsABicubicBSpline) {
    const TestCage test = make_bspline_cage();
    const LimitSurface surface(test.cage, test.points.size(), 0);
    ASSERT_EQ(surface.triangle_count(0), 2u);  // without boundary rule the outer faces have no surface
    const auto control = surface.make_control_points(test.points);
    for (int i = 0; i <= 20; ++i) {
        for (int j = 0; j <= 20; ++j) {
            const double s = i / 20.0, t = j / 20.0;
            const glm::dvec3 expected = tensor(test.points, bspline(s), bspline(t));
            EXPECT_LT(glm::length(limit_at(surface, control, 0, s, t) - expected), 1e-14);
        }
    }
}

TEST(LimitSurface, RegularFaceHasTheSplinesNormals) {
    const TestCage test = make_bspline_cage();
    const LimitSurface surface(test.cage, test.points.size(), 3);
    const Vertices vertices = vertices_of(surface, test.points);
    ASSERT_EQ(vertices.positions.size(), 81u);
    int checked = 0;
    for (int i = 0; i <= 8; ++i) {
        for (int j = 0; j <= 8; ++j) {
            const double s = i / 8.0, t = j / 8.0;
            const glm::dvec3 p = tensor(test.points, bspline(s), bspline(t));
            const glm::dvec3 n = glm::normalize(glm::cross(tensor(test.points, bspline_slope(s), bspline(t)),
                                                           tensor(test.points, bspline(s), bspline_slope(t))));
            for (std::size_t k = 0; k < vertices.positions.size(); ++k) {
                if (glm::length(vertices.positions[k] - p) > 1e-13) continue;
                EXPECT_LT(glm::length(glm::dvec3(vertices.normals[k]) - n), 1.5e-7);  // floats
                ++checked;
            }
        }
    }
    EXPECT_EQ(checked, 81);
}

TEST(LimitSurface, CornerOfACubeEndsWhereTheMaskSays) {
    const TestCage test = make_cube_cage();
    const LimitSurface surface(test.cage, 8, 0);
    const Vertices vertices = vertices_of(surface, test.points);
    ASSERT_EQ(vertices.positions.size(), 8u);
    for (std::size_t i = 0; i < 8; ++i) {
        // n^2 v + 4 sum e + sum f over n (n + 5), n = 3: (9 + 4 - 1) / 24 of a half edge.
        EXPECT_NEAR(std::abs(vertices.positions[i].x), 0.5, 1e-15);
        EXPECT_NEAR(std::abs(vertices.positions[i].y), 0.5, 1e-15);
        EXPECT_NEAR(std::abs(vertices.positions[i].z), 0.5, 1e-15);
        const glm::dvec3 out = glm::normalize(vertices.positions[i]);
        EXPECT_LT(glm::length(glm::dvec3(vertices.normals[i]) - out), 1e-7);
    }
}

TEST(LimitSurface, AgreesWithExplicitSubdivision) {
    // The patches about extraordinary points are approximations at depth 7: the points on the level's grid that lie
    // within them are off by that; all others to rounding.
    EXPECT_LT(error_against_reference(make_cube_cage(), 1), 1e-14);
    EXPECT_LT(error_against_reference(make_cube_cage(), 4), 1e-14);
    EXPECT_LT(error_against_reference(make_prism_cage(), 1), 1e-14);
    EXPECT_LT(error_against_reference(make_prism_cage(), 3), 1e-14);
    EXPECT_LT(error_against_reference(make_icosahedron_cage(Cage::Scheme::catmull_clark), 3), 1e-14);
    EXPECT_LT(error_against_reference(make_grid_cage(5, 4), 3), 1e-14);  // boundaries are sharp
}

TEST(LimitSurface, LoopAgreesWithExplicitSubdivision) {
    EXPECT_LT(error_against_reference(make_icosahedron_cage(Cage::Scheme::loop), 0), 1e-14);
    EXPECT_LT(error_against_reference(make_icosahedron_cage(Cage::Scheme::loop), 3), 1e-14);

    TestCage torus = make_cage({}, {}, Cage::Scheme::loop);  // every point has 6 neighbours: a box spline
    constexpr int n = 6, m = 5;
    for (int j = 0; j < m; ++j) {
        for (int i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * i / n, b = 2.0 * std::numbers::pi * j / m;
            torus.points.emplace_back((3.0 + std::cos(b)) * std::cos(a), (3.0 + std::cos(b)) * std::sin(a),
                                      std::sin(b));
            const int right = (i + 1) % n, up = (j + 1) % m;
            for (const auto& face : {std::array{j * n + i, j * n + right, up * n + right},
                                     std::array{j * n + i, up * n + right, up * n + i}}) {
                torus.cage.face_sizes.push_back(3);
                torus.cage.face_points.insert(torus.cage.face_points.end(), face.begin(), face.end());
            }
        }
    }
    EXPECT_LT(error_against_reference(torus, 0), 1e-14);
    EXPECT_LT(error_against_reference(torus, 2), 1e-14);
}

TEST(LimitSurface, SemiSharpCreasesAgreeWithExplicitSubdivision) {
    for (const float sharpness : {0.5f, 1.0f, 2.0f, 2.5f}) {
        TestCage test = make_cube_cage();
        add_crease(test.cage, {4, 5, 7, 6, 4}, sharpness);
        EXPECT_LT(error_against_reference(test, 3), 1e-14) << sharpness;
        TestCage loop = make_icosahedron_cage(Cage::Scheme::loop);
        add_crease(loop.cage, {0, 1, 9, 4, 11, 0}, sharpness);
        EXPECT_LT(error_against_reference(loop, 3), 1e-14) << sharpness;
    }
}

TEST(LimitSurface, SharpCreasesAgreeWithExplicitSubdivision) {
    TestCage test = make_cube_cage();
    add_crease(test.cage, {4, 5, 7, 6, 4}, 10.0f);
    EXPECT_LT(error_against_reference(test, 3), 1e-14);
    add_crease(test.cage, {0, 4}, 10.0f);  // three sharp edges meet at point 4
    add_corner(test.cage, 0, 10.0f);       // an edge that ends in a smooth point has no closed form
    EXPECT_LT(error_against_reference(test, 3), 1e-14);
    TestCage corner = make_cube_cage();
    add_corner(corner.cage, 3, 10.0f);
    add_corner(corner.cage, 4, 2.0f);
    EXPECT_LT(error_against_reference(corner, 3), 1e-14);
}

TEST(LimitSurface, InfinitelySharpCreaseIsABSplineCurve) {
    TestCage test = make_grid_cage(6, 5);
    add_crease(test.cage, {12, 13, 14, 15, 16, 17}, 10.0f);  // row 2
    const LimitSurface surface(test.cage, test.points.size(), 0);
    const auto control = surface.make_control_points(test.points);
    for (int column = 1; column <= 3; ++column) {
        for (int i = 0; i <= 10; ++i) {
            const auto w = bspline(i / 10.0);
            glm::dvec3 expected(0.0);
            for (int k = 0; k < 4; ++k) {
                expected += w[static_cast<std::size_t>(k)] * test.points[static_cast<std::size_t>(12 + column - 1 + k)];
            }
            // From the face below and from the one above.
            EXPECT_LT(glm::length(limit_at(surface, control, 5 + column, i / 10.0, 1.0) - expected), 1e-14);
            EXPECT_LT(glm::length(limit_at(surface, control, 10 + column, i / 10.0, 0.0) - expected), 1e-14);
        }
    }
}

TEST(LimitSurface, SharpEdgesHaveANormalPerSide) {
    TestCage test = make_cube_cage();
    add_crease(test.cage, {4, 5, 7, 6, 4}, 10.0f);
    const LimitSurface surface(test.cage, 8, 3);
    const auto control = surface.make_control_points(test.points);
    const Mesh mesh = surface.make_mesh(0, control);
    int pairs = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (mesh.positions[i] != mesh.positions[k]) continue;
            ++pairs;
            EXPECT_LT(glm::dot(mesh.normals[i], mesh.normals[k]), 0.9f);
            EXPECT_NEAR(mesh.positions[i].z, 1.0f, 1e-6f);
        }
    }
    EXPECT_EQ(pairs, 4 * 8);  // the loop's vertices, once each
    const std::size_t smooth = LimitSurface(make_cube_cage().cage, 8, 3).vertex_count(0);
    EXPECT_EQ(smooth, 6u * 64u + 2u);  // V = F + 2: every vertex once
}

TEST(LimitSurface, BilinearFacesKeepTheCage) {
    TestCage test = make_cube_cage();
    test.cage.scheme = Cage::Scheme::bilinear;
    const LimitSurface surface(test.cage, 8, 2);
    const Mesh mesh = surface.make_mesh(0, surface.make_control_points(test.points));
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        const glm::vec3 p = glm::abs(mesh.positions[i]);
        EXPECT_EQ(std::max({p.x, p.y, p.z}), 1.0f);
        const glm::vec3 n = glm::abs(mesh.normals[i]);
        EXPECT_EQ(std::max({n.x, n.y, n.z}), 1.0f);
    }
    TestCage prism = make_prism_cage();
    prism.cage.scheme = Cage::Scheme::bilinear;
    const LimitSurface with_pentagons(prism.cage, 10, 3);
    for (const glm::dvec3& p : vertices_of(with_pentagons, prism.points).positions) {
        EXPECT_TRUE(p.z >= -1e-15 && p.z <= 1.5 + 1e-15);
        EXPECT_LE(glm::length(glm::dvec2(p.x, p.y / 0.8)), 1.0 + 1e-14);
    }
}

TEST(LimitSurface, BoundaryRulesMeetTheirCorners) {
    const auto corner_of = [](Cage::Boundary boundary) {
        TestCage test = make_grid_cage(4, 4);
        test.cage.boundary = boundary;
        const LimitSurface surface(test.cage, test.points.size(), 0);
        return limit_at(surface, surface.make_control_points(test.points), 0, 0.0, 0.0);
    };
    const auto points = make_grid_cage(4, 4).points;
    EXPECT_LT(glm::length(corner_of(Cage::Boundary::edge_and_corner) - points[0]), 1e-15);
    EXPECT_LT(glm::length(corner_of(Cage::Boundary::edge_only) - (4.0 * points[0] + points[1] + points[4]) / 6.0),
              1e-15);
    const glm::dvec3 inner = tensor(points, bspline(0.0), bspline(0.0));  // the middle face is the only one
    EXPECT_LT(glm::length(corner_of(Cage::Boundary::none) - inner), 1e-15);

    // Between its corners the boundary is the spline curve of its points.
    TestCage test = make_grid_cage(5, 4);
    const LimitSurface surface(test.cage, test.points.size(), 0);
    const auto control = surface.make_control_points(test.points);
    const auto w = bspline(0.3);
    const glm::dvec3 expected =
        w[0] * test.points[0] + w[1] * test.points[1] + w[2] * test.points[2] + w[3] * test.points[3];
    EXPECT_LT(glm::length(limit_at(surface, control, 1, 0.3, 0.0) - expected), 1e-15);
}

TEST(LimitSurface, HolesAreAbsentAndChangeNothingElse) {
    TestCage test = make_cube_cage();
    const LimitSurface whole(test.cage, 8, 2);
    test.cage.holes = {2, 5};
    const LimitSurface holed(test.cage, 8, 2);
    EXPECT_EQ(whole.triangle_count(0), 6u * 32u);
    EXPECT_EQ(holed.triangle_count(0), 4u * 32u);
    const auto all = vertices_of(whole, test.points).positions;
    for (const glm::dvec3& p : vertices_of(holed, test.points).positions) {
        double nearest = 1.0;
        for (const glm::dvec3& q : all) nearest = std::min(nearest, glm::length(p - q));
        EXPECT_LT(nearest, 1e-14);
    }
}

TEST(LimitSurface, PartsShareTheirEdgesBitForBit) {
    TestCage test = make_cube_cage();
    test.cage.face_parts = {0, 0, 1, 1, 0, 1};
    const LimitSurface surface(test.cage, 8, 3);
    ASSERT_EQ(surface.part_count(), 2);
    EXPECT_EQ(surface.triangle_count(0), 3u * 128u);
    EXPECT_EQ(surface.triangle_count(1), 3u * 128u);
    const Vertices a = vertices_of(surface, test.points, 0), b = vertices_of(surface, test.points, 1);
    int shared = 0;
    for (std::size_t i = 0; i < a.positions.size(); ++i) {
        for (std::size_t k = 0; k < b.positions.size(); ++k) {
            if (glm::length(a.positions[i] - b.positions[k]) > 1e-12) continue;
            ++shared;
            EXPECT_EQ(a.positions[i], b.positions[k]);
            EXPECT_EQ(a.normals[i], b.normals[k]);
        }
    }
    // Faces -x, +x, -z against -y, +y, +z: x with y, x with +z, -z with y: 8 edges of 7 inner vertices, and all 8
    // corners.
    EXPECT_EQ(shared, 8 * 7 + 8);
}

TEST(LimitSurface, RP16_LimitPointDoesNotDependOnTheLevel) {
    TestCage test = make_cube_cage();
    add_crease(test.cage, {4, 5, 7}, 1.5f);
    const LimitSurface coarse(test.cage, 8, 0);
    const auto control = coarse.make_control_points(test.points);
    for (int level = 1; level <= 6; ++level) {
        const LimitSurface fine(test.cage, 8, level);
        ASSERT_EQ(fine.make_control_points(test.points), control);
        const int n = 1 << level;
        for (int f = 0; f < 6; ++f) {
            for (int j = 0; j < n; j += std::max(1, n / 5)) {
                for (int i = 0; i < n; i += std::max(1, n / 3)) {
                    // Two triangles per cell, cells row by row, faces in order.
                    const int lower = 2 * ((f * n + j) * n + i);
                    const double u = 0.3, v = 0.45;
                    const glm::dvec3 expected = limit_at(coarse, control, f, (i + (u + v)) / n, (j + v) / n);
                    EXPECT_LT(glm::length(fine.evaluate(0, control, lower, u, v) - expected), 2e-15) << level;
                }
            }
        }
    }
}

TEST(LimitSurface, RP16_VerticesLieWhereEvaluateSaysAtEveryLevel) {
    for (TestCage test : {make_cube_cage(), make_prism_cage(), make_icosahedron_cage(Cage::Scheme::loop)}) {
        for (int level = 0; level <= 4; ++level) {
            const LimitSurface surface(test.cage, test.points.size(), level);
            const auto control = surface.make_control_points(test.points);
            const Vertices vertices = vertices_of(surface, test.points);
            const Mesh mesh = surface.make_mesh(0, control);
            for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
                for (int k = 0; k < 3; ++k) {
                    const glm::dvec3 p = surface.evaluate(0, control, static_cast<int>(i), k == 1, k == 2);
                    EXPECT_LT(glm::length(p - vertices.positions[mesh.triangles[i][k]]), 1e-15);
                }
            }
        }
    }
}

TEST(LimitSurface, RP16_ApproximationAboutExtraordinaryPointsIsSmall) {
    // The same limit surface from a cage subdivided twice, whose patches reach two levels deeper.
    for (const TestCage& test : {make_cube_cage(), make_prism_cage()}) {
        ReferenceMesh twice = subdivide_catmull_clark(subdivide_catmull_clark(make_reference(test)));
        const TestCage deeper = make_cage(twice.points, twice.faces);
        const LimitSurface surface(test.cage, test.points.size(), 0), reference(deeper.cage, deeper.points.size(), 0);
        const auto control = surface.make_control_points(test.points);
        const auto reference_control = reference.make_control_points(deeper.points);
        const bool cube = test.points.size() == 8;
        double slide = 0.0, distance = 0.0;
        for (int i = 0; i <= 80; ++i) {
            for (int j = 0; j <= 80; ++j) {
                // The first quarter of face 0 from its first corner on: of the cube a face, of the prism a fifth of
                // one.
                const double s = std::pow(2.0, -0.2 * i), t = std::pow(2.0, -0.2 * j), h = 0.01 * std::min(s, t);
                const double scale = cube ? 0.25 : 0.5;
                const auto expected = [&](double x, double y) {
                    return limit_at(reference, reference_control, 0, x, y);
                };
                const glm::dvec3 off = limit_at(surface, control, 0, s * scale, t * scale) - expected(s, t);
                const glm::dvec3 normal = glm::normalize(
                    glm::cross(expected(s - h, t) - expected(s, t), expected(s, t - h) - expected(s, t)));
                slide = std::max(slide, glm::length(off));
                distance = std::max(distance, std::abs(glm::dot(off, normal)));
            }
        }
        EXPECT_LT(slide, 3e-5);
        EXPECT_LT(distance, 1e-8);
        EXPECT_GT(slide, 0.0);
    }
}

TEST(LimitSurface, RP17_ParametersOutsideTheTriangleAreClamped) {
    const TestCage test = make_cube_cage();
    const LimitSurface surface(test.cage, 8, 1);
    const auto control = surface.make_control_points(test.points);
    const auto at = [&](double u, double v) { return surface.evaluate(0, control, 5, u, v); };
    EXPECT_EQ(at(1.0000001, 0.0), at(1.0, 0.0));
    EXPECT_EQ(at(-1e-7, 0.5), at(0.0, 0.5));
    EXPECT_EQ(at(0.5, -3.0), at(0.5, 0.0));
    EXPECT_EQ(at(0.75, 0.75), at(0.75, 0.25));
    EXPECT_EQ(at(1e300, -1e300), at(1.0, 0.0));
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(at(nan, 0.0), std::logic_error);
    EXPECT_THROW(at(0.0, nan), std::logic_error);
    EXPECT_THROW(surface.evaluate(0, control, -1, 0.0, 0.0), std::logic_error);
    EXPECT_THROW(surface.evaluate(0, control, 48, 0.0, 0.0), std::logic_error);
    EXPECT_THROW(surface.evaluate(1, control, 0, 0.0, 0.0), std::logic_error);
}

TEST(LimitSurface, MovesWithItsCageByAnyAffineMap) {
    const TestCage test = make_prism_cage();
    const LimitSurface surface(test.cage, test.points.size(), 2);
    const glm::dmat3 map(0.3, 0.9, -0.2, -1.1, 0.4, 0.5, 0.2, 0.1, 1.7);
    const glm::dvec3 shift(3.0, -2.0, 0.7);
    std::vector<glm::dvec3> moved;
    for (const glm::dvec3& p : test.points) moved.push_back(map * p + shift);
    const Vertices before = vertices_of(surface, test.points), after = vertices_of(surface, moved);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        EXPECT_LT(glm::length(after.positions[i] - (map * before.positions[i] + shift)), 1e-14);
        const glm::dvec3 n = glm::normalize(glm::transpose(glm::inverse(map)) * glm::dvec3(before.normals[i]));
        EXPECT_LT(glm::length(glm::dvec3(after.normals[i]) - n), 1e-6);
    }
}

TEST(LimitSurface, IsAsAccurateFarFromTheOrigin) {
    const TestCage test = make_prism_cage();
    const LimitSurface surface(test.cage, test.points.size(), 3);
    const glm::dvec3 far(1048576.0, -4194304.0, 524288.0);  // powers of two: the cage itself is moved exactly enough
    std::vector<glm::dvec3> moved;
    for (const glm::dvec3& p : test.points) moved.push_back(p + far);
    const Vertices before = vertices_of(surface, test.points), after = vertices_of(surface, moved);
    for (std::size_t i = 0; i < before.positions.size(); ++i) {
        EXPECT_LT(glm::length(after.positions[i] - far - before.positions[i]), 5e-9);  // a double's step there is 9e-10
        EXPECT_LT(glm::length(after.normals[i] - before.normals[i]), 1e-5f);
    }
}

TEST(TessellateCage, FillsTheMeshesOfTheCage) {
    TestCage test = make_cube_cage();
    test.cage.face_parts = {0, 0, 0, 0, 1, 1};
    test.cage.level = 2;
    test.cage.points = 0;
    Scene scene;
    scene.file = "scene.json";
    PointCache cache;
    cache.positions.resize(2);
    for (const glm::dvec3& p : test.points) {
        cache.positions[0].emplace_back(p);
        cache.positions[1].emplace_back(2.0 * p);
    }
    scene.point_caches.push_back(cache);
    scene.cages.push_back(test.cage);
    scene.meshes.resize(3);
    scene.meshes[0].cage = scene.meshes[2].cage = 0;
    scene.meshes[2].cage_part = 1;
    scene.meshes[2].material = 7;
    tessellate_cage(scene, 0);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4u * 32u);
    EXPECT_EQ(scene.meshes[1].triangles.size(), 0u);
    EXPECT_EQ(scene.meshes[2].triangles.size(), 2u * 32u);
    EXPECT_EQ(scene.meshes[2].material, 7);
    EXPECT_EQ(scene.meshes[2].positions.size(), scene.meshes[2].normals.size());
    EXPECT_NE(scene.meshes[0].limit.surface, nullptr);
    EXPECT_EQ(scene.meshes[0].limit.surface, scene.meshes[2].limit.surface);

    scene.cages[0].level = 1;
    tessellate_cage(scene, 0);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4u * 8u);

    EXPECT_EQ(cage_points_at(scene, scene.cages[0], 0.0)[7], glm::dvec3(1.0));
    EXPECT_EQ(cage_points_at(scene, scene.cages[0], 0.25)[7], glm::dvec3(1.25));
    EXPECT_EQ(cage_points_at(scene, scene.cages[0], 5.0)[7], glm::dvec3(2.0));
}

TEST(TessellateCage, LevelZeroOfOtherPolygonsIsLevelOne) {
    const TestCage test = make_prism_cage();
    const LimitSurface surface(test.cage, 10, 0);
    EXPECT_EQ(surface.level(), 1);
    EXPECT_EQ(surface.triangle_count(0), 5u * 8u + 2u * 5u * 2u);
    EXPECT_EQ(LimitSurface(make_cube_cage().cage, 8, 0).level(), 0);
}

}  // namespace
}  // namespace aleph
