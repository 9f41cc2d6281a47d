// Motion of deforming meshes (RP-14, RP-15): skins and morph targets with known displacements.

#include "motion/reprojection.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/seen_motion.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 64, height = 48;

/// A camera at +z that sees the sheet.
int add_camera(Scene& scene, double distance = 4.0) {
    scene.cameras.emplace_back();
    scene.nodes.push_back({.transform = {.translation = glm::dvec3(0.1, -0.2, distance)}, .camera = 0});
    return static_cast<int>(scene.nodes.size()) - 1;
}

using Observed = SeenMotion;

Observed observe(const Scene& scene, double from, double to) {
    return {scene, from, to, width, height};
}

/// The motion found against that of where `at_now` and `at_other` put a rest point. Points of the sheet's triangles
/// keep their barycentrics, so that rest points are known from the hits.
template <class AtNow, class AtOther>
MotionErrors find_errors(const Observed& seen, const Mesh& rest, const AtNow& at_now, const AtOther& at_other) {
    return find_motion_errors(seen, [&](const Hit& hit) {
        const glm::uvec3 t = rest.triangles[hit.primitive];
        const glm::dvec2 uv = clamp_barycentrics(hit);
        const auto between = [&](const auto& place) {
            return (1.0 - uv.x - uv.y) * place(rest.positions[t.x]) + uv.x * place(rest.positions[t.y]) +
                   uv.y * place(rest.positions[t.z]);
        };
        return std::pair(between(at_now), between(at_other));
    });
}

TEST(Deforming, RP14_MovingAllVerticesIsMovingTheObject) {
    const glm::vec3 shift(0.25f, -0.125f, 0.5f);
    Scene deforming = make_sheet_scene(), rigid = make_sheet_scene();
    add_cache(deforming, 0, {0.0, 1.0},
              [&](const glm::vec3& p, std::size_t sample) { return p + shift * static_cast<float>(sample); });
    rigid.nodes[0].transform.translation = Track<glm::dvec3>({0.0, 1.0}, {glm::dvec3(0.0), glm::dvec3(shift)});
    add_camera(deforming);
    add_camera(rigid);
    for (const double from : {0.0, 0.3}) {
        const Observed a = observe(deforming, from, from + 0.4), b = observe(rigid, from, from + 0.4);
        std::size_t hits = 0;
        double largest = 0.0;
        for (std::size_t i = 0; i < a.hits.size(); ++i) {
            if (a.hits.pixels[i].instance == no_index || b.hits.pixels[i].instance == no_index) continue;
            ++hits;
            // Rays hit both at the same place up to rounding, which moves the point but not its motion.
            largest = std::max(largest, glm::length(a.motion.displacement.pixels[i] - b.motion.displacement.pixels[i]));
        }
        EXPECT_GT(hits, 500u);
        EXPECT_GT(glm::length(a.motion.displacement(width / 2, height / 2)), 1.0);
        EXPECT_LT(largest, 1e-4);
        // The same hits: the same motion.
        const MotionField of_rigid = compute_model_motion(rigid, b.now, b.other, a.hits);
        double exact = 0.0;
        for (std::size_t i = 0; i < a.hits.size(); ++i)
            exact = std::max(exact, glm::length(a.motion.displacement.pixels[i] - of_rigid.displacement.pixels[i]));
        EXPECT_LT(exact, 1e-6);
    }
}

TEST(Deforming, RP14_WhatStandsStillBetweenSamplesMovesByExactlyNothing) {
    Scene scene = make_sheet_scene();
    add_cache(scene, 0, {0.0, 1.0, 2.0}, [](const glm::vec3& p, std::size_t sample) {
        return p * (sample == 2 ? 3.0f : 1.1f) + glm::vec3(0.0f, 0.0f, 0.3f * p.x);
    });
    add_camera(scene);
    const Observed seen = observe(scene, 0.2, 0.7);
    EXPECT_FALSE(seen.now.pose.meshes[0].positions.empty());
    for (const glm::dvec2& d : seen.motion.displacement.pixels) EXPECT_EQ(d, glm::dvec2(0.0));
    const Observed later = observe(scene, 1.2, 1.7);
    EXPECT_GT(glm::length(later.motion.displacement(width / 2 + 10, height / 2)), 0.1);
}

