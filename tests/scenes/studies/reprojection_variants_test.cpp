// Errors of reprojection in float and double that follow from the spacing of numbers.

#include "scenes/studies/reprojection_variants.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aleph {
namespace {

/// A focal length of 1000 pixels.
CameraView make_view() {
    CameraView view;
    view.width = 320;
    view.height = 240;
    view.pixels_per_unit = 1000.0;
    return view;
}

const glm::dvec3 point(0.3, -0.2, -4.0);  // m, in front of the camera

template <class Reprojection>
double error_at(double metres) {
    const glm::dvec3 offset(metres);
    const auto place = Reprojection(moved_by(make_view(), offset), moved_by(glm::dmat4(1.0), offset))(point);
    const double x = 160.0 + 1000.0 * 0.3 / 4.0, y = 120.0 + 1000.0 * 0.2 / 4.0;
    return std::hypot(static_cast<double>(place.x) - x, static_cast<double>(place.y) - y);
}

using Double = RelativeReprojection<double, double>;
using CameraFloat = RelativeReprojection<float, double>;
using WorldFloat = WorldReprojection<float>;

/// At 1e5 m floats are 2^-7 m apart: 0.3 becomes 38/128 and -0.2 becomes -26/128, at a depth of exactly 4 m.
TEST(ReprojectionVariants, FloatInWorldSpaceErrsByTheSpacingOfFloats) {
    const double x = 250.0 * (0.3 - 38.0 / 128.0), y = 250.0 * (0.2 - 26.0 / 128.0);
    EXPECT_NEAR(error_at<WorldFloat>(1e5), std::hypot(x, y), 1e-4);
    EXPECT_GT(error_at<WorldFloat>(1e5), 1.0);
    EXPECT_LT(error_at<WorldFloat>(0.0), 1e-3);
}

/// Relative to the camera, what is left is the spacing of pixel positions near 235 and of the numbers before: 2^-16.
TEST(ReprojectionVariants, FloatRelativeToTheCameraErrsAlikeEverywhere) {
    EXPECT_LT(error_at<CameraFloat>(0.0), 4.0 * 0x1p-16);
    EXPECT_EQ(error_at<CameraFloat>(1e7), error_at<CameraFloat>(0.0));
}

/// The object's place differs from the camera's by exactly 0 here, so only the projection rounds.
TEST(ReprojectionVariants, DoubleStaysExactFarAway) {
    EXPECT_LT(error_at<Double>(0.0), 1e-12);
    EXPECT_LT(error_at<Double>(1e7), 1e-12);
}

/// An object that is 0.3 m beside the camera: at 1e7 m doubles are 2^-29 m apart, so that its place is off by half of
/// that at most along each axis.
TEST(ReprojectionVariants, DoubleErrsByTheRoundingOfPlaces) {
    const glm::dvec3 offset(1e7), beside(0.3, 0.1, -4.0);
    const CameraView view = make_view();
    glm::dmat4 object(1.0);
    object[3] = glm::dvec4(beside, 1.0);
    const glm::dvec2 near = Double(view, object)(glm::dvec3(0.0));
    const glm::dvec2 far = Double(moved_by(view, offset), moved_by(object, offset))(glm::dvec3(0.0));
    const double most = 250.0 * 0x1p-30 * 1.5;  // x, y and a part of z
    EXPECT_LT(std::abs(far.x - near.x), most);
    EXPECT_LT(std::abs(far.y - near.y), most);
    EXPECT_LT(most, 1e-6);
    EXPECT_NE(far, near);
}

}  // namespace
}  // namespace aleph
