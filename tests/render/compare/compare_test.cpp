// The numbers of compare_images against values worked out by hand.

#include "render/compare/compare.h"
#include "tests/support/grey_image.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

ChannelImage one_channel(const std::string& name, std::vector<float> values) {
    Image<float> row(static_cast<int>(values.size()), 1);
    row.pixels = std::move(values);
    return {{{name, row}}, {}};
}

ChannelImage threshold_map(int width, int height, float value) {
    return {{{"threshold.Y", Image<float>(width, height, value)}}, {}};
}

TEST(Compare, NumbersByHand) {
    // b = 1 2 4 1: mean 2, e = .02. Differences 0 .5 -2 0.
    const auto a = one_channel("Z", {1.0f, 2.5f, 2.0f, 1.0f}), b = one_channel("Z", {1.0f, 2.0f, 4.0f, 1.0f});
    const CompareResult result = compare_images(a, b);
    EXPECT_FALSE(result.same());
    EXPECT_DOUBLE_EQ(result.all.max_abs, 2.0);
    EXPECT_DOUBLE_EQ(result.all.rms, std::sqrt((0.25 + 4.0) / 4.0));
    EXPECT_NEAR(result.all.relative_mse, (0.25 / 4.0004 + 4.0 / 16.0004) / 4.0, 1e-15);
    EXPECT_EQ(result.beyond, 2u);
    ASSERT_EQ(result.channels.size(), 1u);
    EXPECT_EQ(result.channels[0].x, 2);
    EXPECT_FALSE(result.colour.has_value());
}

TEST(Compare, ThePlaceOfTheLargestDifference) {
    const ChannelImage b = grey_image(3, 4, 0.5f);
    ChannelImage a = b;
    a.channels[0].values(2, 1) += 0.1f;
    a.channels[0].values(1, 2) += 0.2f;
    const ChannelDifference& channel = compare_images(a, b).channels[0];
    EXPECT_EQ(channel.x, 1);
    EXPECT_EQ(channel.y, 2);
}

TEST(Compare, ToleranceRelativeAndShare) {
    const auto a = one_channel("Z", {1.0f, 2.5f, 2.0f, 1.0f}), b = one_channel("Z", {1.0f, 2.0f, 4.0f, 1.0f});
    const auto beyond = [&](double tolerance, double relative) {
        return compare_images(a, b, {tolerance, relative, 0.0, {}}).beyond;
    };
    EXPECT_EQ(beyond(0.5, 0.0), 1u);
    EXPECT_EQ(beyond(2.0, 0.0), 0u);
    EXPECT_EQ(beyond(0.0, 0.25), 1u);
    EXPECT_EQ(beyond(1.0, 0.25), 0u);
    EXPECT_FALSE(compare_images(a, b, {0.5, 0.0, 24.9, {}}).same());
    EXPECT_TRUE(compare_images(a, b, {0.5, 0.0, 25.0, {}}).same());
}

TEST(Compare, ReferenceZeroEverywhereIsInfinitelyFar) {
    const auto zero = one_channel("Z", {0.0f, 0.0f}), one = one_channel("Z", {0.0f, 1.0f});
    EXPECT_EQ(compare_images(one, zero).all.relative_mse, infinity);
    EXPECT_EQ(compare_images(zero, zero).all.relative_mse, 0.0);
}

TEST(Compare, NanAndInfinityAreNeverTheSame) {
    const ChannelImage clean = grey_image(4, 4, 0.5f);
    for (const float bad : {float_nan, float_infinity, -float_infinity}) {
        ChannelImage damaged = clean;
        damaged.channels[1].values(2, 3) = bad;
        const CompareSettings lenient{1e30, 0.0, 100.0, {}};
        EXPECT_FALSE(compare_images(damaged, clean, lenient).same());
        EXPECT_FALSE(compare_images(clean, damaged, lenient).same());
        EXPECT_FALSE(compare_images(damaged, damaged, lenient).same());
        const CompareResult result = compare_images(damaged, clean, lenient);
        EXPECT_EQ(result.a.nan, std::isnan(bad) ? 1u : 0u);
        EXPECT_EQ(result.a.inf, std::isnan(bad) ? 0u : 1u);
        EXPECT_FALSE(result.b.any());
        EXPECT_EQ(result.all.max_abs, 0.0);
    }
}

TEST(Compare, OtherShapesAreErrors) {
    EXPECT_THROW(compare_images(grey_image(4, 4, 0.0f), grey_image(4, 5, 0.0f)), InputError);
    EXPECT_THROW(compare_images(grey_image(4, 4, 0.0f), {}), InputError);
    ChannelImage more = grey_image(4, 4, 0.0f);
    more.channels.push_back({"Z", Image<float>(4, 4)});
    const std::string message = find_refusal([&] { compare_images(grey_image(4, 4, 0.0f), more); }).message;
    EXPECT_NE(message.find("only the second [Z]"), std::string::npos) << message;
    EXPECT_TRUE(compare_images(grey_image(4, 4, 0.0f), more, {0.0, 0.0, 0.0, {"R", "G"}}).same());
    more.channels.push_back({"Z.X", Image<float>(4, 4)});
    EXPECT_EQ(find_refusal([&] {
                  compare_images(more, more, {0.0, 0.0, 0.0, {"N"}});
              }).reason,
              "is not in both pictures; both have [R, G, B, Z]");
}

