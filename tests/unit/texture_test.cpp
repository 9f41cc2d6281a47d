// Texture look-up: texel centres, interpolation, wrapping, colour spaces, coordinates that are no numbers.

#include "render/texture.h"

#include <gtest/gtest.h>

#include <limits>

#include "engine/base/color.h"

namespace aleph {
namespace {

/// Float image of one row: texel i holds i.
Scene make_ramp(int width, int height = 1) {
    Scene scene;
    SceneImage image;
    image.floats = Image<glm::vec4>(width, height);
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) image.floats(x, y) = glm::vec4(x, y, 0.0f, 1.0f);
    }
    scene.images.push_back(image);
    return scene;
}

float look_up(const Scene& scene, Wrap wrap, float u, bool nearest = false, float v = 0.5f) {
    const TextureRef texture{.image = 0, .wrap_u = wrap, .wrap_v = wrap, .nearest = nearest};
    return sample_texture(scene, texture, {u, v}, TextureSpace::linear).x;
}

TEST(Texture, CentresAndBetween) {
    const Scene scene = make_ramp(4, 2);
    const TextureRef texture{.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    for (int y = 0; y < 2; ++y) {
        for (int x = 0; x < 4; ++x) {
            const glm::vec2 uv((static_cast<float>(x) + 0.5f) / 4.0f, (static_cast<float>(y) + 0.5f) / 2.0f);
            // v grows downwards: row 0 of the image at v = 0.
            EXPECT_EQ(sample_texture(scene, texture, uv, TextureSpace::linear), glm::vec4(x, y, 0.0f, 1.0f));
        }
    }
    EXPECT_FLOAT_EQ(sample_texture(scene, texture, {0.5f, 0.5f}, TextureSpace::linear).x, 1.5f);
    EXPECT_FLOAT_EQ(sample_texture(scene, texture, {0.5f, 0.5f}, TextureSpace::linear).y, 0.5f);
    EXPECT_FLOAT_EQ(sample_texture(scene, texture, {0.3125f, 0.5f}, TextureSpace::linear).x, 0.75f);
}

TEST(Texture, WrapModesBilinear) {
    const Scene scene = make_ramp(4);
    // u = 0 lies between texels 3 and 0 when repeated, at 0 when clamped, between 0 and 0 when mirrored.
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::repeat, 0.0f), 1.5f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::repeat, 1.0f), 1.5f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::clamp, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::clamp, 1.0f), 3.0f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::mirror, 0.0f), 0.0f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::mirror, 1.0f), 3.0f);
    for (const float u : {0.125f, 0.3f, 0.61f, 0.9f}) {
        const float inside = look_up(scene, Wrap::repeat, u);
        for (const float turns : {-3.0f, -1.0f, 1.0f, 2.0f, 7.0f}) {
            EXPECT_NEAR(look_up(scene, Wrap::repeat, u + turns), inside, 1e-5f);
        }
        const float seen = look_up(scene, Wrap::mirror, u);
        EXPECT_NEAR(look_up(scene, Wrap::mirror, -u), seen, 1e-5f);
        EXPECT_NEAR(look_up(scene, Wrap::mirror, 2.0f - u), seen, 1e-5f);
        EXPECT_NEAR(look_up(scene, Wrap::mirror, 2.0f + u), seen, 1e-5f);
    }
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::clamp, -5.0f), 0.0f);
    EXPECT_FLOAT_EQ(look_up(scene, Wrap::clamp, 5.0f), 3.0f);
}

TEST(Texture, NearestTakesTheTexelThatHolds) {
    const Scene scene = make_ramp(4);
    for (int i = 0; i < 40; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 40.0f;
        EXPECT_EQ(look_up(scene, Wrap::clamp, u, true), static_cast<float>(i / 10));
        EXPECT_EQ(look_up(scene, Wrap::repeat, u + 1.0f, true), static_cast<float>(i / 10));
        EXPECT_EQ(look_up(scene, Wrap::mirror, u + 1.0f, true), static_cast<float>(3 - i / 10));
    }
    EXPECT_EQ(look_up(scene, Wrap::clamp, 1.0f, true), 3.0f);
    EXPECT_EQ(look_up(scene, Wrap::repeat, 1.0f, true), 0.0f);
    EXPECT_EQ(look_up(scene, Wrap::repeat, -1e-9f, true), 0.0f);
}

TEST(Texture, EightBitColoursAreDecodedBeforeInterpolating) {
    Scene scene;
    SceneImage image;
    image.bytes = Image<glm::u8vec4>(2, 1);
    image.bytes(0, 0) = glm::u8vec4(0, 0, 0, 0);
    image.bytes(1, 0) = glm::u8vec4(255, 188, 10, 128);
    scene.images.push_back(image);
    const TextureRef texture{.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    const glm::vec4 srgb = sample_texture(scene, texture, {0.75f, 0.5f}, TextureSpace::srgb);
    EXPECT_FLOAT_EQ(srgb.x, 1.0f);
    EXPECT_FLOAT_EQ(srgb.y, srgb_to_linear(188.0f / 255.0f));
    EXPECT_FLOAT_EQ(srgb.z, 10.0f / 255.0f / 12.92f);
    EXPECT_FLOAT_EQ(srgb.w, 128.0f / 255.0f);  // alpha is never encoded
    const glm::vec4 linear = sample_texture(scene, texture, {0.75f, 0.5f}, TextureSpace::linear);
    EXPECT_FLOAT_EQ(linear.y, 188.0f / 255.0f);
    EXPECT_FLOAT_EQ(sample_texture(scene, texture, {0.5f, 0.5f}, TextureSpace::srgb).y, 0.5f * srgb.y);
}

TEST(Texture, CoordinatesThatAreNoPlaces) {
    const Scene scene = make_ramp(4, 3);
    const float infinite = std::numeric_limits<float>::infinity();
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        const float at_zero = look_up(scene, wrap, 0.0f, false, 0.0f);
        for (const float bad : {std::nanf(""), infinite, -infinite, 3e38f, -3e38f, 1e12f}) {
            EXPECT_EQ(look_up(scene, wrap, bad, false, 0.0f), at_zero);
            EXPECT_EQ(look_up(scene, wrap, 0.0f, true, bad), look_up(scene, wrap, 0.0f, true, 0.0f));
        }
        for (const float big : {999'999.0f, -999'999.0f, 65'536.5f}) {
            const float value = look_up(scene, wrap, big);
            EXPECT_GE(value, 0.0f);
            EXPECT_LE(value, 3.0f);
        }
    }
}

TEST(Texture, NoImageIsWhite) {
    Scene scene;
    EXPECT_EQ(sample_texture(scene, TextureRef{}, {0.5f, 0.5f}, TextureSpace::srgb), glm::vec4(1.0f));
    scene.images.emplace_back();  // a picture without pixels
    EXPECT_EQ(sample_texture(scene, TextureRef{.image = 0}, {0.5f, 0.5f}, TextureSpace::srgb), glm::vec4(1.0f));
}

}  // namespace
}  // namespace aleph
