// Pixels per frame to degrees per second, (5.1).

#include "motion/velocity.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

float velocity_of(double path_length, const ViewingConditions& viewing, const FrameRate& frame_rate = {},
                  MotionValidity validity = MotionValidity::valid) {
    MotionField field = make_motion_field(1, 1, validity);  // the path counts, not the displacement
    field.path_length(0, 0) = path_length;
    return compute_image_velocity(field, viewing, frame_rate)(0, 0);
}

TEST(Velocity, Equation5_1) {
    // The thesis's display: 31 pixels per degree, 30 frames per second.
    EXPECT_EQ(velocity_of(31.0, {}), 30.0f);
    EXPECT_FLOAT_EQ(velocity_of(1.0, {}), 30.0f / 31.0f);
    EXPECT_FLOAT_EQ(velocity_of(3.0, {.pixels_per_degree = 60.0}, {24, 1}), 1.2f);
    EXPECT_EQ(velocity_of(0.0, {}), 0.0f);
    EXPECT_FLOAT_EQ(velocity_of(1e-7, {}), 1e-7f * 30.0f / 31.0f);
}

TEST(Velocity, ZeroWhereMotionIsNotKnown) {
    EXPECT_EQ(velocity_of(5.0, {}, {}, MotionValidity::behind_camera), 0.0f);
    EXPECT_EQ(velocity_of(5.0, {}, {}, MotionValidity::no_counterpart), 0.0f);
    for (const MotionValidity known :
         {MotionValidity::valid, MotionValidity::background, MotionValidity::leaves_screen, MotionValidity::hidden}) {
        EXPECT_FLOAT_EQ(velocity_of(5.0, {}, {}, known), 150.0f / 31.0f);
    }
}

TEST(Velocity, RP21_RatesThatAreNotPositiveAndFiniteAreRefused) {
    for (const double bad : {0.0, -0.0, -1.0, infinity, -infinity, not_a_number}) {
        EXPECT_EQ(find_refusal([&] { velocity_of(1.0, {.pixels_per_degree = bad}); }).place, "pixels per degree")
            << bad;
    }
    for (const FrameRate& bad : {FrameRate{0, 1}, {0, -1}, {-1, 1}, {1, 0}, {-1, 0}, {0, 0}}) {
        EXPECT_EQ(find_refusal([&] { velocity_of(1.0, {}, bad); }).place, "frames per second") << bad.per_second();
    }
}

}  // namespace
}  // namespace aleph
