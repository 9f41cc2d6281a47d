// Motion of deforming cages against the closed form of their limit surface (a bicubic B-spline over regular faces).
#include "tests/support/allocations.h"
#include "tests/support/scenes/cage_scenes.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

SeenMotion compute_motion(const Scene& scene) {
    return {scene, 0.0, scene.film.frame_rate.seconds_of(1), 160, 120};
}

/// (s, t) of a hit on the one face that is drawn: two triangles per cell, cells row by row.
glm::dvec2 place_of(const Hit& hit, int level) {
    const int n = 1 << level, cell = hit.primitive / 2;
    const glm::dvec2 corner(cell % n, cell / n);
    const double u = hit.u, v = hit.v;
    const glm::dvec2 inside = hit.primitive % 2 == 0 ? glm::dvec2(u + v, v) : glm::dvec2(u, u + v);
    return (corner + inside) / static_cast<double>(n);
}

TEST(CageMotion, IsTheLimitSurfacesAtEveryLevel) {
    TestCage test = make_grid_cage(4, 4);
    test.cage.boundary = Cage::Boundary::none;
    // Every point moves differently and far: a bend, a twist and a stretch.
    std::vector<glm::dvec3> later;
    for (const glm::dvec3& p : test.points) {
        later.emplace_back(p.x + 0.3 * p.y * p.y, 0.8 * p.y + 0.2 * p.z, p.z + 0.25 * p.x * p.y - 0.4);
    }
    for (int level = 0; level <= 6; ++level) {
        Scene scene = make_cage_scene(test, {test.points, later}, level);
        scene.nodes[1].transform.translation = glm::dvec3(1.5, 1.6, 1.9);
        const auto from = round_to_float(test.points), to = round_to_float(later);
        const MotionErrors errors = find_motion_errors(compute_motion(scene), [&](const Hit& hit) {
            const glm::dvec2 st = place_of(hit, level);
            return std::pair(tensor(from, bspline(st.x), bspline(st.y)), tensor(to, bspline(st.x), bspline(st.y)));
        });
        EXPECT_GT(errors.hits, 2000u);
        EXPECT_GT(errors.longest, 20.0);
        EXPECT_LT(errors.worst, 1e-9) << "level " << level;
    }
}

TEST(CageMotion, RP16_StaticSurfacesDoNotMoveAtAnyLevel) {
    for (int level = 0; level <= 5; ++level) {
        TestCage test = make_cube_cage();
        add_crease(test.cage, {4, 5, 7}, 2.5f);
        // Two equal samples and a different third: the cage deforms, but not between frames 0 and 1.
        std::vector<glm::dvec3> later = test.points;
        later[0] *= 1.5;
        Scene scene = make_cage_scene(test, {test.points, test.points, later}, level);
        scene.nodes[1].transform.translation = glm::dvec3(0.3, 0.2, 4.0);
        const SeenMotion moved = compute_motion(scene);
        int hits = 0;
        for (std::size_t i = 0; i < moved.hits.size(); ++i) {
            hits += moved.hits.pixels[i].instance != no_index ? 1 : 0;
            EXPECT_EQ(moved.motion.displacement.pixels[i], glm::dvec2(0.0));
        }
        EXPECT_GT(hits, 1000);
        const Scene rigid = make_cage_scene(test, {test.points, test.points}, level);
        EXPECT_TRUE(pose(rigid, 0.0).meshes[0].positions.empty());
    }
}

/// Paths are summed with one pose at a time, however many steps a turn takes.
TEST(CageMotion, FastTurnsTakeNoMoreMemory) {
    const TestCage test = make_cube_cage();
    std::vector<glm::dvec3> later = test.points;
    for (glm::dvec3& p : later) p *= 1.2;
    const auto peak_of = [&](double turns) {
        Scene scene = make_cage_scene(test, {test.points, later}, 5);
        scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, 6.0);
        AxisRotation& turn = scene.nodes[0].transform.axis_rotation.emplace();
        turn.angle = Track<double>({0.0, 1.0}, {0.0, turns * 60.0 * std::numbers::pi});
        return count_allocations([&] { compute_motion(scene); }).peak;
    };
    EXPECT_LT(static_cast<double>(peak_of(20.0)), 1.1 * static_cast<double>(peak_of(1.0)));
}

TEST(CageMotion, RP16_PartsThatDoNotMoveDoNotMove) {
    // A long sheet of which the right end bends: the left stays where it is bit for bit.
    TestCage test = make_grid_cage(12, 4);
    std::vector<glm::dvec3> later = test.points;
    for (std::size_t i = 0; i < later.size(); ++i) {
        if (i % 12 >= 9) later[i].z += 1.0;
    }
    Scene scene = make_cage_scene(test, {test.points, later}, 3);
    scene.nodes[1].transform.translation = glm::dvec3(5.5, 1.5, 12.0);
    const SeenMotion moved = compute_motion(scene);
    int still = 0, moving = 0;
    for (std::size_t i = 0; i < moved.hits.size(); ++i) {
        const Hit& hit = moved.hits.pixels[i];
        if (hit.instance == no_index) continue;
        const int column = hit.primitive / 128 % 11;  // 2 x 8 x 8 triangles per face
        if (column <= 6) {
            EXPECT_EQ(moved.motion.displacement.pixels[i], glm::dvec2(0.0));
            ++still;
        } else if (column >= 9) {
            EXPECT_GT(glm::length(moved.motion.displacement.pixels[i]), 0.1);
            ++moving;
        }
    }
    EXPECT_GT(still, 500);
    EXPECT_GT(moving, 100);
}

}  // namespace
}  // namespace aleph