TEST(Deforming, RP15_NoMotionAcrossAChangeOfTopology) {
    Scene scene = make_sheet_scene(4);
    scene.meshes.push_back(make_sheet(7));  // the surface from 1 s on
    scene.nodes[0].meshes = {0, 1};
    scene.meshes[0].present = Track<double>({0.0, 1.0}, {1.0, 0.0}, Interpolation::step);
    scene.meshes[1].present = Track<double>({0.0, 1.0}, {0.0, 1.0}, Interpolation::step);
    scene.nodes[0].transform.translation = Track<glm::dvec3>({0.0, 2.0}, {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0)});
    add_camera(scene);
    const Observed across = observe(scene, 0.9, 1.1), before = observe(scene, 0.5, 0.9),
                   after = observe(scene, 1.0, 1.5);
    for (std::size_t i = 0; i < across.hits.size(); ++i) {
        if (across.hits.pixels[i].instance != no_index) {
            EXPECT_EQ(across.hits.pixels[i].instance, 0);
            EXPECT_EQ(across.motion.validity.pixels[i], MotionValidity::no_counterpart);
        }
        EXPECT_EQ(across.motion.displacement.pixels[i], glm::dvec2(0.0));
    }
    EXPECT_EQ(before.hits(width / 2, height / 2).instance, 0);
    EXPECT_EQ(after.hits(width / 2, height / 2).instance, 1);
    for (const Observed* seen : {&before, &after}) {
        EXPECT_EQ(seen->motion.validity(width / 2, height / 2), MotionValidity::valid);
        EXPECT_GT(seen->motion.displacement(width / 2, height / 2).x, 1.0);
    }
}

TEST(Deforming, SkinnedPointsTurnWithTheirJoint) {
    Scene scene = make_skin_scene();
    Track<double> angle = Track<double>({0.0, 1.0}, {0.0, std::numbers::pi / 2.0});
    scene.nodes[2].transform.axis_rotation = AxisRotation{{0.0, 0.0, 1.0}, angle};
    add_camera(scene);
    const double from = 0.1, to = 0.25;  // 13.5 degrees
    const Observed seen = observe(scene, from, to);
    const auto at = [&](double seconds) {
        return [seconds](const glm::vec3& p) { return bent_by(p, seconds * std::numbers::pi / 2.0); };
    };
    const MotionErrors errors = find_errors(seen, scene.meshes[0], at(from), at(to));
    EXPECT_GT(errors.hits, 500u);
    EXPECT_LT(errors.worst, 1e-6);
    EXPECT_GT(glm::length(seen.motion.displacement(width / 2 + 12, height / 2)), 1.0);
}

/// The inverse of the node's transform is as exact for any scale, uneven or mirrored too.
TEST(Deforming, KF19_SkinsOnNodesOfTinyAndHugeScale) {
    for (const double s : {1e-30, 1e-14, 1e-6, 1.0, 1e6, 1e14, 1e30}) {
        for (const glm::dvec3& shape : {glm::dvec3(1.0), glm::dvec3(-2.0, 1.0, 0.5)}) {
            Scene scene = make_skin_scene();
            scene.nodes[0].transform.translation = std::min(s, 1.0) * glm::dvec3(5.0, -3.0, 2.0);
            scene.nodes[0].transform.rotation = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, -1.0)));
            scene.nodes[0].transform.scale = s * shape;
            const ScenePose posed = pose(scene, 0.0);
            ASSERT_EQ(posed.meshes[0].positions.size(), scene.meshes[0].positions.size());
            for (std::size_t v = 0; v < posed.meshes[0].positions.size(); ++v) {
                const glm::dvec3 world(posed.world[0] * glm::dvec4(posed.meshes[0].positions[v], 1.0));
                EXPECT_LT(glm::length(world - bent_by(scene.meshes[0].positions[v], 0.0)), 1e-6) << s;
            }
        }
    }
}

