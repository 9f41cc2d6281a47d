// Light that further samples took from a pixel's mean goes to the pixels around.

#include "render/shade/resolve.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(LostLight, StaysOnItsObject) {
    Image<PixelSamples> pixels(7, 3);
    const auto add = [&](int x, int y, float value) {
        SampleLight light = grey_sample(value);
        light.place.instance = x < 4 ? 0 : 1;
        pixels(x, y).add(light);
    };
    for (const auto [x, y] : all_pixels(7, 3)) add(x, y, 1.0f);
    pixels(2, 1) = PixelSamples();
    add(2, 1, 37.0f);
    pixels(2, 1).keep_mean();
    pixels(2, 1).keep_mean();
    for (int i = 0; i < 8; ++i) add(2, 1, 1.0f);
    EXPECT_NEAR(luminance(pixels(2, 1).lost()), 32.0, 1e-4);
    spread_lost_light(pixels, {}, 2, 10.0);
    for (const auto [x, y] : all_pixels(7, 3)) {
        const double own = x == 2 && y == 1 ? 5.0 : 1.0;
        EXPECT_NEAR(luminance(pixels(x, y).mean()), own + (x < 4 ? 32.0 / 12.0 : 0.0), 1e-4) << x << " " << y;
    }
}

TEST(LostLight, OfAnOutlineStaysOnOutlinesWhateverTheirFirstSamplesSaw) {
    Image<PixelSamples> pixels(9, 3);
    Image<Outline> outlines(9, 3, Outline::none);
    SampleLight light = grey_sample(1.0f), other = grey_sample(28.0f);
    for (const auto [x, y] : all_pixels(9, 3)) {
        if (x == 4) outlines(x, y) = y == 1 ? Outline::still : Outline::moving;
        const bool is_bright = y == 1 && (x == 4 || x == 7);
        light.place.instance = other.place.instance = x == 4 ? y : 0;
        pixels(x, y).add(is_bright ? other : light);
        if (!is_bright) continue;
        pixels(x, y).keep_mean();
        for (int i = 0; i < 2; ++i) pixels(x, y).add(light);
    }
    spread_lost_light(pixels, outlines, 2, 100.0);
    for (const auto [x, y] : all_pixels(9, 3)) {
        const double own = y == 1 && (x == 4 || x == 7) ? 10.0 : 1.0;
        const double gained = x == 4 ? 18.0 / 3 : x > 4 ? 18.0 / 12 : 0.0;
        EXPECT_NEAR(luminance(pixels(x, y).mean()), own + gained, 1e-4) << x << " " << y;
    }
}

TEST(LostLight, IsTakenFromWhatThereIsAndNotFromTheBackground) {
    Image<PixelSamples> pixels(3, 1);
    SampleLight light = grey_sample(0.0f), background = grey_sample(0.5f);
    light.place.instance = 0;
    background.place.instance = no_index;
    pixels(0, 0).add(light);
    pixels(2, 0).add(background);
    pixels(1, 0).add(light);
    pixels(1, 0).keep_mean();
    light[LightPart::surface] = Rgb(3.0f);
    pixels(1, 0).add(light);
    EXPECT_FLOAT_EQ(luminance(pixels(1, 0).lost()), -1.5f);
    spread_lost_light(pixels, {}, 2, 10.0);
    EXPECT_EQ(pixels(0, 0).mean(), Rgb(0.0f));
    EXPECT_FLOAT_EQ(luminance(pixels(1, 0).mean()), 0.0f) << "no other pixel has light to take";
    EXPECT_FLOAT_EQ(luminance(pixels(2, 0).mean()), 0.5f);
}

TEST(LostLight, IsNoneWhereAChannelIsShownWhite) {
    Image<PixelSamples> pixels(2, 1);
    SampleLight light;
    light.place.instance = 0;
    pixels(0, 0).add(light);
    light[LightPart::surface] = Rgb(9.0f, 3.0f, 0.0f);
    pixels(1, 0).add(light);
    pixels(1, 0).keep_mean();
    light[LightPart::surface] = Rgb(7.0f, 1.0f, 0.0f);
    pixels(1, 0).add(light);
    spread_lost_light(pixels, {}, 1, 7.5);
    EXPECT_EQ(pixels(0, 0).mean(), Rgb(0.0f, 0.5f, 0.0f));
    EXPECT_EQ(pixels(1, 0).mean(), Rgb(8.0f, 2.5f, 0.0f));
}

}  // namespace
}  // namespace aleph