TEST(Compare, ChannelsOfHowAPictureWasMadeMayBeMissing) {
    const ChannelImage plain = grey_image(4, 4, 0.5f);
    ChannelImage counted = plain;
    for (const char* name : {"variance.Y", "samples.Y", "records.Y", "invalid.Y", "cache.count", "cache.radius",
                             "error.Y", "error.direct"}) {
        counted.channels.push_back({name, Image<float>(4, 4, 3.0f)});
    }
    EXPECT_TRUE(compare_images(plain, counted).same());
    EXPECT_TRUE(compare_images(counted, plain).same());
    EXPECT_EQ(compare_images(counted, plain).channels.size(), 3u);
    // In both: counts are compared, the variance only if it is named.
    ChannelImage other = counted;
    other.channels[3].values(1, 1) = 9.0f;
    EXPECT_TRUE(compare_images(counted, other).same());
    EXPECT_FALSE(compare_images(counted, other, {0.0, 0.0, 0.0, {"variance"}}).same());
    other = counted;
    other.channels.back().values(1, 1) = 9.0f;
    EXPECT_TRUE(compare_images(counted, other).same());
    EXPECT_FALSE(compare_images(counted, other, {0.0, 0.0, 0.0, {"error"}}).same());
    other = counted;
    other.channels[4].values(1, 1) = 9.0f;
    EXPECT_FALSE(compare_images(counted, other).same());
    const ChannelImage only_counts{{{"samples.Y", Image<float>(4, 4, 3.0f)}}, {}};
    EXPECT_THROW(compare_images(one_channel("variance.Y", {1.0f}), one_channel("variance.Y", {1.0f})), InputError);
    EXPECT_THROW(compare_images(plain, only_counts), InputError);
}

TEST(Compare, LimitsHoldWhateverTheShare) {
    const ChannelImage b = grey_image(10, 10, 0.5f);
    ChannelImage a = b;
    a.channels[1].values(3, 4) = 0.75f;  // .25 in one of 100 pixels: RMS .025 in G
    const auto exceeded = [&](const CompareSettings& settings) { return compare_images(a, b, settings).exceeded; };
    using Names = std::vector<std::string>;
    EXPECT_EQ(exceeded({.share = 1.0}), Names{});
    EXPECT_EQ(exceeded({.share = 0.9}), Names{"share"});
    EXPECT_EQ(exceeded({.share = 1.0, .max_error = 0.25}), Names{});
    EXPECT_EQ(exceeded({.share = 1.0, .max_error = 0.249}), Names{"max_error"});
    EXPECT_EQ(exceeded({.share = 1.0, .max_rms = 0.025}), Names{});
    EXPECT_EQ(exceeded({.share = 1.0, .max_rms = 0.0249}), Names{"max_rms"});
    // Luminance: .25 * .7152 / 100 = .001788 of .5, squared errors .1788^2 / 100 / (.25 + .005^2).
    EXPECT_EQ(exceeded({.share = 1.0, .max_bias = 0.358}), Names{});
    EXPECT_EQ(exceeded({.share = 1.0, .max_bias = 0.357}), Names{"max_bias"});
    EXPECT_EQ(exceeded({.share = 1.0, .max_relative_mse = 0.00128}), Names{});
    EXPECT_EQ(exceeded({.share = 1.0, .max_relative_mse = 0.00127}), Names{"max_relative_mse"});
    EXPECT_THROW(compare_images(one_channel("Z", {1.0f}), one_channel("Z", {1.0f}), {.max_bias = 1.0}), InputError);
}

TEST(Compare, LayersNameTheirChannels) {
    ChannelImage a = one_channel("forward.u", {0.0f});
    a.channels.push_back({"forward.v", Image<float>(1, 1, 0.0f)});
    a.channels.push_back({"forwardness", Image<float>(1, 1, 0.0f)});
    const auto result = compare_images(a, a, {0.0, 0.0, 0.0, {"forward", "forward.u"}});
    ASSERT_EQ(result.channels.size(), 2u);
    EXPECT_EQ(result.channels[0].name, "forward.u");
    EXPECT_EQ(result.channels[1].name, "forward.v");
}

TEST(Compare, EqualPicturesAreTheSameInAnyOrderOfChannels) {
    ChannelImage a = grey_image(2, 2, 0.25f);
    a.channels[0].values(1, 1) = 0.5f;
    ChannelImage b = a;
    std::swap(b.channels[0], b.channels[2]);
    const CompareResult result = compare_images(a, b);
    EXPECT_TRUE(result.same());
    EXPECT_EQ(result.all.rms, 0.0);
    EXPECT_EQ(result.all.relative_mse, 0.0);
    EXPECT_EQ(result.beyond, 0u);
}

