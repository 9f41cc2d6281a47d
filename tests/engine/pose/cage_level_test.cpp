// The level of a cage follows the size of its edges in the picture; it is one for the whole shot.
#include "engine/pose/cage_level.h"
#include "engine/pose/pose.h"
#include "engine/scene/points.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/cage_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 320, height = 200;

/// A wavy sheet of 4 x 4 faces of about 1 m across z = 0, the camera `distance` before its middle.
Scene make_sheet(double distance, double height_of_waves = 0.3) {
    TestCage test = make_grid_cage(7, 7);
    test.cage.boundary = Cage::Boundary::none;  // the outermost faces only shape those within: waves alike everywhere
    for (std::size_t i = 0; i < test.points.size(); ++i) {
        const double wave = height_of_waves * (i % 2 == 0 ? 1.0 : -1.0);
        test.points[i] = glm::dvec3(static_cast<double>(i % 7) - 3.0, static_cast<double>(i / 7) - 3.0, wave);
    }
    Scene scene = make_cage_scene(test, {test.points}, 0);
    scene.cages[0].max_level = 8;
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, distance);
    return scene;
}

int level_of(const Scene& scene, std::size_t max_triangles = 4'000'000) {
    return choose_cage_levels(scene, 0, width, height, max_triangles).at(0);
}

/// The fineness of a sheet at a level: its triangles' longest edge, and the largest distance of finer triangles' points
/// from these triangles' edges' middles, pixels. All triangles as if at the sheet's nearest point.
struct Fineness {
    double edge = 0.0, bend = 0.0;
};
Fineness measure(const Scene& scene, int level, double distance) {
    const double pixels = height / (2.0 * std::tan(std::numbers::pi / 8.0)) / distance;
    const LimitSurface surface(scene.cages[0], scene.point_caches[0].point_count(), level);
    const auto control = surface.make_control_points(sample_points(scene.point_caches[scene.cages[0].points], 0.0));
    const Mesh mesh = surface.make_mesh(0, control);
    Fineness result;
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        for (int k = 0; k < 3; ++k) {
            const glm::dvec3 a(mesh.positions[mesh.triangles[i][k]]), b(mesh.positions[mesh.triangles[i][(k + 1) % 3]]);
            result.edge = std::max(result.edge, glm::length(b - a) * pixels);
            const glm::dvec3 middle = surface.evaluate(0, control, static_cast<int>(i), k == 0 || k == 1 ? 0.5 : 0.0,
                                                       k == 1 || k == 2 ? 0.5 : 0.0);
            const glm::dvec3 along = glm::normalize(b - a), off = middle - a;
            result.bend = std::max(result.bend, glm::length(off - along * glm::dot(off, along)) * pixels);
        }
    }
    return result;
}

TEST(CageLevel, TrianglesAreFineEnoughAndNotMuchFiner) {
    for (const double waves : {0.3, 0.03, 0.003}) {
        for (const double distance : {6.0, 15.0, 50.0}) {  // the whole sheet is in view
            const Scene scene = make_sheet(distance, waves);
            const int level = level_of(scene);
            const Fineness now = measure(scene, level, distance);
            // Parts farther away need less, and bends shrink by 4 only about: half a level of slack.
            EXPECT_TRUE(now.edge <= 4.0 * 1.5 || now.bend <= 0.1 * 2.0) << distance << " " << waves;
            if (level == 0) continue;
            const Fineness coarser = measure(scene, level - 1, distance - waves);
            EXPECT_TRUE(coarser.edge > 4.0 / 1.5 && coarser.bend > 0.1 / 2.0) << distance << " " << waves;
        }
    }
}

TEST(CageLevel, FlatAndStraightFacesStayWhole) {
    EXPECT_EQ(level_of(make_sheet(1.0, 0.0)), 0);
    EXPECT_GT(level_of(make_sheet(1.0, 0.01)), 0);
    // A skirting board: 5 m of straight lines, creased along its edges.
    TestCage board = make_cage({{0, 0, 0}, {5, 0, 0}, {0, 0.1, 0}, {5, 0.1, 0}, {0, 0.1, -0.02}, {5, 0.1, -0.02}},
                               {{0, 1, 3, 2}, {2, 3, 5, 4}});
    add_crease(board.cage, {2, 3}, 10.0f);
    Scene scene = make_cage_scene(board, {board.points}, 1);
    scene.nodes[1].transform.translation = glm::dvec3(2.5, 0.1, 0.3);
    EXPECT_EQ(level_of(scene), 1);
}

TEST(CageLevel, NearestFrameOfTheShotDecidesForAll) {
    Scene scene = make_sheet(0.0);
    scene.film.range = FrameRange{0, 100};
    scene.nodes[1].transform.translation =
        Track<glm::dvec3>({0.0, 50.0 / 30.0, 100.0 / 30.0}, {{0.0, 0.0, 40.0}, {0.0, 0.0, 1.0}, {0.0, 0.0, 40.0}});
    EXPECT_EQ(level_of(scene), level_of(make_sheet(1.0)));
    scene.film.range = FrameRange{0, 10};
    EXPECT_LT(level_of(scene), level_of(make_sheet(1.0)));
}