TEST(Deforming, RP07_PathsOfTurningJointsAreArcs) {
    Scene scene = make_skin_scene();
    scene.nodes[2].transform.axis_rotation =
        AxisRotation{{0.0, 0.0, 1.0}, Track<double>({0.0, 1.0}, {0.0, 2.0 * std::numbers::pi})};
    add_camera(scene);
    const Observed seen = observe(scene, 0.0, 1.0);  // once around
    std::size_t checked = 0;
    for (std::size_t i = 0; i < seen.hits.size(); ++i) {
        const Hit& hit = seen.hits.pixels[i];
        if (hit.instance == no_index) continue;
        const glm::uvec3 t = scene.meshes[0].triangles[hit.primitive];
        const glm::dvec2 uv = clamp_barycentrics(hit);
        const auto on_right = [&](std::uint32_t v) { return scene.meshes[0].positions[v].x > 0.0f; };
        if (!on_right(t.x) || !on_right(t.y) || !on_right(t.z)) continue;
        const glm::dvec3 p = point_between(scene.meshes[0].positions, t, uv);
        const double radius = std::hypot(p.x, p.y) / 4.0 * seen.now.view.pixels_per_unit;
        EXPECT_LT(glm::length(seen.motion.displacement.pixels[i]), 1e-9);
        EXPECT_NEAR(seen.motion.path_length.pixels[i], 2.0 * std::numbers::pi * radius,
                    0.01 * 2.0 * std::numbers::pi * radius);
        ++checked;
    }
    EXPECT_GT(checked, 100u);
}

TEST(Deforming, MorphedPointsMoveByTheirTargets) {
    Scene scene = make_sheet_scene();
    Mesh& mesh = scene.meshes[0];
    mesh.deformation.targets.resize(1);
    for (const glm::vec3& p : mesh.positions)
        mesh.deformation.targets[0].positions.emplace_back(p.y, 0.5f * p.x, p.x * p.y);
    mesh.deformation.target_weights = {Track<double>({0.0, 1.0}, {0.0, 1.0})};
    add_camera(scene);
    const Observed seen = observe(scene, 0.25, 0.5);
    const auto at = [](double weight) {
        return [weight](const glm::vec3& rest) {
            const glm::dvec3 p(rest);
            return p + weight * glm::dvec3(p.y, 0.5 * p.x, p.x * p.y);
        };
    };
    const MotionErrors errors = find_errors(seen, mesh, at(0.25), at(0.5));
    EXPECT_GT(errors.hits, 400u);
    EXPECT_LT(errors.worst, 1e-5);
}

TEST(Deforming, HiddenPointsAreFoundWhereTheyHaveMoved) {
    Scene scene = make_sheet_scene(8);  // flat, then its right half folds behind a screen
    add_cache(scene, 0, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p - glm::vec3(0.0f, 0.0f, sample == 1 ? 2.0f : 0.0f);
    });
    scene.meshes.push_back(make_sheet(1));
    Node screen{.meshes = {1}};
    screen.transform.translation = glm::dvec3(1.3, 0.0, -1.0);  // before the sheet only once that has gone back
    scene.nodes.push_back(screen);
    add_camera(scene);
    Observed seen = observe(scene, 0.0, 1.0);
    RayScene rays(scene);
    rays.update(seen.other.pose, compute_anchor(seen.other.view));
    mark_hidden(seen.motion, scene, seen.other, seen.hits, rays);
    std::size_t hidden = 0, valid = 0;
    for (const MotionValidity validity : seen.motion.validity.pixels) {
        hidden += validity == MotionValidity::hidden;
        valid += validity == MotionValidity::valid;
    }
    EXPECT_GT(hidden, 50u);
    EXPECT_GT(valid, 100u);
    EXPECT_EQ(seen.motion.validity(width / 2 - 8, height / 2), MotionValidity::valid);
}

}  // namespace
}  // namespace aleph
