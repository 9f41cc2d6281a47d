// Cages that OpenSubdiv would crash on are refused.
#include "tests/engine/surface/cage_checks.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(SubdivisionHard, FacesOfFewerThanThreePointsAreRefused) {
    // OpenSubdiv overruns its memory on a face of one point.
    for (const int size : {1, 2, 0, -1, std::numeric_limits<int>::min()}) {
        TestCage test = make_cube_cage();
        test.cage.faces.sizes[3] = size;
        expect_refused(test.cage, 8, "at least 3");
    }
    TestCage one = make_cage({{0, 0, 0}}, {{0}});
    expect_refused(one.cage, 1, "at least 3");
    expect_refused(make_cage({}, {}).cage, 8, "no faces");
}

TEST(SubdivisionHard, PointsOutOfRangeOrRepeatedAreRefused) {
    for (const int bad : {8, -1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        TestCage test = make_cube_cage();
        test.cage.faces.points[5] = bad;
        expect_refused(test.cage, 8, "names point");
    }
    TestCage twice = make_cube_cage();
    twice.cage.faces.points[5] = twice.cage.faces.points[7];
    expect_refused(twice.cage, 8, "twice");
    expect_refused(make_cube_cage().cage, 0, "names point 0 of 0");
}

TEST(SubdivisionHard, SizesThatDoNotFitAreRefused) {
    TestCage test = make_cube_cage();
    test.cage.faces.points.pop_back();
    expect_refused(test.cage, 8, "corners");
    test = make_cube_cage();
    test.cage.faces.sizes.push_back(2147483647);
    expect_refused(test.cage, 8, "corners");
    test = make_cube_cage();
    test.cage.faces.sizes.push_back(60000);
    expect_refused(test.cage, 8, "corners");
    expect_refused(make_cube_cage().cage, std::size_t{1} << 40, "at most");
}

TEST(SubdivisionHard, LoopTakesTrianglesOnly) {
    TestCage test = make_cube_cage();
    test.cage.scheme = Cage::Scheme::loop;
    expect_refused(test.cage, 8, "triangles only");
}

TEST(SubdivisionHard, HolesAndPartsOutOfRangeAreRefused) {
    TestCage test = make_cube_cage();
    test.cage.faces.holes = {6};
    expect_refused(test.cage, 8, "hole 6");
    test.cage.faces.holes = {-1};
    expect_refused(test.cage, 8, "hole -1");
    test = make_cube_cage();
    test.cage.faces.parts = {0, 1};
    expect_refused(test.cage, 8, "parts for 2");
    test.cage.faces.parts = {0, 0, 0, 0, 0, 2147483647};
    expect_refused(test.cage, 8, "part 2147483647");
    test.cage.faces.parts = {0, 0, 0, 0, 0, -1};
    expect_refused(test.cage, 8, "part -1");
}

TEST(SubdivisionHard, CagesWithNothingToDrawAreRefused) {
    TestCage test = make_cube_cage();
    test.cage.faces.holes = {0, 1, 2, 3, 4, 5};
    EXPECT_THROW(LimitSurface(test.cage, 8, 1), InputError);
    TestCage strip = make_grid_cage(4, 2);
    strip.cage.boundary = Cage::Boundary::none;
    EXPECT_THROW(LimitSurface(strip.cage, 8, 1), InputError);
}

TEST(SubdivisionHard, DamagedCreasesAreRefused) {
    const auto with = [](std::vector<int> lengths, std::vector<int> points, std::vector<float> sharpness) {
        TestCage test = make_cube_cage();
        test.cage.creases.lengths = std::move(lengths);
        test.cage.creases.points = std::move(points);
        test.cage.creases.sharpness = std::move(sharpness);
        return test.cage;
    };
    expect_refused(with({2}, {0, 8}, {1.0f}), 8, "names point 8");
    expect_refused(with({2}, {0, -1}, {1.0f}), 8, "names point -1");
    expect_refused(with({1}, {0}, {1.0f}), 8, "at least 2");
    expect_refused(with({-2}, {0, 1}, {1.0f}), 8, "at least 2");
    expect_refused(with({3}, {0, 1}, {1.0f}), 8, "3 points");
    expect_refused(with({2147483647, 2147483647, 2}, {0, 1}, {1.0f, 1.0f, 1.0f}), 8, "points, but 2");
    expect_refused(with({2}, {0, 1}, {}), 8, "0 sharpnesses");
    expect_refused(with({2}, {0, 1}, {float_nan}), 8, "not a finite");
    expect_refused(with({2}, {0, 1}, {float_infinity}), 8, "not a finite");
}

TEST(SubdivisionHard, DamagedCornersAreRefused) {
    TestCage test = make_cube_cage();
    add_corner(test.cage, 8, 1.0f);
    expect_refused(test.cage, 8, "corner 0 names point 8");
    test = make_cube_cage();
    add_corner(test.cage, 1, float_nan);
    expect_refused(test.cage, 8, "not a finite");
    test = make_cube_cage();
    test.cage.corners.points = {1, 2};
    test.cage.corners.sharpness = {1.0f};
    expect_refused(test.cage, 8, "2 corners");
}

TEST(SubdivisionHard, DamagedTextureCoordinatesAreRefused) {
    TestCage test = make_cube_cage();
    test.cage.uv = {{0, 0}, {1, 0}};
    test.cage.faces.uv.assign(23, 0);
    expect_refused(test.cage, 8, "texture coordinates for 23");
    test.cage.faces.uv.assign(24, 2);
    expect_refused(test.cage, 8, "texture coordinate 2 of 2");
    test.cage.faces.uv.assign(24, -1);
    expect_refused(test.cage, 8, "texture coordinate -1");
    test.cage.faces.uv.assign(24, 0);
    test.cage.uv[1].y = float_nan;
    expect_refused(test.cage, 8, "not finite");
}

TEST(SubdivisionHard, SharpEdgesAtPointsOfTwoFacesAreRefused) {
    // A box whose top edge has a point in its middle: two faces, two edges. OpenSubdiv 3.5.0 crashes on a dart there.
    TestCage test = make_cage({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0, 0.5}},
                              {{3, 2, 1, 0}, {0, 1, 4, 5}, {1, 2, 4}, {2, 3, 4}, {3, 0, 5, 4}});
    expect_sound(test);
    add_crease(test.cage, {0, 5}, 2.0f);
    expect_refused(test.cage, 6, "between two faces");
    test.cage.creases.sharpness = {0.0f};
    expect_sound(test);
}

