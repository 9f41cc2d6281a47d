// Cages that OpenSubdiv would crash on are refused.
#include "tests/engine/surface/cage_checks.h"
#include "tests/support/files/load_cost.h"

namespace aleph {
namespace {

constexpr int largest_int = std::numeric_limits<int>::max(), smallest_int = std::numeric_limits<int>::min();

TEST(SubdivisionHard, DamagedCagesAreRefused) {
    const auto size = [](int points) { return [=](Cage& c) { c.faces.sizes[3] = points; }; };
    const auto more = [](int points) { return [=](Cage& c) { c.faces.sizes.push_back(points); }; };
    const auto point = [](int index) { return [=](Cage& c) { c.faces.points[5] = index; }; };
    const auto holes = [](int face) { return [=](Cage& c) { c.faces.holes = {face}; }; };
    const auto parts = [](const std::vector<int>& list) { return [=](Cage& c) { c.faces.parts = list; }; };
    const auto creases = [](const std::vector<int>& lengths, const std::vector<int>& points,
                            const std::vector<float>& sharpness) {
        return [=](Cage& c) { c.creases = {lengths, points, sharpness}; };
    };
    const auto corners = [](const std::vector<int>& points, const std::vector<float>& sharpness) {
        return [=](Cage& c) { c.corners = {points, sharpness}; };
    };
    const auto uv = [](std::size_t count, int index, float v) {
        return [=](Cage& c) {
            c.uv = {{0.0f, 0.0f}, {1.0f, v}};
            c.faces.uv.assign(count, index);
        };
    };
    const std::pair<std::function<void(Cage&)>, const char*> cases[] = {
        {size(1), "at least 3"},  // OpenSubdiv overruns its memory on a face of one point
        {size(2), "at least 3"},
        {size(0), "at least 3"},
        {size(-1), "at least 3"},
        {size(smallest_int), "at least 3"},
        {point(8), "names point"},
        {point(-1), "names point"},
        {point(largest_int), "names point"},
        {point(smallest_int), "names point"},
        {[](Cage& c) { c.faces.points[5] = c.faces.points[7]; }, "twice"},
        {[](Cage& c) { c.faces.points.pop_back(); }, "corners"},
        {more(largest_int), "corners"},
        {more(60000), "corners"},
        {[](Cage& c) { c.scheme = Cage::Scheme::loop; }, "triangles only"},
        {holes(6), "hole 6"},
        {holes(-1), "hole -1"},
        {parts({0, 1}), "parts for 2"},
        {parts({0, 0, 0, 0, 0, largest_int}), "part 2147483647"},
        {parts({0, 0, 0, 0, 0, -1}), "part -1"},
        {creases({2}, {0, 8}, {1.0f}), "names point 8"},
        {creases({2}, {0, -1}, {1.0f}), "names point -1"},
        {creases({1}, {0}, {1.0f}), "at least 2"},
        {creases({-2}, {0, 1}, {1.0f}), "at least 2"},
        {creases({3}, {0, 1}, {1.0f}), "3 points"},
        {creases({largest_int, largest_int, 2}, {0, 1}, {1.0f, 1.0f, 1.0f}), "points, but 2"},
        {creases({2}, {0, 1}, {}), "0 sharpnesses"},
        {creases({2}, {0, 1}, {float_nan}), "not a finite"},
        {creases({2}, {0, 1}, {float_infinity}), "not a finite"},
        {corners({8}, {1.0f}), "corner 0 names point 8"},
        {corners({1}, {float_nan}), "not a finite"},
        {corners({1, 2}, {1.0f}), "2 corners"},
        {uv(23, 0, 0.0f), "texture coordinates for 23"},
        {uv(24, 2, 0.0f), "texture coordinate 2 of 2"},
        {uv(24, -1, 0.0f), "texture coordinate -1"},
        {uv(24, 0, float_nan), "not finite"},
    };
    for (const auto& [damage, reason] : cases) {
        Cage cage = make_cube_cage().cage;
        damage(cage);
        expect_refused(cage, 8, reason);
    }
    expect_refused(make_cage({{0, 0, 0}}, {{0}}).cage, 1, "at least 3");
    expect_refused(make_cage({}, {}).cage, 8, "no faces");
    expect_refused(make_cube_cage().cage, 0, "names point 0 of 0");
    expect_refused(make_cube_cage().cage, std::size_t{1} << 40, "at most");
}

TEST(SubdivisionHard, CagesWithNothingToDrawAreRefused) {
    TestCage test = make_cube_cage();
    test.cage.faces.holes = {0, 1, 2, 3, 4, 5};
    EXPECT_THROW(LimitSurface(test.cage, 8, 1), InputError);
    TestCage strip = make_grid_cage(4, 2);
    strip.cage.boundary = Cage::Boundary::none;
    EXPECT_THROW(LimitSurface(strip.cage, 8, 1), InputError);
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
        add_face(fan.cage, {0, i + 1, i + 2});
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
