// Hard transforms between keys and in hierarchies: flattened, sheared, mirrored, deep, far away (KF-20 to KF-25).

#include "engine/pose/camera_view.h"
#include "engine/pose/pose.h"
#include "engine/scene/transforms.h"
#include "tests/engine/scene/matrices.h"

namespace aleph {
namespace {

TEST(Transforms, KF20_ScaleThroughZero) {
    Scene scene;
    scene.nodes.resize(1);
    scene.nodes[0].transform.scale = Track<glm::dvec3>({0.0, 2.0}, {glm::dvec3(1.0), glm::dvec3(-1.0, 1.0, 1.0)});
    EXPECT_EQ(orientation_sign(pose(scene, 0.9).world[0]), 1.0);
    EXPECT_EQ(orientation_sign(pose(scene, 1.1).world[0]), -1.0);
    const glm::dmat4 middle = pose(scene, 1.0).world[0];
    EXPECT_EQ(middle, scaling(0, 1, 1));
    EXPECT_FALSE(has_full_rank(middle));
    EXPECT_EQ(safe_normalize(normal_matrix(middle) * glm::dvec3(1, 1, 1)), glm::dvec3(1, 0, 0));
    // The axes of a camera flattened along one axis are still found.
    const glm::dmat4 turn = turning(70, {1, -2, 3});
    for (const glm::dmat4& flat : {scaling(0, 1, 1), scaling(1, 0, 1), scaling(2, 3, 0)})
        EXPECT_LT(largest_element(orthonormal_axes(turn * flat) - glm::dmat3(turn)), 1e-15 * 4.0);
    // As matrices: by element, without a turn.
    EXPECT_EQ(interpolate_matrix(scaling(1, 1, 1), scaling(-1, 1, 1), 0.25), scaling(0.5, 1, 1));
    EXPECT_EQ(interpolate_matrix(scaling(1, 1, 1), scaling(0, 0, 0), 0.25), scaling(0.75, 0.75, 0.75));
    for (const glm::dmat4& flat : {scaling(1, 0, 1), scaling(0, 0, 2), scaling(1, 1e-14, 1)}) {
        const glm::dmat4 key = turning(160, {1, 0, 1}) * flat;
        EXPECT_LT(distance(interpolate_matrix(turn, key, 0.25), turn * 0.75 + key * 0.25), 1e-15);
    }
}

TEST(Transforms, KF21_ShearedKeysComeBackAsTheyWere) {
    const glm::dmat4 sheared = scaling(1, 3, 1) * turning(45, {0, 0, 1});
    EXPECT_EQ(interpolate_matrix(sheared, glm::dmat4(1.0), 0.0), sheared);
    EXPECT_EQ(interpolate_matrix(glm::dmat4(1.0), sheared, 1.0), sheared);
    // Next to a key the decomposition is recomposed almost unchanged.
    EXPECT_LT(distance(interpolate_matrix(sheared, glm::dmat4(1.0), 1e-12), sheared), 1e-11);
    const std::vector<glm::dmat4> keys = random_matrices(400);
    for (std::size_t i = 1; i < keys.size(); ++i) {
        const bool same_side = orientation_sign(keys[i]) == orientation_sign(keys[i - 1]);
        EXPECT_LT(distance(interpolate_matrix(keys[i - 1], keys[i], 1e-12), keys[i - 1]), 1e-10);
        EXPECT_LT(distance(interpolate_matrix(keys[i], keys[i - 1], 1.0 - 1e-12), keys[i - 1]), 1e-10);
        if (!same_side) continue;  // two ways, one path
        const glm::dmat4 there = interpolate_matrix(keys[i - 1], keys[i], 0.3);
        EXPECT_LT(distance(there, interpolate_matrix(keys[i], keys[i - 1], 0.7)), 1e-12);
        EXPECT_EQ(orientation_sign(there), orientation_sign(keys[i]));  // it does not collapse on the way
    }
}

TEST(Transforms, KF22_HalfATurnKeepsItsVolume) {
    for (const double degrees : {10.0, 90.0, 179.0, 179.999999})
        for (const double t : {0.25, 0.5, 0.75}) {
            const glm::dvec3 axis(0.3, -1.0, 0.2);
            const glm::dmat4 m = interpolate_matrix(glm::dmat4(1.0), turning(degrees, axis), t);
            EXPECT_NEAR(glm::determinant(m), 1.0, 1e-14);
            EXPECT_LT(distance(m, turning(degrees * t, axis)), 1e-8);
        }
}

TEST(Transforms, KF23_MirroredKeysDoNotSpin) {
    const glm::dmat4 mirror = scaling(-1, 1, 1);
    const glm::dmat4 nearly = scaling(-1, 1, 1 + 1e-9);
    for (double t = 0.0; t <= 1.0; t += 0.125) {
        EXPECT_EQ(interpolate_matrix(mirror, mirror, t), mirror);
        EXPECT_LT(distance(interpolate_matrix(mirror, nearly, t), mirror), 1.1e-9);
        // A mirrored object that turns by 80 degrees takes the same way as one that is not mirrored.
        const glm::dmat4 turned = interpolate_matrix(mirror, turning(80, {0, 1, 0}) * mirror, t);
        EXPECT_LT(distance(turned, turning(80 * t, {0, 1, 0}) * mirror), 1e-14);
    }
}

Scene chain(int depth, double degrees) {
    Scene scene;
    scene.nodes.resize(depth);
    for (int i = 0; i < depth; ++i) {
        Node& node = scene.nodes[i];
        node.parent = i - 1;
        node.transform.translation = glm::dvec3(1.0, 0.0, 0.0);
        AxisRotation turn{.axis = {0.0, 0.0, 1.0}, .angle = degrees * pi / 180.0};
        node.transform.axis_rotation = turn;
    }
    return scene;
}

TEST(Transforms, KF24_DeepHierarchiesMatchTheClosedForm) {
    for (const int depth : {10'000, 100'000}) {
        const ScenePose frame = pose(chain(depth, 0.36), 0.0);
        const long double step = 0.36L * std::numbers::pi_v<long double> / 180.0L;
        long double x = 0.0L, y = 0.0L, radius = 0.0L;
        for (int i = 0; i < depth; ++i) {
            x += std::cos(i * step);
            y += std::sin(i * step);
            radius = std::max(radius, std::hypot(x, y));
        }
        const glm::dmat4& last = frame.world.back();
        const double tolerance = depth == 10'000 ? 1e-9 : 1e-8;
        EXPECT_NEAR(last[3].x, static_cast<double>(x), tolerance * static_cast<double>(radius));
        EXPECT_NEAR(last[3].y, static_cast<double>(y), tolerance * static_cast<double>(radius));
        EXPECT_NEAR(last[0].x, static_cast<double>(std::cos(depth * step)), tolerance);
        EXPECT_NEAR(last[0].y, static_cast<double>(std::sin(depth * step)), tolerance);
        expect_orthonormal(glm::dmat3(last), tolerance);
    }
}

TEST(Transforms, KF25_FarFromTheOriginNothingMoves) {
    const auto pixel_at = [](const glm::dvec3& offset) {
        Scene scene;
        scene.cameras.resize(1);
        scene.nodes.resize(4);
        scene.nodes[0].transform.translation = offset;
        scene.nodes[1].parent = 0;
        scene.nodes[1].transform.matrix = look_at({0.3, 1.0, 10.0}, {0.0, 0.5, 0.0}, {0.0, 1.0, 0.0});
        scene.nodes[1].camera = 0;
        scene.nodes[2].parent = 0;
        scene.nodes[2].transform.rotation = glm::angleAxis(0.6, glm::dvec3(0.0, 1.0, 0.0));
        scene.nodes[3].parent = 2;
        scene.nodes[3].transform.translation = glm::dvec3(1.1, 0.2, 0.7);
        const ScenePose frame = pose(scene, 0.0);
        const CameraView view = make_camera_view(frame.cameras[0], 1920, 1080);
        return project_camera_point(view, to_camera(view, glm::dvec3(frame.world[3][3])));
    };
    const glm::dvec2 here = pixel_at(glm::dvec3(0.0));
    EXPECT_LT(glm::length(pixel_at({1e6, 0.0, -1e6}) - here), 1e-6);
    EXPECT_LT(glm::length(pixel_at({1e6 / 3.0, 7e5, 1e6}) - here), 1e-6);
}

}  // namespace
}  // namespace aleph