TEST(SubdivisionHard, TooManyNeighboursAreRefused) {
    TestCage fan = make_cage({}, {});
    // OpenSubdiv counts them in 16 bits, and its time and memory grow with their square.
    for (int i = 0; i < 65540; ++i) {
        fan.cage.faces.sizes.push_back(3);
        for (const int p : {0, i + 1, i + 2}) fan.cage.faces.points.push_back(p);
    }
    expect_refused(fan.cage, 65542, "too many faces meet");
}

TEST(SubdivisionHard, TooManyTrianglesAreRefusedBeforeTheyAreMade) {
    TestCage test = make_grid_cage(100, 100);
    test.cage.name = "floor\x1b[31m";
    const LoadCost cost = load_cost([&] { LimitSurface(test.cage, test.points.size(), 10); });
    EXPECT_NE(cost.refusal.message.find("Lower its level"), std::string::npos);
    EXPECT_EQ(cost.refusal.message.find('\x1b'), std::string::npos);
    EXPECT_LT(cost.memory.peak_mebibytes(), 16.0);
    EXPECT_THROW(LimitSurface(test.cage, test.points.size(), 11), InputError);
    EXPECT_THROW(LimitSurface(test.cage, test.points.size(), -1), InputError);
}

TEST(SubdivisionHard, TessellationRefusesPointsThatAreNotThere) {
    Scene scene;
    scene.source.file = "scene.json";
    scene.cages.push_back(make_cube_cage().cage);
    const auto reason = [&] {
        const Refusal found = find_refusal([&] { tessellate_cage(scene, 0); });
        if (found.message.empty()) return std::string("none");
        EXPECT_EQ(found.file, "scene.json");
        EXPECT_EQ(found.place, found.reason.find("part 4") == std::string::npos ? "cage test" : "mesh lid");
        return found.reason;
    };
    EXPECT_EQ(reason(), "it has no points");
    scene.cages[0].points = 3;
    EXPECT_EQ(reason(), "it has no points");
    scene.point_caches.resize(1);
    for (const int points : {0, 1}) {  // empty ones, and just beyond the last
        scene.cages[0].points = points;
        EXPECT_EQ(reason(), "it has no points");
    }
    scene.cages[0].points = 0;
    PointCache& cache = scene.point_caches[0];
    cache.positions.assign(2, std::vector<glm::vec3>(8, glm::vec3(1.0f)));
    EXPECT_EQ(reason(), "none");
    cache.positions[1][3].y = float_nan;
    EXPECT_EQ(reason(), "one of its points is not finite");
    cache.positions[1].pop_back();
    EXPECT_EQ(reason(), "its number of points changes");
    cache.positions.assign(1, std::vector<glm::vec3>(7));
    EXPECT_NE(reason().find("names point 7 of 7"), std::string::npos);
    cache.positions.assign(1, std::vector<glm::vec3>(8));
    scene.cages[0].level = 99;
    EXPECT_NE(reason().find("level 99"), std::string::npos);
    // A mesh of a part that the cage does not have.
    scene.cages[0].level = 1;
    scene.meshes.resize(1);
    scene.meshes[0].name = "lid";
    scene.meshes[0].subdivision.cage = 0;
    scene.meshes[0].subdivision.part = 4;
    EXPECT_NE(reason().find("part 4"), std::string::npos);
}

}  // namespace
}  // namespace aleph
