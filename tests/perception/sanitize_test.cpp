#include "perception/sanitize.h"
#include "engine/base/sampling.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(Sanitize, LeavesAGoodFrameAlone) {
    Image<Rgb> image(64, 48);
    RandomStream random({1, 0, 0, 0});
    for (Rgb& c : image.pixels) c = Rgb(random.next(), random.next(), random.next());
    const Image<Rgb> before = image;
    const SanitizeCounts counts = sanitize_estimate(image);
    EXPECT_EQ(image, before);
    EXPECT_EQ(counts.replaced + counts.clamped, 0u);
}

TEST(Sanitize, UniformAndBlackFramesStayUntouched) {
    for (const float grey : {0.0f, 1e-30f, 0.7f, 1e20f}) {
        Image<Rgb> image(80, 60, Rgb(grey));
        EXPECT_EQ(sanitize_estimate(image).clamped, 0u);
        EXPECT_EQ(image, Image<Rgb>(80, 60, Rgb(grey)));
    }
    Image<Rgb> none;
    EXPECT_EQ(sanitize_estimate(none).replaced, 0u);
}

TEST(Sanitize, NegativeComponentsBecomeZero) {
    Image<Rgb> image(3, 1, Rgb(-1.0f, 0.5f, -0.0f));
    sanitize_estimate(image);
    EXPECT_EQ(image(0, 0), Rgb(0.0f, 0.5f, 0.0f));
}

TEST(Sanitize, PY05_HolesFillFromTheirRim) {
    Image<Rgb> image(30, 20, Rgb(0.25f, 0.5f, 0.75f));
    for (int y = 5; y < 15; ++y) {
        for (int x = 8; x < 20; ++x) image(x, y) = Rgb(0.1f, float_nan, float_infinity);
    }
    EXPECT_EQ(sanitize_estimate(image).replaced, 120u);
    EXPECT_EQ(image, Image<Rgb>(30, 20, Rgb(0.25f, 0.5f, 0.75f)));
}

TEST(Sanitize, PY05_FrameWithoutAnyValidPixelBecomesBlack) {
    Image<Rgb> image(5, 4, Rgb(float_infinity));
    EXPECT_EQ(sanitize_estimate(image).replaced, 20u);
    EXPECT_EQ(image, Image<Rgb>(5, 4, Rgb(0.0f)));
}

TEST(Sanitize, PY05_OneValidPixelFillsTheRest) {
    Image<Rgb> image(9, 7, Rgb(float_nan));
    image(8, 0) = Rgb(0.3f, 0.2f, 0.1f);
    EXPECT_EQ(sanitize_estimate(image).replaced, 62u);
    EXPECT_EQ(image, Image<Rgb>(9, 7, Rgb(0.3f, 0.2f, 0.1f)));
}

TEST(Sanitize, PY07_FirefliesAreScaledToTenTimesTheQuantile) {
    Image<Rgb> image(100, 100);
    for (std::size_t i = 0; i < image.size(); ++i) image.pixels[i] = Rgb(static_cast<float>(i + 1) / 10000.0f);
    image(50, 50) = Rgb(4e5f, 2e5f, 1e5f);
    // Nearest rank: the 9,990th of the 10,000 luminances in order. The firefly took the place of .5051.
    const double limit = 10.0 * luminance(Rgb(0.9991f));
    EXPECT_EQ(sanitize_estimate(image).clamped, 1u);
    EXPECT_NEAR(luminance(image(50, 50)) / limit, 1.0, 1e-6);
    EXPECT_NEAR(image(50, 50).x / image(50, 50).y, 2.0, 1e-6);  // the hue does not change
    EXPECT_NEAR(image(50, 50).y / image(50, 50).z, 2.0, 1e-6);
}

TEST(Sanitize, PY07_HugeFiniteFireflyIsClampedToo) {
    Image<Rgb> image(100, 100, Rgb(0.5f));
    image(3, 4) = Rgb(std::numeric_limits<float>::max());
    EXPECT_EQ(sanitize_estimate(image).clamped, 1u);
    EXPECT_NEAR(luminance(image(3, 4)), 5.0, 1e-4);
}

TEST(Sanitize, PY07_MostlyBlackFrameKeepsItsFewLitPixels) {
    Image<Rgb> image(400, 300);
    for (int x = 0; x < 20; ++x) image(100 + x, 100) = Rgb(0.5f + 0.01f * static_cast<float>(x));
    const Image<Rgb> before = image;
    EXPECT_EQ(sanitize_estimate(image).clamped, 0u);
    EXPECT_EQ(image, before);
}

}  // namespace
}  // namespace aleph
