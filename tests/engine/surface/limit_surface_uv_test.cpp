// Texture coordinates of subdivision surfaces: what every face-varying rule does at seams, corners and junctions.
#include "engine/surface/limit_surface.h"
#include "tests/support/scenes/subdivision_cages.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int level = 3;
constexpr int segments = 1 << level;

/// uv at grid place (i, j), both 0 to `segments`, of face f of a cage of quads.
glm::vec2 uv_at(const Mesh& mesh, int f, int i, int j) {
    const int left = std::min(i, segments - 1), low = std::min(j, segments - 1);
    const auto lower = static_cast<std::size_t>(2 * ((f * segments + low) * segments + left));
    const int right = i - left, up = j - low;
    const glm::uvec3 corners = mesh.triangles[lower + (up == 1 && right == 0 ? 1 : 0)];
    return mesh.uv[0][corners[right == 0 && up == 0 ? 0 : right == 1 && up == 0 ? 1 : 2]];
}

/// 2 x 2 quads about point 4; face f is of island islands[f]. Every island has its own value at every point.
struct Islands {
    TestCage test = make_grid_cage(3, 3);
    std::vector<int> of_face;

    explicit Islands(const std::vector<int>& islands) : of_face(islands) {
        for (int island = 0; island < 4; ++island) {
            for (int p = 0; p < 9; ++p) {
                test.cage.uv.emplace_back(p % 3 + 0.3 * std::sin(2.1 * p + island),
                                          p / 3 + 0.2 * std::cos(3.3 * p * island));
            }
        }
        for (std::size_t c = 0; c < test.cage.faces.points.size(); ++c) {
            test.cage.faces.uv.push_back(9 * islands[c / 4] + test.cage.faces.points[c]);
        }
    }
    glm::vec2 value(int face, int point) const { return test.cage.uv[9 * of_face[face] + point]; }
    Mesh mesh(Cage::UvRule rule) const {
        Cage cage = test.cage;
        cage.uv_rule = rule;
        const LimitSurface surface(cage, 9, level);
        return surface.make_mesh(0, surface.make_control_points(test.points));
    }
};

void expect_near(const glm::vec2& a, const glm::vec2& b) {
    EXPECT_NEAR(a.x, b.x, 1e-6f);
    EXPECT_NEAR(a.y, b.y, 1e-6f);
}

const std::vector<Cage::UvRule> all_rules = {Cage::UvRule::linear_none,          Cage::UvRule::linear_corners_only,
                                             Cage::UvRule::linear_corners_plus1, Cage::UvRule::linear_corners_plus2,
                                             Cage::UvRule::linear_boundaries,    Cage::UvRule::linear_all};

TEST(SubdividedUv, LinearAllIsBilinear) {
    const Islands islands({0, 0, 1, 0});
    const Mesh mesh = islands.mesh(Cage::UvRule::linear_all);
    const int points[4][4] = {{0, 1, 4, 3}, {1, 2, 5, 4}, {3, 4, 7, 6}, {4, 5, 8, 7}};
    for (int f = 0; f < 4; ++f) {
        for (int j = 0; j <= segments; ++j) {
            for (int i = 0; i <= segments; ++i) {
                const float s = static_cast<float>(i) / segments, t = static_cast<float>(j) / segments;
                expect_near(uv_at(mesh, f, i, j), (1 - s) * (1 - t) * islands.value(f, points[f][0]) +
                                                      s * (1 - t) * islands.value(f, points[f][1]) +
                                                      s * t * islands.value(f, points[f][2]) +
                                                      (1 - s) * t * islands.value(f, points[f][3]));
            }
        }
    }
}

TEST(SubdividedUv, LinearNoneIsSmoothEvenAtCorners) {
    Islands whole({0, 0, 0, 0});
    // Where the surface itself has a corner, so have its texture coordinates.
    expect_near(uv_at(whole.mesh(Cage::UvRule::linear_none), 0, 0, 0), whole.value(0, 0));
    whole.test.cage.boundary = Cage::Boundary::edge_only;
    const Mesh mesh = whole.mesh(Cage::UvRule::linear_none);
    expect_near(uv_at(mesh, 0, 0, 0), (4.0f * whole.value(0, 0) + whole.value(0, 1) + whole.value(0, 3)) / 6.0f);
    expect_near(uv_at(mesh, 0, segments, 0), (4.0f * whole.value(0, 1) + whole.value(0, 0) + whole.value(0, 2)) / 6.0f);
    glm::vec2 inner = 16.0f * whole.value(0, 4);
    for (const int p : {1, 3, 5, 7}) inner += 4.0f * whole.value(0, p);
    for (const int p : {0, 2, 6, 8}) inner += whole.value(0, p);
    expect_near(uv_at(mesh, 0, segments, segments), inner / 36.0f);
}

TEST(SubdividedUv, CornersAreKeptFromCornersOnlyUp) {
    const Islands whole({0, 0, 0, 0});
    for (const Cage::UvRule rule : all_rules) {
        if (rule == Cage::UvRule::linear_none) continue;
        expect_near(uv_at(whole.mesh(rule), 0, 0, 0), whole.value(0, 0));
        expect_near(uv_at(whole.mesh(rule), 3, segments, segments), whole.value(3, 8));
    }
}