TEST(Compare, ThresholdMapDecidesWhatCounts) {
    const ChannelImage b = grey_image(4, 1, 0.5f);
    ChannelImage a = b;
    // Green carries .7152 of luminance: 100 * .7152 * .01 = .7152 cd/m2, three times that at x = 3.
    a.channels[1].values(1, 0) += 0.01f;
    a.channels[1].values(3, 0) += 0.03f;
    const auto map = threshold_map(4, 1, 1.0f);
    const CompareResult result = compare_images(a, b, {}, &map);
    ASSERT_TRUE(result.threshold.has_value());
    EXPECT_EQ(result.threshold->beyond, 1u);
    EXPECT_NEAR(result.threshold->worst, 2.1456, 1e-4);
    EXPECT_EQ(result.beyond, 2u);
    EXPECT_FALSE(result.same());
    EXPECT_TRUE(compare_images(a, b, {0.0, 0.0, 25.0, {}}, &map).same());
    const auto loose = threshold_map(4, 1, 3.0f);
    EXPECT_TRUE(compare_images(a, b, {}, &loose).same());
}

TEST(Compare, ThresholdUsesTheFilesWhiteLuminance) {
    ChannelImage b = grey_image(1, 1, 0.5f);
    const ChannelImage a = grey_image(1, 1, 0.52f);
    const auto map = threshold_map(1, 1, 3.0f);
    EXPECT_EQ(compare_images(a, b, {}, &map).threshold->beyond, 0u);  // 2 cd/m2
    b.metadata["whiteLuminance"] = 200.0;
    const auto brighter = compare_images(a, b, {}, &map);  // 4 cd/m2
    EXPECT_EQ(brighter.threshold->display_white, 200.0);
    EXPECT_EQ(brighter.threshold->beyond, 1u);
}

TEST(Compare, BrokenThresholdsCount) {
    const ChannelImage image = grey_image(3, 1, 0.5f);
    auto map = threshold_map(3, 1, 1.0f);
    map.channels[0].values(1, 0) = float_nan;
    map.channels[0].values(2, 0) = float_infinity;
    EXPECT_EQ(compare_images(image, image, {}, &map).threshold->beyond, 2u);
    const auto other_size = threshold_map(2, 1, 1.0f);
    EXPECT_THROW(compare_images(image, image, {}, &other_size), InputError);
    const auto no_threshold = one_channel("aleph.Y", {1.0f, 1.0f, 1.0f});
    EXPECT_THROW(compare_images(image, image, {}, &no_threshold), InputError);
}

TEST(Compare, EncodedPicturesAreMadeLinearForLuminance) {
    ChannelImage a = grey_image(1, 1, 188.0f / 255.0f), b = grey_image(1, 1, 0.0f);
    a.metadata["encoding"] = b.metadata["encoding"] = std::string("sRGB");
    const auto map = threshold_map(1, 1, 1.0f);
    EXPECT_NEAR(compare_images(a, b, {}, &map).threshold->worst, 50.289, 0.01);  // sRGB 188 is .50289 linear
}

TEST(Compare, AnEncodedPictureBesideALinearOneIsDecoded) {
    ChannelImage a = grey_image(1, 1, 188.0f / 255.0f);
    a.metadata["encoding"] = std::string("sRGB");
    const ChannelImage b = grey_image(1, 1, 0.50289f);
    EXPECT_TRUE(compare_images(a, b, {1e-4, 0.0, 0.0, {}}).same());
    EXPECT_TRUE(compare_images(b, a, {1e-4, 0.0, 0.0, {}}).same());
    ChannelImage c = grey_image(1, 1, 0.50289f);
    c.metadata["encoding"] = std::string("sRGB");
    EXPECT_FALSE(compare_images(a, c, {1e-4, 0.0, 0.0, {}}).same()) << "both are encoded: as they are stored";
}

TEST(Compare, DifferencePictureShowsWhereAndMarksNan) {
    ChannelImage b = grey_image(3, 1, 0.5f), a = b;
    a.channels[0].values(0, 0) = 0.75f;
    a.channels[2].values(1, 0) = 0.375f;
    a.channels[1].values(2, 0) = float_nan;
    const Image<Rgb> picture = difference_picture(a, b);
    EXPECT_EQ(picture(0, 0), Rgb(1.0f, 0.0f, 0.0f));
    EXPECT_EQ(picture(1, 0), Rgb(0.0f, 0.0f, 0.5f));
    EXPECT_EQ(picture(2, 0), Rgb(1.0f, 0.0f, 1.0f));
    const Image<Rgb> grey = difference_picture(one_channel("Z", {1.0f, 3.0f}), one_channel("Z", {0.0f, 1.0f}));
    EXPECT_EQ(grey(0, 0), Rgb(0.5f));
    EXPECT_EQ(grey(1, 0), Rgb(1.0f));
}

}  // namespace
}  // namespace aleph
