// The level of cages follows the size of their edges in the picture, one for the whole shot.
#include "engine/cage_level.h"

#include <gtest/gtest.h>

#include <chrono>

#include "engine/base/errors.h"
#include "engine/pose.h"
#include "render/sequence.h"
#include "tests/unit/cage_scenes.h"

namespace aleph {
namespace {

constexpr int width = 320, height = 200;

/// A flat sheet of 4 x 4 faces of edge 1 across z = 0, the camera `distance` before its middle.
Scene make_sheet(double distance) {
    TestCage test = make_grid_cage(5, 5);
    for (std::size_t i = 0; i < test.points.size(); ++i) {
        test.points[i] = glm::dvec3(static_cast<double>(i % 5) - 2.0, static_cast<double>(i / 5) - 2.0, 0.0);
    }
    Scene scene = make_cage_scene(test, {test.points}, 2);
    scene.cages[0].max_level = 8;
    scene.nodes[1].translation = glm::dvec3(0.0, 0.0, distance);
    return scene;
}

int level_of(const Scene& scene, const CageLevelSettings& settings = {}) {
    return choose_cage_levels(scene, 0, width, height, settings).at(0);
}

CageLevelSettings with_triangles(std::size_t most) {
    CageLevelSettings settings;
    settings.max_triangles = most;
    return settings;
}

TEST(CageLevel, LongestEdgeInPixelsIsMetAndNotMuchMoreThanMet) {
    for (const double distance : {0.5, 1.0, 3.0, 10.0, 50.0}) {
        const Scene scene = make_sheet(distance);
        const double pixels = height / (2.0 * std::tan(std::numbers::pi / 8.0)) / distance;  // of an edge
        const int level = level_of(scene);
        EXPECT_LE(pixels / (1 << level), 4.0) << distance;
        if (level > 0) {
            EXPECT_GT(pixels / (1 << level), 2.0) << distance;
        }
    }
    EXPECT_EQ(level_of(make_sheet(3.0)), 5);  // 80.5 pixels: 2.5 at level 5, 5.0 at level 4
}

TEST(CageLevel, AsksForMoreAsTheCameraNears) {
    int last = 99;
    for (const double distance : {1.0, 2.5, 6.0, 15.0, 40.0, 200.0}) {
        const int level = level_of(make_sheet(distance));
        EXPECT_LT(level, last) << distance;
        last = level;
    }
    EXPECT_EQ(last, 0);
}

TEST(CageLevel, NearestFrameOfTheShotDecidesForAll) {
    Scene scene = make_sheet(0.0);
    scene.range = FrameRange{0, 100};
    Track<glm::dvec3>& path = scene.nodes[1].translation;
    path.sampling.kind = TimeSampling::Kind::acyclic;
    path.sampling.times = {0.0, 50.0 / 30.0, 100.0 / 30.0};
    path.values = {{0.0, 0.0, 40.0}, {0.0, 0.0, 2.5}, {0.0, 0.0, 40.0}};
    EXPECT_EQ(level_of(scene), level_of(make_sheet(2.5)));
    scene.range = FrameRange{0, 10};
    EXPECT_LT(level_of(scene), level_of(make_sheet(2.5)));
}

TEST(CageLevel, PictureSizeScaleAndDeformationCount) {
    const Scene scene = make_sheet(6.0);
    const int level = level_of(scene);
    EXPECT_EQ(choose_cage_levels(scene, 0, 4 * width, 4 * height).at(0), level + 2);
    Scene scaled = make_sheet(6.0);
    scaled.nodes[0].scale = glm::dvec3(2.0);
    EXPECT_EQ(level_of(scaled), level + 1);
    Scene stretched = make_sheet(6.0);
    PointCache& cache = stretched.point_caches[0];
    cache.positions.push_back(cache.positions[0]);
    for (glm::vec3& p : cache.positions[1]) p.x *= 2.0f;
    stretched.range = FrameRange{0, 1};
    EXPECT_EQ(level_of(stretched), level + 1);
}

TEST(CageLevel, OrthographicCamerasDoNotNear) {
    Scene scene = make_sheet(6.0);
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 2.0;  // 50 pixels per edge
    EXPECT_EQ(level_of(scene), 4);
    scene.nodes[1].translation = glm::dvec3(0.0, 0.0, 60.0);
    EXPECT_EQ(level_of(scene), 4);
}

TEST(CageLevel, WhatIsNotInViewKeepsItsLevel) {
    Scene beside = make_sheet(3.0);
    beside.nodes[0].translation = glm::dvec3(100.0, 0.0, 0.0);
    EXPECT_EQ(level_of(beside), 2);
    Scene behind = make_sheet(-3.0);
    EXPECT_EQ(level_of(behind), 2);
    Scene hidden = make_sheet(3.0);
    hidden.nodes[0].visible = 0.0;
    EXPECT_EQ(level_of(hidden), 2);
    // A face all around the picture, whose corners lie outside on four sides.
    Scene near = make_sheet(0.01);
    EXPECT_EQ(level_of(near), 8);
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
    EXPECT_EQ(level_of(scene, with_triangles(16 * 2 * 64)), 3);
    EXPECT_EQ(level_of(scene, with_triangles(16 * 2 * 64 - 1)), 2);
    EXPECT_EQ(level_of(scene, with_triangles(1)), 0);
}

TEST(CageLevel, CameraInTheSurfaceIsNoHarm) {
    EXPECT_EQ(level_of(make_sheet(0.0)), 2);  // seen edge-on from within its plane: before the camera there is nothing
    Scene through = make_sheet(0.0);
    through.nodes[0].rotation = glm::dquat(std::sqrt(0.5), std::sqrt(0.5), 0.0, 0.0);
    EXPECT_EQ(level_of(through), 8);
}

TEST(CageLevel, ScenesAreRemadeOnlyWhereALevelDiffers) {
    const Scene scene = make_sheet(3.0);
    const int same[] = {2}, finer[] = {4}, beyond[] = {99};
    EXPECT_EQ(make_scene_at_levels(scene, same), nullptr);
    const auto copy = make_scene_at_levels(scene, finer);
    ASSERT_NE(copy, nullptr);
    EXPECT_EQ(copy->meshes[0].triangles.size(), 16u * 2u * 256u);
    EXPECT_EQ(scene.meshes[0].triangles.size(), 16u * 2u * 16u);
    EXPECT_EQ(copy->meshes[0].limit.surface->level(), 4);
    EXPECT_EQ(make_scene_at_levels(scene, beyond)->cages[0].level, 8);
}

TEST(CageLevel, SequencesTakeItAndTheSettingFixesIt) {
    Scene scene = make_sheet(7.0);
    scene.environment = glm::dvec3(1.0);
    scene.exposure = 1.0;
    RenderSettings settings;
    settings.width = 32;
    settings.height = 20;
    const auto hits_at = [&](const Scene& from, int level) {
        settings.subdivision_level = level;
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
    // 3.4 pixels per edge: level 0 (and the cage's own is 2).
    EXPECT_LT(hits_at(scene, -1), 32);
    scene.cages[0].max_level = 1;
    EXPECT_LT(hits_at(scene, 3), 16 * 2 * 4);
}

}  // namespace
}  // namespace aleph
