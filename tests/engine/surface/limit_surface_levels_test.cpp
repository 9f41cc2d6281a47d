// Subdivision surfaces as meshes: levels, holes and parts, places between the vertices (RP-16, RP-17).
#include "engine/scene/points.h"
#include "tests/engine/surface/cage_checks.h"
#include "tests/support/subdivision_reference.h"

namespace aleph {
namespace {

TEST(LimitSurface, HolesAreAbsentAndChangeNothingElse) {
    TestCage test = make_cube_cage();
    const LimitSurface whole(test.cage, 8, 2);
    test.cage.faces.holes = {2, 5};
    const LimitSurface holed(test.cage, 8, 2);
    EXPECT_EQ(whole.triangles(0).size(), 6u * 32u);
    EXPECT_EQ(holed.triangles(0).size(), 4u * 32u);
    const auto all = vertices_of(whole, test.points).positions;
    for (const glm::dvec3& p : vertices_of(holed, test.points).positions) {
        double nearest = 1.0;
        for (const glm::dvec3& q : all) nearest = std::min(nearest, glm::length(p - q));
        EXPECT_LT(nearest, 1e-14);
    }
}

TEST(LimitSurface, PartsShareTheirEdgesBitForBit) {
    TestCage test = make_cube_cage();
    test.cage.faces.parts = {0, 0, 1, 1, 0, 1};
    const LimitSurface surface(test.cage, 8, 3);
    ASSERT_EQ(surface.part_count(), 2);
    EXPECT_EQ(surface.triangles(0).size(), 3u * 128u);
    EXPECT_EQ(surface.triangles(1).size(), 3u * 128u);
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
    EXPECT_THROW(at(not_a_number, 0.0), std::logic_error);
    EXPECT_THROW(at(0.0, not_a_number), std::logic_error);
    EXPECT_THROW(surface.evaluate(0, control, -1, 0.0, 0.0), std::logic_error);
    EXPECT_THROW(surface.evaluate(0, control, 48, 0.0, 0.0), std::logic_error);
    EXPECT_THROW(surface.evaluate(1, control, 0, 0.0, 0.0), std::logic_error);
}

TEST(LimitSurface, MovesWithItsCageByAnyAffineMap) {
    const struct {
        glm::dmat3 map;
        glm::dvec3 shift;
        double position_error, normal_error;
    } cases[] = {
        {glm::dmat3(0.3, 0.9, -0.2, -1.1, 0.4, 0.5, 0.2, 0.1, 1.7), {3.0, -2.0, 0.7}, 1e-14, 1e-6},
        // Powers of two: the cage itself is moved exactly enough. A double's step there is 9e-10.
        {glm::dmat3(1.0), {1048576.0, -4194304.0, 524288.0}, 5e-9, 1e-5},
    };
    for (const auto& c : cases) {
        const TestCage test = make_prism_cage();
        const LimitSurface surface(test.cage, test.points.size(), 3);
        std::vector<glm::dvec3> moved;
        for (const glm::dvec3& p : test.points) moved.push_back(c.map * p + c.shift);
        const Vertices before = vertices_of(surface, test.points), after = vertices_of(surface, moved);
        for (std::size_t i = 0; i < before.positions.size(); ++i) {
            EXPECT_LT(glm::length(after.positions[i] - c.shift - c.map * before.positions[i]), c.position_error);
            const glm::dvec3 n = glm::normalize(glm::transpose(glm::inverse(c.map)) * glm::dvec3(before.normals[i]));
            EXPECT_LT(glm::length(glm::dvec3(after.normals[i]) - n), c.normal_error);
        }
    }
}

TEST(TessellateCage, FillsTheMeshesOfTheCage) {
    TestCage test = make_cube_cage();
    test.cage.faces.parts = {0, 0, 0, 0, 1, 1};
    test.cage.level = 2;
    test.cage.points = 0;
    Scene scene;
    scene.source.file = "scene.json";
    PointCache cache;
    cache.positions.resize(2);
    for (const glm::dvec3& p : test.points) {
        cache.positions[0].emplace_back(p);
        cache.positions[1].emplace_back(2.0 * p);
    }
    scene.point_caches.push_back(cache);
    scene.cages.push_back(test.cage);
    scene.meshes.resize(3);
    scene.meshes[0].subdivision.cage = scene.meshes[2].subdivision.cage = 0;
    scene.meshes[2].subdivision.part = 1;
    scene.meshes[2].material = 7;
    tessellate_cage(scene, 0);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4u * 32u);
    EXPECT_EQ(scene.meshes[1].triangles.size(), 0u);
    EXPECT_EQ(scene.meshes[2].triangles.size(), 2u * 32u);
    EXPECT_EQ(scene.meshes[2].material, 7);
    EXPECT_EQ(scene.meshes[2].positions.size(), scene.meshes[2].normals.size());
    EXPECT_NE(scene.meshes[0].subdivision.limit.surface, nullptr);
    EXPECT_EQ(scene.meshes[0].subdivision.limit.surface, scene.meshes[2].subdivision.limit.surface);

    scene.cages[0].level = 1;
    tessellate_cage(scene, 0);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 4u * 8u);

    EXPECT_EQ(sample_points(scene.point_caches[scene.cages[0].points], 0.0)[7], glm::dvec3(1.0));
    EXPECT_EQ(sample_points(scene.point_caches[scene.cages[0].points], 0.25)[7], glm::dvec3(1.25));
    EXPECT_EQ(sample_points(scene.point_caches[scene.cages[0].points], 5.0)[7], glm::dvec3(2.0));
}

TEST(TessellateCage, LevelZeroOfOtherPolygonsIsLevelOne) {
    const TestCage test = make_prism_cage();
    const LimitSurface surface(test.cage, 10, 0);
    EXPECT_EQ(surface.level(), 1);
    EXPECT_EQ(surface.triangles(0).size(), 5u * 8u + 2u * 5u * 2u);
    EXPECT_EQ(LimitSurface(make_cube_cage().cage, 8, 0).level(), 0);
}

}  // namespace
}  // namespace aleph
