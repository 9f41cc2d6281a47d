// Texture look-up over a footprint: pyramids, anisotropy, wrapping at every level.

#include "render/surface/texture.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

SceneImage make_noise(int width, int height, unsigned seed) {
    SceneImage image{.bytes = Image<glm::u8vec4>(width, height)};
    std::mt19937 random(seed);
    for (glm::u8vec4& texel : image.bytes.pixels) {
        for (int c = 0; c < 4; ++c) texel[c] = static_cast<std::uint8_t>(random() % 256u);
    }
    return image;
}

SceneImage make_constant(int width, int height, const glm::u8vec4& value) {
    return {.bytes = Image<glm::u8vec4>(width, height, value)};
}

TextureSet make_set(const SceneImage& image, TextureSpace space = TextureSpace::srgb) {
    TextureSet set;
    set.textures.push_back(make_texture(image, space));
    return set;
}

TextureUse make_use(Wrap wrap, bool nearest = false) {
    return make_texture_use({.image = 0, .wrap_u = wrap, .wrap_v = wrap, .nearest = nearest}, 0);
}

glm::dvec4 mean_of(const Image<glm::vec4>& image) {
    glm::dvec4 sum(0.0);
    for (const glm::vec4& texel : image.pixels) sum += glm::dvec4(texel);
    return sum / static_cast<double>(image.size());
}

glm::dvec4 mean_of(const TextureSet& set) {
    const Texture& texture = set.textures[0];
    Image<glm::vec4> all(texture.width, texture.height);
    for (const auto [x, y] : all_pixels(all)) {
        const glm::vec2 uv((static_cast<float>(x) + 0.5f) / static_cast<float>(all.width),
                           (static_cast<float>(y) + 0.5f) / static_cast<float>(all.height));
        all(x, y) = sample_texture(set, make_use(Wrap::clamp, true), uv, {});
    }
    return mean_of(all);
}

void expect_near(const glm::vec4& a, const glm::dvec4& b, double tolerance) {
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(a[c], b[c], tolerance) << c;
}

TEST(TextureFilter, EveryLevelHasTheSameMean) {
    for (const glm::ivec2 size :
         {glm::ivec2(64, 64), glm::ivec2(7, 5), glm::ivec2(1, 13), glm::ivec2(33, 2), glm::ivec2(127, 100)}) {
        for (const TextureSpace space : {TextureSpace::linear, TextureSpace::srgb}) {
            const SceneImage image = make_noise(size.x, size.y, 5);
            const TextureSet set = make_set(image, space);
            const glm::dvec4 mean = mean_of(set);
            const Texture& texture = set.textures[0];
            ASSERT_FALSE(texture.coarse.empty());
            EXPECT_EQ(texture.coarse.back().size(), 1u);
            for (const Image<glm::vec4>& level : texture.coarse) {
                for (int c = 0; c < 4; ++c) EXPECT_NEAR(mean_of(level)[c], mean[c], 1e-6) << level.width;
            }
        }
    }
}

TEST(TextureFilter, OddSizesKeepEveryTexelsPlace) {
    // A ramp stays a ramp: a coarse texel has the mean of the ramp over its own extent.
    SceneImage image{.floats = Image<glm::vec4>(7, 1)};
    for (int x = 0; x < 7; ++x) image.floats(x, 0) = glm::vec4(static_cast<float>(x) + 0.5f);
    const Texture texture = make_texture(image, TextureSpace::linear);
    ASSERT_EQ(texture.coarse.size(), 2u);
    EXPECT_EQ(texture.coarse[0].width, 3);
    // [0, 7/3]: texels 0 and 1 whole and a third of texel 2.
    EXPECT_NEAR(texture.coarse[0](0, 0).x, (0.5 + 1.5 + 2.5 / 3.0) / (7.0 / 3.0), 1e-6);
    EXPECT_NEAR(texture.coarse[0](1, 0).x, 3.5, 1e-6);
    EXPECT_NEAR(texture.coarse[1](0, 0).x, 3.5, 1e-6);
}

