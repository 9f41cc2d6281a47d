// References as means of passes, and their exposure.

#include "render/study/reference_picture.h"

#include <gtest/gtest.h>

#include <cmath>

namespace aleph {
namespace {

ChannelImage grey_picture(const std::vector<float>& values) {
    ChannelImage picture;
    Image<float> grey(static_cast<int>(values.size()), 1);
    grey.pixels = values;
    for (const char* name : {"R", "G", "B"}) picture.channels.push_back({name, grey});
    picture.metadata["exposureFactor"] = 1.0;
    return picture;
}

TEST(ReferencePicture, IsTheMeanOfItsPassesWithItsVariance) {
    ChannelImage mean;
    add_pass(mean, grey_picture({1.0f, 5.0f}));
    EXPECT_TRUE(std::isinf(mean.find("variance.Y")->pixels[0]));
    for (const float value : {4.0f, 1.0f, 2.0f}) add_pass(mean, grey_picture({value, 5.0f}));
    EXPECT_EQ(reference_passes(mean), 4.0);
    EXPECT_NEAR(mean.find("G")->pixels[0], 2.0, 1e-6);
    EXPECT_NEAR(mean.find("variance.Y")->pixels[0], 6.0 / 3.0 / 4.0, 1e-6);
    EXPECT_NEAR(mean.find("variance.Y")->pixels[1], 0.0, 1e-12);
    EXPECT_NEAR(mean.find("noise.B")->pixels[0], (1.0 - 4.0 + 1.0 - 2.0) / 4.0, 1e-6);
    EXPECT_NEAR(mean.find("noise.B")->pixels[1], 0.0, 1e-6);
}

TEST(ReferencePicture, FollowsTheExposure) {
    ChannelImage mean;
    for (const float value : {1.0f, 3.0f}) add_pass(mean, grey_picture({value}));
    const ChannelImage brighter = with_exposure(mean, 2.0);
    EXPECT_NEAR(brighter.find("R")->pixels[0], 4.0, 1e-6);
    EXPECT_NEAR(brighter.find("variance.Y")->pixels[0], 4.0 * mean.find("variance.Y")->pixels[0], 1e-6);
}

}  // namespace
}  // namespace aleph