TEST(SubdividedUv, SeamsAreSplinesUnlessBoundariesAreLinear) {
    const Islands halves({0, 0, 1, 1});
    for (const Cage::UvRule rule : all_rules) {
        const Mesh mesh = halves.mesh(rule);
        const bool linear = rule == Cage::UvRule::linear_boundaries || rule == Cage::UvRule::linear_all;
        for (const int face : {0, 2}) {  // on both sides of the seam
            const glm::vec2 start = halves.value(face, 3), middle = halves.value(face, 4), end = halves.value(face, 5);
            const int row = face == 0 ? segments : 0;
            expect_near(uv_at(mesh, face, segments, row), linear ? middle : (4.0f * middle + start + end) / 6.0f);
            if (linear) expect_near(uv_at(mesh, face, segments / 2, row), 0.5f * (start + middle));
        }
    }
}

TEST(SubdividedUv, ConcaveCornersAreKeptFromPlus2Up) {
    const Islands corner({0, 0, 0, 1});  // an L and a square
    const auto smooth = [&](int face) {
        return (4.0f * corner.value(face, 4) + corner.value(face, 5) + corner.value(face, 7)) / 6.0f;
    };
    for (const Cage::UvRule rule : all_rules) {
        const Mesh mesh = corner.mesh(rule);
        const bool keeps_concave = rule == Cage::UvRule::linear_corners_plus2 ||
                                   rule == Cage::UvRule::linear_boundaries || rule == Cage::UvRule::linear_all;
        expect_near(uv_at(mesh, 0, segments, segments), keeps_concave ? corner.value(0, 4) : smooth(0));
        expect_near(uv_at(mesh, 3, 0, 0), rule == Cage::UvRule::linear_none ? smooth(3) : corner.value(3, 4));
    }
}

TEST(SubdividedUv, JunctionsOfThreeIslandsAreKeptFromPlus1Up) {
    const Islands junction({0, 1, 2, 2});
    for (const Cage::UvRule rule : all_rules) {
        const Mesh mesh = junction.mesh(rule);
        const bool keeps = rule != Cage::UvRule::linear_none && rule != Cage::UvRule::linear_corners_only;
        const glm::vec2 smooth = (4.0f * junction.value(2, 4) + junction.value(2, 3) + junction.value(2, 5)) / 6.0f;
        expect_near(uv_at(mesh, 2, segments, 0), keeps ? junction.value(2, 4) : smooth);
    }
}

/// Values equal to the points' x and z: uv is x and z of the limit.
TEST(SubdividedUv, FollowsThePointsAboutExtraordinaryOnes) {
    for (const Cage::Scheme scheme : {Cage::Scheme::catmull_clark, Cage::Scheme::loop}) {
        TestCage test = make_icosahedron_cage(scheme);
        for (const glm::dvec3& p : test.points) test.cage.uv.emplace_back(p.x, p.z);
        test.cage.faces.uv = test.cage.faces.points;
        const LimitSurface surface(test.cage, test.points.size(), level);
        const Mesh mesh = surface.make_mesh(0, surface.make_control_points(test.points));
        ASSERT_EQ(mesh.uv[0].size(), mesh.positions.size());
        for (std::size_t i = 0; i < mesh.uv[0].size(); ++i)
            expect_near(mesh.uv[0][i], glm::vec2(mesh.positions[i].x, mesh.positions[i].z));
    }
}

TEST(SubdividedUv, OnlySeamsHaveTwoVertices) {
    const Islands whole({0, 0, 0, 0}), halves({0, 0, 1, 1});
    const auto grid = (2u * segments + 1) * (2u * segments + 1);
    EXPECT_EQ(whole.mesh(Cage::UvRule::linear_all).positions.size(), grid);
    const Mesh mesh = halves.mesh(Cage::UvRule::linear_all);
    EXPECT_EQ(mesh.positions.size(), grid + 2u * segments + 1);
    int pairs = 0;
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            if (mesh.positions[i] != mesh.positions[k]) continue;
            ++pairs;
            EXPECT_EQ(mesh.normals[i], mesh.normals[k]);  // the surface itself is smooth there
            EXPECT_NE(mesh.uv[0][i], mesh.uv[0][k]);
        }
    }
    EXPECT_EQ(pairs, 2 * segments + 1);
}

TEST(SubdividedUv, DoesNotChangeTheSurface) {
    const Islands islands({0, 1, 2, 2});
    Cage bare = islands.test.cage;
    bare.uv.clear();
    bare.faces.uv.clear();
    const LimitSurface with(islands.test.cage, 9, 0), without(bare, 9, 0);
    const auto a = with.make_control_points(islands.test.points), b = without.make_control_points(islands.test.points);
    for (int primitive = 0; primitive < 8; ++primitive) {
        for (int i = 0; i <= 10; ++i) {
            const glm::dvec3 p = with.evaluate(0, a, primitive, 0.05 * i, 0.5 - 0.03 * i);
            EXPECT_LT(glm::length(p - without.evaluate(0, b, primitive, 0.05 * i, 0.5 - 0.03 * i)), 1e-14);
        }
    }
}

}  // namespace
}  // namespace aleph
