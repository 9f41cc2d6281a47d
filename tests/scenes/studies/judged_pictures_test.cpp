#include <gtest/gtest.h>

#include <cmath>

#include "scenes/studies/error_runs.h"
#include "scenes/studies/seed_means.h"

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
}

TEST(ReferencePicture, FollowsTheExposure) {
    ChannelImage mean;
    for (const float value : {1.0f, 3.0f}) add_pass(mean, grey_picture({value}));
    const ChannelImage brighter = with_exposure(mean, 2.0);
    EXPECT_NEAR(brighter.find("R")->pixels[0], 4.0, 1e-6);
    EXPECT_NEAR(brighter.find("variance.Y")->pixels[0], 4.0 * mean.find("variance.Y")->pixels[0], 1e-6);
}

TEST(PictureError, CountsAtEveryMultipleOfTheThreshold) {
    ChannelImage reference;
    for (const float value : {1.0f, 1.0f}) add_pass(reference, grey_picture({value, value, value, value}));
    const PictureError error = measure_picture(grey_picture({1.0f, 1.005f, 1.015f, 1.1f}), reference,
                                               Image<float>(4, 1, 1.0f), {1.0, 2.0});  // white is 100 cd/m2
    ASSERT_EQ(error.beyond.size(), 2u);
    EXPECT_NEAR(error.beyond[0].percent, 50.0, 1e-9);
    EXPECT_NEAR(error.beyond[0].certain, 50.0, 1e-9);
    EXPECT_NEAR(error.beyond[1].percent, 25.0, 1e-9);
    EXPECT_NEAR(error.worst, 10.0, 1e-3);
    EXPECT_NEAR(error.bias, 0.12 / 4.0, 1e-6);
}

TEST(ClaimCheck, HoldsEstimatesAgainstErrors) {
    ChannelImage reference;
    for (int i = 0; i < 2; ++i) add_pass(reference, grey_picture({1.0f, 1.0f, 1.0f, 1.0f}));
    PictureClaim claim;
    claim.errors.total = Image<float>(4, 1, 0.5f);
    for (Image<float>& cause : claim.errors.by_cause) cause = Image<float>(4, 1, 0.1f);
    claim.errors.by_cause[1](3, 0) = claim.errors.by_cause[2](2, 0) = 0.4f;
    claim.samples = Image<float>(4, 1, 10.0f);
    claim.samples(3, 0) = 70.0f;
    const ClaimCheck check = check_claim(grey_picture({1.005f, 1.005f, 1.012f, 1.02f}), reference,
                                         Image<float>(4, 1, 1.0f), claim, 1.0);  // errors of .5, .5, 1.2 and 2
    EXPECT_NEAR(check.understated, 25.0, 1e-9);
    EXPECT_NEAR(check.median_ratio, 1.0 / 0.67449, 0.02);
    EXPECT_NEAR(check.beyond_by_cause[0], 0.0, 1e-9);
    EXPECT_NEAR(check.beyond_by_cause[1], 25.0, 1e-9);
    EXPECT_NEAR(check.beyond_by_cause[2], 25.0, 1e-9);
    EXPECT_NEAR(check.samples_by_cause[0], 20.0, 1e-9);
    EXPECT_NEAR(check.samples_by_cause[1], 70.0, 1e-9);
    EXPECT_EQ(check.dearest, 0.0);  // 1 % of four pixels is none
}

TEST(PictureError, TakesTheMedianOfWhatIsShaded) {
    ChannelImage reference;
    add_pass(reference, grey_picture({0.0f, 0.0f, 0.0f, 1.00f, 1.00f}));
    add_pass(reference, grey_picture({0.0f, 0.0f, 0.0f, 1.02f, 1.02f}));
    const PictureError error =
        measure_picture(grey_picture({0.0f, 0.0f, 0.0f, 1.03f, 1.03f}), reference, Image<float>(5, 1, 1.0f), {1.0});
    EXPECT_NEAR(error.median, 2.0, 0.02);
}

ErrorRun make_run(double percent, double seconds, double moments) {
    ErrorRun run;
    run.error.pixels = 1000;
    run.error.beyond = {{1.0, percent, 0.0, 0.0}};
    run.cost.frame_seconds = seconds;
    run.cost.moment_seconds = moments;
    return run;
}

TEST(BestFixed, IsTheCheapestSideAtTheGoal) {
    const LadderSide rough{"rough", {make_run(10.0, 1.0, 0.0), make_run(2.0, 100.0, 0.0)}};
    const LadderSide fine{"fine", {make_run(10.0, 10.0, 0.0), make_run(0.1, 1000.0, 0.0)}};
    const LadderSide dear{"dear", {make_run(10.0, 20.0, 0.0), make_run(0.1, 2000.0, 0.0)}};
    const auto best = find_best_fixed({rough, fine, dear}, {1.0, 1.0});
    ASSERT_TRUE(best);
    EXPECT_EQ(best->name, "fine");
    EXPECT_FALSE(best->at_most);
    EXPECT_NEAR(best->seconds, 100.0, 1e-6);
    EXPECT_FALSE(find_best_fixed({rough}, {1.0, 1.0}));
}

TEST(BestFixed, TellsAnUpperBound) {
    const LadderSide side{"loose", {make_run(0.5, 3.0, 2.0), make_run(0.2, 6.0, 2.0)}};
    const auto best = find_best_fixed({side}, {1.0, 1.0});
    ASSERT_TRUE(best);
    EXPECT_TRUE(best->at_most);
    EXPECT_NEAR(best->seconds, 5.0, 1e-9);
    EXPECT_NEAR(best->frame_seconds, 3.0, 1e-9);
}

TEST(SeedMeans, MeasureBiasInStandardErrors) {
    const SeedMean mean = mean_of_seeds({1.0, 2.0, 3.0});
    EXPECT_NEAR(mean.mean, 2.0, 1e-12);
    EXPECT_NEAR(mean.error, 1.0 / std::sqrt(3.0), 1e-12);
    EXPECT_NEAR(deviation_between({5.0, 3.0}, {0.0, 4.0}), 1.0, 1e-12);
    EXPECT_EQ(deviation_between({2.0, 0.0}, {2.0, 0.0}), 0.0);
}

TEST(SeedMeans, BlocksAddUpToTheWhole) {
    Image<double> light(8, 4);
    for (std::size_t i = 0; i < light.size(); ++i) light.pixels[i] = static_cast<double>(i);
    const PictureSums sums = sum_picture(light, Image<float>(8, 4, 2.0f));
    EXPECT_NEAR(sums.whole, 31.0, 1e-9);
    double blocks = 0.0;
    for (const double block : sums.blocks) blocks += block;
    EXPECT_NEAR(blocks, sums.whole, 1e-9);
    EXPECT_NEAR(sums.blocks[1], 2.0 * (2.0 + 3.0) / 32.0, 1e-9);
}

}  // namespace
}  // namespace aleph