TEST(TextureFilter, ConstantPicturesStayExactly) {
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(16, 16), glm::ivec2(11, 3), glm::ivec2(1, 9)}) {
        const SceneImage image = make_constant(size.x, size.y, {200, 3, 77, 128});
        const TextureSet set = make_set(image);
        const glm::vec4 value = sample_texture(set, make_use(Wrap::repeat, true), {0.5f, 0.5f}, {});
        for (const Image<glm::vec4>& level : set.textures[0].coarse) {
            for (const glm::vec4& texel : level.pixels) EXPECT_EQ(texel, value);
        }
        std::mt19937 engine(3);
        std::uniform_real_distribution<float> any(-2.0f, 2.0f);
        for (int i = 0; i < 2000; ++i) {
            const Wrap wrap = static_cast<Wrap>(i % 3);
            const float size_of_print = std::pow(10.0f, any(engine));
            const UvFootprint print{{any(engine) * size_of_print, any(engine)}, {any(engine), any(engine)}, i % 2 == 0};
            const glm::vec4 found = sample_texture(set, make_use(wrap, i % 5 == 0), {any(engine), any(engine)}, print);
            for (int c = 0; c < 4; ++c) ASSERT_NEAR(found[c], value[c], 4e-7f * value[c]);
        }
    }
}

/// A card whose texture shows white texels, and black ones of alpha 0 that do not.
Scene make_card(const Opacity& opacity) {
    Scene scene;
    SceneImage& image = scene.images.emplace_back(make_constant(8, 8, {255, 255, 255, 255}));
    for (const auto [x, y] : all_pixels(image.bytes))
        if ((x / 2 + y / 2) % 2 == 1) image.bytes(x, y) = glm::u8vec4(0);
    Material& material = scene.materials.emplace_back();
    material.textures[TextureSlot::base_color].image = 0;
    material.opacity = opacity;
    Mesh& mesh = scene.meshes.emplace_back();
    mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    mesh.triangles = {{0, 1, 2}};
    mesh.material = 0;
    scene.nodes.push_back({.meshes = {0}});
    return scene;
}

TEST(TextureFilter, ColorsOfHolesDoNotCount) {
    using Mode = Opacity::Mode;
    constexpr UvFootprint whole{{1.0f, 0.0f}, {0.0f, 1.0f}}, cone{{1.0f, 0.0f}, {0.0f, 1.0f}, true},
        row{{1.0f, 0.0f}, {0.0f, 0.01f}}, small{{0.01f, 0.0f}, {0.0f, 0.01f}};
    const struct {
        Opacity opacity;
        bool counts;
    } cases[] = {{{.mode = Mode::opaque}, true},
                 {{.mode = Mode::mask}, false},
                 {{.mode = Mode::mask, .cutoff = 0.0}, true},
                 {{.mode = Mode::blend}, false}};
    for (const auto& [opacity, counts] : cases) {
        const Scene scene = make_card(opacity);
        const TextureSet set = make_texture_set(scene);
        const TextureUse& use = set.materials[0][TextureSlot::base_color];
        for (const UvFootprint& footprint : {whole, cone, row, small}) {
            // The middle of four fields: half of what is around it shows.
            const glm::vec4 found = sample_texture(set, use, {0.5f, 0.5f}, footprint);
            expect_near(found, glm::dvec4(glm::dvec3(counts ? 0.5 : 1.0), 0.5), 1e-5);
        }
        const glm::vec4 hole = sample_texture(set, use, {0.375f, 0.125f}, small);
        expect_near(hole, glm::dvec4(0.0), 0.0);
    }
}

/// Light and gloss of holes do not count either, also in pictures of fewer texels; a value in alpha stays itself.
TEST(TextureFilter, OtherTexturesHaveTheHolesOfTheBaseColor) {
    constexpr UvFootprint whole{{1.0f, 0.0f}, {0.0f, 1.0f}};
    for (const int side : {4, 8}) {
        Scene scene = make_card({.mode = Opacity::Mode::mask});
        SceneImage& image = scene.images.emplace_back(make_constant(side, side, {255, 255, 255, 255}));
        for (const auto [x, y] : all_pixels(image.bytes))
            if ((4 * x / side + 4 * y / side) % 2 == 1) image.bytes(x, y) = glm::u8vec4(0);
        for (const TextureSlot slot : {TextureSlot::emission, TextureSlot::metallic_roughness, TextureSlot::specular})
            scene.materials[0].textures[slot].image = 1;
        const auto find = [&](TextureSlot slot) {
            const TextureSet set = make_texture_set(scene);
            return sample_texture(set, set.materials[0][slot], {0.5f, 0.5f}, whole);
        };
        const auto expect_value = [&](TextureSlot slot, double value) {
            expect_near({glm::vec3(find(slot)), 1.0f}, {glm::dvec3(value), 1.0}, 1e-5);
        };
        for (const TextureSlot slot : {TextureSlot::emission, TextureSlot::metallic_roughness}) expect_value(slot, 1.0);
        EXPECT_NEAR(find(TextureSlot::specular).w, 0.5f, 1e-5f);
        scene.materials[0].textures[TextureSlot::emission].uv_offset.x = 0.5;
        expect_value(TextureSlot::emission, 0.5);
        scene.materials[0].opacity.mode = Opacity::Mode::opaque;
        expect_value(TextureSlot::metallic_roughness, 0.5);
    }
}

