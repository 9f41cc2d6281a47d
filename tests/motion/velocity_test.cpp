// Pixels per frame to degrees per second, (5.1), and which frame motion is found against.

#include "motion/velocity.h"
#include "motion/other_frame.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

MotionField make_field(double path_length, MotionValidity validity) {
    MotionField field;
    field.displacement = Image<glm::dvec2>(1, 1, glm::dvec2(path_length, 0.0));
    field.path_length = Image<double>(1, 1, path_length);
    field.validity = Image<MotionValidity>(1, 1, validity);
    return field;
}

float velocity_of(double path_length, const ViewingConditions& viewing, const FrameRate& frame_rate = {},
                  MotionValidity validity = MotionValidity::valid) {
    return compute_image_velocity(make_field(path_length, validity), viewing, frame_rate)(0, 0);
}

TEST(Velocity, Equation5_1) {
    // The thesis's display: 31 pixels per degree, 30 frames per second.
    EXPECT_EQ(velocity_of(31.0, {}), 30.0f);
    EXPECT_FLOAT_EQ(velocity_of(1.0, {}), 30.0f / 31.0f);
    EXPECT_FLOAT_EQ(velocity_of(3.0, {.pixels_per_degree = 60.0}, {24, 1}), 1.2f);
    EXPECT_EQ(velocity_of(0.0, {}), 0.0f);
    EXPECT_FLOAT_EQ(velocity_of(1e-7, {}), 1e-7f * 30.0f / 31.0f);
}

TEST(Velocity, ThePathCountsNotTheChord) {
    MotionField field = make_field(942.0, MotionValidity::valid);
    field.displacement(0, 0) = glm::dvec2(0.0);
    EXPECT_FLOAT_EQ(compute_image_velocity(field, {}, {})(0, 0), 942.0f * 30.0f / 31.0f);
}

TEST(Velocity, ZeroWhereMotionIsNotKnown) {
    EXPECT_EQ(velocity_of(5.0, {}, {}, MotionValidity::behind_camera), 0.0f);
    EXPECT_EQ(velocity_of(5.0, {}, {}, MotionValidity::no_counterpart), 0.0f);
    for (const MotionValidity known :
         {MotionValidity::valid, MotionValidity::background, MotionValidity::leaves_screen, MotionValidity::hidden}) {
        EXPECT_FLOAT_EQ(velocity_of(5.0, {}, {}, known), 150.0f / 31.0f);
    }
}

TEST(Velocity, KeepsTheFieldsShape) {
    MotionField field;
    field.displacement = Image<glm::dvec2>(5, 3);
    field.path_length = Image<double>(5, 3);
    field.validity = Image<MotionValidity>(5, 3, MotionValidity::valid);
    field.path_length(4, 1) = 31.0;
    const Image<float> velocity = compute_image_velocity(field, {}, {});
    ASSERT_EQ(velocity.width, 5);
    ASSERT_EQ(velocity.height, 3);
    for (int y = 0; y < 3; ++y) {
        for (int x = 0; x < 5; ++x) EXPECT_EQ(velocity(x, y), x == 4 && y == 1 ? 30.0f : 0.0f);
    }
}

TEST(Velocity, RP21_RatesThatAreNotPositiveAndFiniteAreRefused) {
    for (const double bad : {0.0, -0.0, -1.0, infinity, -infinity, not_a_number}) {
        EXPECT_EQ(find_refusal([&] { velocity_of(1.0, {.pixels_per_degree = bad}); }).place, "pixels per degree")
            << bad;
    }
    const FrameRate none{0, 1}, minus_none{0, -1}, minus_one{-1, 1}, infinite{1, 0}, minus_infinite{-1, 0},
        unknown{0, 0};
    for (const FrameRate& bad : {none, minus_none, minus_one, infinite, minus_infinite, unknown}) {
        try {
            velocity_of(1.0, {}, bad);
            FAIL() << bad.per_second();
        } catch (const InputError& error) {
            EXPECT_EQ(error.place(), "frames per second");
        }
    }
}

TEST(OtherFrame, NumbersAndSigns) {
    EXPECT_EQ(other_frame_number(7, OtherFrame::next), 8);
    EXPECT_EQ(other_frame_number(7, OtherFrame::previous), 6);
    EXPECT_EQ(other_frame_number(7, OtherFrame::none), 7);
    EXPECT_EQ(displacement_sign(OtherFrame::next), 1.0);
    EXPECT_EQ(displacement_sign(OtherFrame::previous), -1.0);
    EXPECT_EQ(displacement_sign(OtherFrame::none), 1.0);
}

}  // namespace
}  // namespace aleph
