// Odd and damaged cages, and surfaces at their limits (RP-16, RP-17).
#include <numeric>

#include "tests/engine/surface/cage_checks.h"

namespace aleph {
namespace {

TEST(SubdivisionHard, SharpnessBeyondItsRangeIsClamped) {
    TestCage sharp = make_cube_cage(), most = make_cube_cage(), none = make_cube_cage(), negative = make_cube_cage();
    add_crease(sharp.cage, {0, 1, 3, 2, 0}, 1e30f);
    add_crease(most.cage, {0, 1, 3, 2, 0}, 10.0f);
    add_crease(negative.cage, {0, 1, 3, 2, 0}, -5.0f);
    const auto points_of = [](const TestCage& test) {
        return vertices_of(LimitSurface(test.cage, 8, 2), test.points).positions;
    };
    EXPECT_EQ(points_of(sharp), points_of(most));
    EXPECT_EQ(points_of(negative), points_of(none));
}

TEST(SubdivisionHard, CreasesWithoutAnEdgeAreIgnoredWithAWarning) {
    TestCage test = make_cube_cage();
    add_crease(test.cage, {0, 7}, 3.0f);
    add_crease(test.cage, {1, 1}, 3.0f);
    EXPECT_EQ(refusal(test.cage, 8), "");
    expect_sound(test);
    ASSERT_EQ(list_warnings(test.cage).size(), 1u);
    EXPECT_NE(list_warnings(test.cage)[0].find("2 crease edge(s)"), std::string::npos);
    EXPECT_TRUE(list_warnings(make_cube_cage().cage).empty());
}

TEST(SubdivisionHard, SurfacesThatAreNoManifoldAreSharpThere) {
    // Three pages at one spine.
    TestCage book =
        make_cage({{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 1}, {-1, 1, 1}, {-1, 0, -1}, {-1, 1, -1}},
                  {{0, 2, 3, 1}, {0, 1, 5, 4}, {0, 1, 7, 6}});
    ASSERT_EQ(list_warnings(book.cage).size(), 1u);
    EXPECT_NE(list_warnings(book.cage)[0].find("more than two faces"), std::string::npos);
    expect_sound(book, 3);
    // Two cubes that touch at a point.
    TestCage cubes = make_cube_cage();
    const TestCage other = make_cube_cage();
    for (const int p : other.cage.faces.points) cubes.cage.faces.points.push_back(p == 0 ? 7 : p + 7);
    for (std::size_t p = 1; p < 8; ++p) cubes.points.push_back(other.points[p] + glm::dvec3(2.0));
    cubes.cage.faces.sizes.assign(12, 4);
    expect_sound(cubes, 3);
    // Neighbours that disagree about which side is out: a Moebius strip.
    TestCage strip = make_cage({}, {});
    for (int i = 0; i < 6; ++i) {
        const double a = std::numbers::pi * i / 3.0;
        for (const double side : {-0.5, 0.5}) {
            strip.points.emplace_back((2.0 + side * std::cos(a / 2)) * std::cos(a),
                                      (2.0 + side * std::cos(a / 2)) * std::sin(a), side * std::sin(a / 2));
        }
    }
    for (int i = 0; i < 6; ++i) {
        const int next = i == 5 ? 1 : 2 * i + 2, next_up = i == 5 ? 0 : 2 * i + 3;
        add_face(strip.cage, {2 * i, next, next_up, 2 * i + 1});
    }
    expect_sound(strip, 3);
}

TEST(SubdivisionHard, RepeatedFacesAreLetPassWithAWarning) {
    TestCage test = make_cube_cage();
    add_face(test.cage, {0, 4, 6, 2});
    const auto warnings = list_warnings(test.cage);
    ASSERT_EQ(warnings.size(), 2u);
    EXPECT_NE(warnings[1].find("repeat"), std::string::npos);
    expect_sound(test);
    // Two faces back to back: every point lies between two faces.
    expect_sound(make_cage({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {{0, 1, 2, 3}, {3, 2, 1, 0}}));
}

TEST(SubdivisionHard, PointsWithoutFacesDoNoHarm) {
    TestCage test = make_cube_cage();
    test.points.insert(test.points.end(), 5, glm::dvec3(100.0));
    expect_sound(test, 3);
    add_corner(test.cage, 10, 5.0f);
    expect_sound(test, 3);
}

TEST(SubdivisionHard, DegenerateCagesHaveUnitNormals) {
    for (TestCage test : {make_cube_cage(), make_prism_cage(), make_icosahedron_cage(Cage::Scheme::loop)}) {
        for (glm::dvec3& p : test.points) p = glm::dvec3(1.0, 2.0, 3.0);
        expect_sound(test);  // a point
        for (std::size_t i = 0; i < test.points.size(); ++i) test.points[i].x = static_cast<double>(i);
        expect_sound(test);  // a line
    }
    for (const glm::dvec3& scale : {glm::dvec3(1.0, 1.0, 0.0), glm::dvec3(1e-30), glm::dvec3(1e18)}) {
        TestCage test = make_cube_cage();
        for (glm::dvec3& p : test.points) p *= scale;
        expect_sound(test);
    }
}

TEST(SubdivisionHard, FacesAndPointsOfManyNeighbours) {
    const auto add_circle = [](TestCage& test, int n) {
        for (int i = 0; i < n; ++i) {
            const double a = 2.0 * std::numbers::pi * i / n;
            test.points.emplace_back(std::cos(a), std::sin(a), 0.0);
        }
    };
    for (const Cage::Scheme scheme : {Cage::Scheme::catmull_clark, Cage::Scheme::loop}) {
        TestCage fan = make_cage({}, {}, scheme);  // a double cone: points of 700 neighbours
        constexpr int n = 700;
        add_circle(fan, n);
        fan.points.emplace_back(0.0, 0.0, 1.0);
        fan.points.emplace_back(0.0, 0.0, -1.0);
        for (int i = 0; i < n; ++i) {
            add_face(fan.cage, {i, (i + 1) % n, n});
            add_face(fan.cage, {(i + 1) % n, i, n + 1});
        }
        expect_sound(fan, 1);
    }
    std::vector<int> all(1800);
    std::iota(all.begin(), all.end(), 0);
    TestCage polygon = make_cage({}, {all});
    add_circle(polygon, 1800);
    expect_sound(polygon, 1);
}

TEST(SubdivisionHard, HighlyIrregularAndSemiSharpCagesStayWithinBounds) {
    // Every face a triangle under Catmull-Clark, every edge a crease that takes eight levels to fade.
    TestCage test = make_cage({}, {});
    constexpr int n = 60;
    for (int y = 0; y <= n; ++y) {
        for (int x = 0; x <= n; ++x) test.points.emplace_back(x, y, std::sin(x * y));
    }
    for (int y = 0; y < n; ++y) {
        for (int x = 0; x < n; ++x) {
            const int p = y * (n + 1) + x;
            for (const auto& face : {std::vector{p, p + 1, p + n + 2}, std::vector{p, p + n + 2, p + n + 1}}) {
                add_face(test.cage, face);
                add_crease(test.cage, face, 8.5f);
            }
        }
    }
    const LimitSurface surface(test.cage, test.points.size(), 1);
    EXPECT_LT(surface.make_control_points(test.points).size(), 4'000'000u);
    expect_sound(surface, test.points);
}

/// Damages one thing at random.
void damage(TestCage& test, std::mt19937& random) {
    const auto pick = [&](std::size_t count) {
        return std::uniform_int_distribution<std::size_t>(0, count - 1)(random);
    };
    const auto pick_point = [&] { return static_cast<int>(pick(test.points.size())); };
    const int values[] = {-2147483647, -1, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 100, 65536, 2147483647};
    const int value = values[pick(std::size(values))];
    Cage& cage = test.cage;
    switch (pick(10)) {
        case 0:
            cage.faces.sizes[pick(cage.faces.sizes.size())] = value;
            break;
        case 1:
        case 2:
        case 3:
            cage.faces.points[pick(cage.faces.points.size())] = pick_point();
            break;
        case 4:
            add_crease(cage, {value, pick_point()}, 3.3f);
            break;
        case 5:
            add_crease(cage, {pick_point(), pick_point()}, static_cast<float>(pick(12)));
            break;
        case 6:
            add_corner(cage, pick_point(), static_cast<float>(pick(12)));
            break;
        case 7:
            cage.faces.holes.push_back(static_cast<int>(pick(cage.faces.sizes.size())));
            break;
        case 8:
            cage.boundary = static_cast<Cage::Boundary>(pick(3));
            break;
        default:
            add_face(cage, {pick_point(), pick_point(), pick_point()});
    }
    cage.uv_rule = static_cast<Cage::UvRule>(pick(6));
}

TEST(SubdivisionHard, DamagedCagesAreRefusedOrSubdivided) {
    std::mt19937 random(7);
    int refused = 0, made = 0;
    for (int i = 0; i < 3000; ++i) {
        TestCage test = i % 4 == 0   ? make_cube_cage()
                        : i % 4 == 1 ? make_prism_cage()
                        : i % 4 == 2
                            ? make_grid_cage(4, 3)
                            : make_icosahedron_cage(i % 8 == 3 ? Cage::Scheme::loop : Cage::Scheme::catmull_clark);
        const bool textured = i % 3 == 0;
        const int count = 1 + i % 7;
        for (int k = 0; k < count; ++k) damage(test, random);
        if (textured) {
            test.cage.uv.assign(8, glm::vec2(0.5f));
            for (std::size_t c = 0; c < test.cage.faces.points.size(); ++c) {
                test.cage.faces.uv.push_back(static_cast<int>(random() % 8));
            }
        }
        try {
            const LimitSurface surface(test.cage, test.points.size(), i % 3);
            expect_sound(surface, test.points);
            ++made;
        } catch (const InputError&) {
            ++refused;
        }
        ASSERT_FALSE(HasFatalFailure()) << i;
    }
    EXPECT_GT(refused, 300);
    EXPECT_GT(made, 300);
}

}  // namespace
}  // namespace aleph