TEST(TextureFilter, MagnificationIsBilinearWhateverTheFootprint) {
    const SceneImage image = make_noise(16, 8, 1);
    const TextureSet set = make_set(image);
    const TextureUse use = make_use(Wrap::repeat), nearest = make_use(Wrap::repeat, true);
    // Just under a texel, in any direction.
    for (int i = 0; i < 64; ++i) {
        const float angle = 0.1f * static_cast<float>(i);
        const glm::vec2 along(0.99f * std::cos(angle) / 16.0f, 0.99f * std::sin(angle) / 8.0f);
        const glm::vec2 uv(0.173f * static_cast<float>(i), 0.031f * static_cast<float>(i));
        EXPECT_EQ(sample_texture(set, use, uv, {along, {0.0f, 0.0f}}), sample_texture(set, use, uv, {}));
        EXPECT_EQ(sample_texture(set, nearest, uv, {along, {0.0f, 0.0f}}), sample_texture(set, nearest, uv, {}));
    }
    // Above that, `nearest` filters too.
    const UvFootprint wide{{0.25f, 0.0f}, {0.0f, 0.25f}};
    EXPECT_EQ(sample_texture(set, use, {0.3f, 0.6f}, wide), sample_texture(set, nearest, {0.3f, 0.6f}, wide));
}

TEST(TextureFilter, TheWholePictureIsItsMean) {
    const SceneImage image = make_noise(32, 32, 2);
    const TextureSet set = make_set(image);
    const glm::dvec4 mean = mean_of(set);
    for (const Wrap wrap : {Wrap::repeat, Wrap::mirror, Wrap::clamp}) {
        for (const bool round : {false, true}) {
            for (const float size : {1.5f, 3.7f, 1e3f, 1e20f, float_infinity, float_nan}) {
                expect_near(sample_texture(set, make_use(wrap), {0.41f, 0.77f}, {{size, 0.0f}, {0.0f, size}, round}),
                            mean, 1e-5);
            }
        }
    }
}

/// A long footprint must not blur across its length: stripes along it are kept, stripes across it average out.
TEST(TextureFilter, LongFootprintsBlurOnlyAlongThemselves) {
    SceneImage image{.bytes = Image<glm::u8vec4>(64, 64)};
    for (const auto [x, y] : all_pixels(64, 64)) image.bytes(x, y) = glm::u8vec4((y / 4) % 2 == 0 ? 255 : 0);
    const TextureSet set = make_set(image, TextureSpace::linear);
    const TextureUse use = make_use(Wrap::repeat);
    const float texel = 1.0f / 64.0f;
    for (int row = 0; row < 16; ++row) {
        const glm::vec2 uv(0.3f, (4.0f * static_cast<float>(row) + 2.0f) * texel);  // a stripe's middle
        const float stripe = row % 2 == 0 ? 1.0f : 0.0f;
        EXPECT_NEAR(sample_texture(set, use, uv, {{16.0f * texel, 0.0f}, {0.0f, texel}}).x, stripe, 1e-6f);
        EXPECT_NEAR(sample_texture(set, use, uv, {{0.0f, texel}, {-16.0f * texel, 0.0f}}).x, stripe, 1e-6f);
        EXPECT_NEAR(sample_texture(set, use, uv, {{texel, 0.0f}, {0.0f, 16.0f * texel}}).x, 0.5f, 0.04f);
        // As a round footprint of the same area, 64 texels, it covers most of a stripe's period and keeps half of it.
        EXPECT_NEAR(sample_texture(set, use, uv, {{64.0f * texel, 0.0f}, {0.0f, texel}, true}).x, 0.5f, 0.26f);
    }
}

