// Float and double in motion, where the answer is known.

#include "scenes/studies/motion_precision.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aleph {
namespace {

/// A camera of 500 pixels focal length that looks along -z from 5 m, and moves to the right between the frames.
ObjectPose make_pose(double x) {
    ObjectPose pose;
    pose.view.width = 640;
    pose.view.height = 480;
    pose.view.pixels_per_unit = 500.0;
    pose.view.position = glm::dvec3(x, 0.0, 5.0);
    return pose;
}

template <class Projection, class T>
double find_motion(double step, double distance) {
    const glm::dvec3 offset(distance);
    const Projection now(move_world(make_pose(0.0), offset)), other(move_world(make_pose(step), offset));
    return static_cast<double>(displace(now, other, glm::vec<3, T>(0.1, 0.2, 0.0)).x);
}

TEST(MotionPrecision, NearTheOriginAllAgree) {
    // 1 cm at 5 m is 1 pixel.
    EXPECT_NEAR((find_motion<RelativeProjection<double>, double>(0.01, 0.0)), -1.0, 1e-12);
    EXPECT_NEAR((find_motion<RelativeProjection<long double>, long double>(0.01, 0.0)), -1.0, 1e-12);
    EXPECT_NEAR((find_motion<WorldProjection<double>, double>(0.01, 0.0)), -1.0, 1e-12);
    EXPECT_NEAR((find_motion<RelativeProjection<float>, float>(0.01, 0.0)), -1.0, 1e-3);
    EXPECT_NEAR((find_motion<WorldProjection<float>, float>(0.01, 0.0)), -1.0, 1e-3);
}

TEST(MotionPrecision, FloatInWorldSpaceLosesWhatIsBelowItsSpacing) {
    // Floats at 1e6 m are 6 cm apart: a step of 1 cm is lost, or becomes 6 pixels.
    const double far = find_motion<WorldProjection<float>, float>(0.01, 1e6);
    EXPECT_GT(std::abs(far + 1.0), 0.9);
    EXPECT_NEAR(std::remainder(far, 0.0625 * 100.0), 0.0, 1.0);
}

TEST(MotionPrecision, RelativeToTheCameraOnlyTheInputIsRounded) {
    // Doubles at 1e7 m are 1.9e-9 m apart: 1.9e-7 pixels here, for the camera and for the object.
    EXPECT_NEAR((find_motion<RelativeProjection<double>, double>(0.01, 1e7)), -1.0, 4e-7);
    EXPECT_NEAR((find_motion<RelativeProjection<float>, float>(0.01, 1e7)), -1.0, 1e-3);
}

TEST(MotionPrecision, WhatRestsHasNoMotion) {
    for (const double distance : {0.0, 1e3, 1e7}) {
        EXPECT_EQ((find_motion<RelativeProjection<double>, double>(0.0, distance)), 0.0);
        EXPECT_EQ((find_motion<RelativeProjection<float>, float>(0.0, distance)), 0.0);
    }
}

}  // namespace
}  // namespace aleph