Track<glm::dvec3> make_path(std::vector<double> frames, std::vector<glm::dvec3> places) {
    for (double& time : frames) time /= 30.0;
    return {std::move(frames), std::move(places)};
}

TEST(CageLevel, PassesOfAFewFramesCount) {
    Scene scene = make_sheet(0.0);
    scene.film.range = FrameRange{0, 640};
    const glm::dvec3 away(0.0, 0.0, -400.0), near(0.0, 0.0, -1.0);
    scene.nodes[0].transform.translation = make_path({0.0, 323.0, 325.0, 327.0, 640.0}, {away, away, near, away, away});
    EXPECT_EQ(level_of(scene), level_of(make_sheet(1.0)));
    // The camera passes a sheet at rest.
    Scene still = make_sheet(0.0);
    still.film.range = FrameRange{0, 640};
    still.nodes[1].transform.translation =
        make_path({0.0, 323.0, 325.0, 327.0, 640.0}, {-away, -away, -near, -away, -away});
    EXPECT_EQ(level_of(still), level_of(make_sheet(1.0)));
    // It is there for a moment only, and once it passes out of view.
    Scene shown = make_sheet(1.0);
    shown.film.range = FrameRange{0, 640};
    shown.nodes[0].visible = Track<double>({0.0, 325.0 / 30.0, 326.0 / 30.0}, {0.0, 1.0, 0.0}, Interpolation::step);
    EXPECT_EQ(level_of(shown), level_of(make_sheet(1.0)));
    scene.nodes[0].visible = 0.0;
    EXPECT_EQ(level_of(scene), 0);
    Scene behind = make_sheet(0.0);
    behind.film.range = FrameRange{0, 640};
    behind.nodes[0].transform.translation =
        make_path({0.0, 323.0, 325.0, 327.0, 640.0}, {-away, -away, -near, -away, -away});
    EXPECT_EQ(level_of(behind), 0);
}

TEST(CageLevel, LongShotsAreLookedAtInSteps) {
    Scene scene = make_sheet(6.0);
    scene.film.range = FrameRange{0, 4'000'000'000'000};
    scene.nodes[0].transform.translation = make_path({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(0.1)});
    EXPECT_GE(level_of(scene), level_of(make_sheet(6.0)));
}

TEST(CageLevel, PictureSizeScaleAndDeformationCount) {
    const Scene scene = make_sheet(6.0);
    const int level = level_of(scene);
    EXPECT_GE(choose_cage_levels(scene, 0, 4 * width, 4 * height).at(0), level + 1);  // + 2 by edges, + 1 by bends
    Scene scaled = make_sheet(6.0);
    scaled.nodes[0].transform.scale = glm::dvec3(5.0);
    EXPECT_GT(level_of(scaled), level);
    Scene stretched = make_sheet(6.0);
    PointCache& cache = stretched.point_caches[0];
    cache.positions.push_back(cache.positions[0]);
    for (glm::vec3& p : cache.positions[1]) p *= glm::vec3(2.0f, 2.0f, 20.0f);
    stretched.film.range = FrameRange{0, 1};
    EXPECT_GT(level_of(stretched), level);
}

TEST(CageLevel, OrthographicCamerasDoNotNear) {
    Scene scene = make_sheet(6.0);
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 2.0;
    const int level = level_of(scene);
    EXPECT_GT(level, 2);
    scene.nodes[1].transform.translation = glm::dvec3(0.0, 0.0, 60.0);
    EXPECT_EQ(level_of(scene), level);
    scene.cameras[0].half_height = 0.25;
    EXPECT_GT(level_of(scene), level);
}

/// The nearest point of a large face counts, not the nearest corner: a camera without perspective that shows as large
/// what is there needs the same level.
TEST(CageLevel, NearestPointOfATriangleDecides) {
    for (const glm::dvec2& place : {glm::dvec2(5.0, 5.0), {6.0, 4.5}, {4.0, 7.0}}) {
        for (const double distance : {0.02, 0.2, 1.0}) {
            Scene scene = make_sheet(distance, 0.02);
            scene.nodes[0].transform.scale = glm::dvec3(10.0);
            scene.nodes[1].transform.translation = glm::dvec3(place, distance);
            Scene flat = scene;
            flat.cameras[0].orthographic = true;
            flat.cameras[0].half_height = distance * std::tan(std::numbers::pi / 8.0);
            EXPECT_EQ(level_of(scene), level_of(flat)) << place.x << ' ' << place.y << ' ' << distance;
        }
    }
}

TEST(CageLevel, WhatIsNotInViewKeepsItsLevel) {
    Scene beside = make_sheet(3.0);
    beside.nodes[0].transform.translation = glm::dvec3(100.0, 0.0, 0.0);
    EXPECT_EQ(level_of(beside), 0);
    Scene behind = make_sheet(-3.0);
    EXPECT_EQ(level_of(behind), 0);
    behind.cages[0].level = 2;
    EXPECT_EQ(level_of(behind), 2);
    Scene hidden = make_sheet(3.0);
    hidden.nodes[0].visible = 0.0;
    EXPECT_EQ(level_of(hidden), 0);
    // Triangles all around the picture, whose corners lie outside on all sides.
    EXPECT_GE(level_of(make_sheet(0.12)), 5);
}