TEST(TextureFilter, DiagonalAxesAreFound) {
    // Stripes along the diagonal u + v: a footprint along u - v keeps them.
    SceneImage image{.bytes = Image<glm::u8vec4>(64, 64)};
    for (const auto [x, y] : all_pixels(64, 64)) {
        image.bytes(x, y) = glm::u8vec4(static_cast<int>(127.5 + 127.0 * std::sin((x + y) * std::numbers::pi / 8)));
    }
    const TextureSet set = make_set(image, TextureSpace::linear);
    const TextureUse use = make_use(Wrap::repeat);
    const glm::vec2 along = glm::vec2(1.0f, -1.0f) / 64.0f, across = glm::vec2(1.0f, 1.0f) / 64.0f;
    double kept = 0.0, lost = 0.0, true_range = 0.0;
    for (int i = 0; i < 16; ++i) {
        const glm::vec2 uv = glm::vec2(static_cast<float>(i) + 0.5f, 7.5f) / 64.0f;
        const float here = sample_texture(set, use, uv, {}).x - 0.5f;
        true_range += std::abs(here);
        kept += std::abs(sample_texture(set, use, uv, {along * 12.0f, across * 0.6f}).x - 0.5f);
        lost += std::abs(sample_texture(set, use, uv, {along * 0.6f, across * 8.0f}).x - 0.5f);
    }
    EXPECT_GT(kept, 0.9 * true_range);
    EXPECT_LT(lost, 0.15 * true_range);
}

TEST(TextureFilter, WrapModesAtEveryLevelsBorders) {
    // Left half black, right half white. At u = 0, repeat averages both; clamp and mirror find black only.
    SceneImage image{.bytes = Image<glm::u8vec4>(64, 64, glm::u8vec4(0))};
    for (int y = 0; y < 64; ++y) {
        for (int x = 32; x < 64; ++x) image.bytes(x, y) = glm::u8vec4(255);
    }
    const TextureSet set = make_set(image, TextureSpace::linear);
    for (const float texels : {1.0f, 2.0f, 4.0f, 8.0f, 16.0f}) {
        for (const bool round : {false, true}) {
            const UvFootprint print{{texels / 64.0f, 0.0f}, {0.0f, texels / 64.0f}, round};
            for (const float turns : {0.0f, 1.0f, -3.0f}) {
                EXPECT_NEAR(sample_texture(set, make_use(Wrap::repeat), {turns, 0.5f}, print).x, 0.5f, 1e-6f);
            }
            EXPECT_EQ(sample_texture(set, make_use(Wrap::clamp), {0.0f, 0.5f}, print).x, 0.0f);
            EXPECT_EQ(sample_texture(set, make_use(Wrap::clamp), {-7.0f, 0.5f}, print).x, 0.0f);
            EXPECT_EQ(sample_texture(set, make_use(Wrap::clamp), {1.0f, 0.5f}, print).x, 1.0f);
            EXPECT_EQ(sample_texture(set, make_use(Wrap::mirror), {2.0f, 0.5f}, print).x, 0.0f);
            EXPECT_EQ(sample_texture(set, make_use(Wrap::mirror), {-1.0f, 0.5f}, print).x, 1.0f);
        }
    }
}

TEST(TextureFilter, TheReferencesTransformMovesTheFootprint) {
    const SceneImage image = make_noise(64, 64, 9);
    const TextureSet set = make_set(image);
    TextureRef reference{.image = 0};
    reference.uv_offset = {0.3, -0.2};
    reference.uv_scale = {4.0, 0.5};
    reference.uv_rotation = 0.7;
    const TextureUse use = make_texture_use(reference, 0), plain = make_use(Wrap::repeat);
    for (const bool round : {false, true}) {
        const UvFootprint print{{0.05f, 0.01f}, {-0.02f, 0.08f}, round};
        const UvFootprint moved{use.matrix * print.dx, use.matrix * print.dy, round};
        const glm::vec2 uv(0.21f, 0.63f);
        EXPECT_EQ(sample_texture(set, use, uv, print), sample_texture(set, plain, use.offset + use.matrix * uv, moved));
    }
}

TEST(TextureFilter, TexelsThatAreNoNumbersDoNotSpread) {
    SceneImage image{.floats = Image<glm::vec4>(4, 4, glm::vec4(1.0f))};
    image.floats(1, 2) = glm::vec4(float_nan, float_infinity, 1.0f, 1.0f);
    const Texture texture = make_texture(image, TextureSpace::linear);
    EXPECT_EQ(texture.coarse.back()(0, 0), glm::vec4(15.0f / 16.0f, 15.0f / 16.0f, 1.0f, 1.0f));
}

}  // namespace
}  // namespace aleph
