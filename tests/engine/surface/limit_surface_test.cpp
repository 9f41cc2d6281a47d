// Subdivision surfaces against closed forms: B-splines, limit masks, explicit subdivision.
#include "tests/engine/surface/cage_checks.h"
#include "tests/support/subdivision_reference.h"

namespace aleph {
namespace {

/// Largest distance of a reference point to the nearest vertex, and the other way round.
double distance_between(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double worst = 0.0;
    const auto one_way = [&](const auto& from, const auto& to) {
        for (const glm::dvec3& p : from) {
            double nearest = infinity;
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

std::array<double, 4> bspline_slope(double t) {
    const double r = 1.0 - t;
    return {-r * r / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, (-3.0 * t * t + 2.0 * t + 1.0) / 2.0, t * t / 2.0};
}

TestCage make_bspline_cage() {
    TestCage result = make_grid_cage(4, 4);
    result.cage.boundary = Cage::Boundary::none;
    return result;
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
            for (const auto& face : {std::vector{j * n + i, j * n + right, up * n + right},
                                     std::vector{j * n + i, up * n + right, up * n + i}}) {
                add_face(torus.cage, face);
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
    const TestCage cube = make_cube_cage();
    const std::size_t smooth = vertices_of(LimitSurface(cube.cage, 8, 3), cube.points).positions.size();
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

}  // namespace
}  // namespace aleph