TEST(CageLevel, ViewsEndAtThePicturesSidesAndTheNearPlane) {
    // At 10 m the picture reaches up to 4.14 and sideways to 6.63 m, the orthographic one to 3 and 4.8; the sheet's
    // half side is 2 m.
    for (const bool orthographic : {false, true}) {
        Scene scene = make_sheet(10.0);
        scene.cameras[0].orthographic = orthographic;
        scene.cameras[0].half_height = 3.0;
        const double top = orthographic ? 3.0 : 10.0 * std::tan(std::numbers::pi / 8.0), right = 1.6 * top;
        for (const double side : {-1.0, 1.0}) {
            const auto level_at = [&](double x, double y) {
                scene.nodes[0].transform.translation = glm::dvec3(side * x, side * y, 0.0);
                return level_of(scene);
            };
            EXPECT_GT(level_at(right + 1.6, 0.0), 0) << orthographic << side;
            EXPECT_EQ(level_at(right + 2.4, 0.0), 0) << orthographic << side;
            EXPECT_GT(level_at(0.0, top + 1.6), 0) << orthographic << side;
            EXPECT_EQ(level_at(0.0, top + 2.4), 0) << orthographic << side;
        }
        scene.nodes[0].transform.translation = glm::dvec3(0.0);
        scene.cameras[0].near_plane = 9.0;
        EXPECT_GT(level_of(scene), 0) << orthographic;
        scene.cameras[0].near_plane = 11.0;
        EXPECT_EQ(level_of(scene), 0) << orthographic;
    }
}

TEST(CageLevel, StaysWithinTheCagesAndTheScenesLimits) {
    Scene scene = make_sheet(1.0);
    scene.cages[0].max_level = 3;
    EXPECT_EQ(level_of(scene), 3);
    scene.cages[0].max_level = 99;
    EXPECT_LE(level_of(scene), 10);
    scene.cages[0].max_level = -1;
    EXPECT_EQ(level_of(scene), 0);
    scene.cages[0].max_level = 8;
    EXPECT_EQ(level_of(scene, 36 * 2 * 64), 3);
    EXPECT_EQ(level_of(scene, 36 * 2 * 64 - 1), 2);
    EXPECT_EQ(level_of(scene, 1), 0);
    scene.cages[0].level = 1;  // as authored at least
    EXPECT_EQ(level_of(scene, 1), 1);
}

TEST(CageLevel, CameraInTheSurfaceIsNoHarm) {
    for (const double tilt : {0.0, 0.5, 1.5}) {
        Scene through = make_sheet(0.0);
        through.nodes[0].transform.rotation = glm::angleAxis(tilt, glm::dvec3(1.0, 0.0, 0.0));
        EXPECT_LE(level_of(through), 8);
    }
}

TEST(CageLevel, ScenesAreRemadeOnlyWhereALevelDiffers) {
    const Scene scene = make_sheet(3.0);
    const int same[] = {0}, finer[] = {4}, beyond_all[] = {99};
    EXPECT_EQ(make_scene_at_levels(scene, same), nullptr);
    const auto copy = make_scene_at_levels(scene, finer);
    ASSERT_NE(copy, nullptr);
    EXPECT_EQ(copy->meshes[0].triangles.size(), 16u * 2u * 256u);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 16u * 2u);
    EXPECT_EQ(copy->meshes[0].subdivision.limit.surface->level(), 4);
    EXPECT_EQ(make_scene_at_levels(scene, beyond_all)->cages[0].level, 8);
}

TEST(CageLevel, SequencesTakeItAndTheSettingFixesIt) {
    Scene scene = make_sheet(20.0, 0.01);
    scene.environment.radiance = glm::dvec3(1.0);
    scene.film.exposure = 1.0;
    RenderSettings settings;
    settings.picture.width = 32;
    settings.picture.height = 20;
    const auto hits_at = [&](const Scene& from, int level) {
        settings.picture.subdivision_level = level;
        Sequence sequence(from, settings, "");
        int highest = 0;
        const FrameOutput out = sequence.render(0, {.frame = false, .maps = true, .progress = {}});
        for (const Hit& hit : out.hits.pixels) {
            if (hit.instance != no_index) highest = std::max(highest, hit.primitive);
        }
        return highest;
    };
    EXPECT_LT(hits_at(scene, 0), 32);
    EXPECT_GT(hits_at(scene, 3), 16 * 2 * 16);
    EXPECT_LT(hits_at(scene, 3), 16 * 2 * 64);
    EXPECT_LT(hits_at(scene, -1), 32);  // far away and nearly flat
    scene.cages[0].max_level = 1;
    EXPECT_LT(hits_at(scene, 3), 16 * 2 * 4);
}

}  // namespace
}  // namespace aleph
