// Texture look-up at a point: texel centres, interpolation, wrapping, colour spaces, the reference's transform,
// coordinates that are not finite. texture_filter_test.cpp tests footprints.

#include "render/surface/texture.h"
#include "engine/base/color.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Float image of one row: texel i holds i.
Scene make_ramp(int width, int height = 1) {
    Scene scene;
    SceneImage image{.floats = Image<glm::vec4>(width, height)};
    for (const auto [x, y] : all_pixels(width, height)) image.floats(x, y) = glm::vec4(x, y, 0.0f, 1.0f);
    scene.images.push_back(image);
    return scene;
}

glm::vec4 sample(const Scene& scene, const TextureRef& reference, const glm::vec2& uv,
                 TextureSpace space = TextureSpace::linear) {
    TextureSet set;
    set.textures.push_back(make_texture(scene.images[reference.image], space));
    return sample_texture(set, make_texture_use(reference, 0), uv, {});
}

float look_up(const Scene& scene, Wrap wrap, float u, bool nearest = false, float v = 0.5f) {
    const TextureRef texture{.image = 0, .wrap_u = wrap, .wrap_v = wrap, .nearest = nearest};
    return sample(scene, texture, {u, v}).x;
}

TEST(Texture, CentresAndBetween) {
    const Scene scene = make_ramp(4, 2);
    const TextureRef texture{.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    for (const auto [x, y] : all_pixels(4, 2)) {
        const glm::vec2 uv((static_cast<float>(x) + 0.5f) / 4.0f, (static_cast<float>(y) + 0.5f) / 2.0f);
        // v grows downwards: row 0 of the image at v = 0.
        EXPECT_EQ(sample(scene, texture, uv), glm::vec4(x, y, 0.0f, 1.0f));
    }
    EXPECT_FLOAT_EQ(sample(scene, texture, {0.5f, 0.5f}).x, 1.5f);
    EXPECT_FLOAT_EQ(sample(scene, texture, {0.5f, 0.5f}).y, 0.5f);
    EXPECT_FLOAT_EQ(sample(scene, texture, {0.3125f, 0.5f}).x, 0.75f);
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
    SceneImage image{.bytes = Image<glm::u8vec4>(2, 1)};
    image.bytes(0, 0) = glm::u8vec4(0, 0, 0, 0);
    image.bytes(1, 0) = glm::u8vec4(255, 188, 10, 128);
    scene.images.push_back(image);
    const TextureRef texture{.image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp};
    const glm::vec4 srgb = sample(scene, texture, {0.75f, 0.5f}, TextureSpace::srgb);
    EXPECT_FLOAT_EQ(srgb.x, 1.0f);
    EXPECT_FLOAT_EQ(srgb.y, srgb_to_linear(188.0f / 255.0f));
    EXPECT_FLOAT_EQ(srgb.z, 10.0f / 255.0f / 12.92f);
    EXPECT_FLOAT_EQ(srgb.w, 128.0f / 255.0f);  // alpha is never encoded
    const glm::vec4 linear = sample(scene, texture, {0.75f, 0.5f});
    EXPECT_FLOAT_EQ(linear.y, 188.0f / 255.0f);
    EXPECT_FLOAT_EQ(sample(scene, texture, {0.5f, 0.5f}, TextureSpace::srgb).y, 0.5f * srgb.y);
}

TEST(Texture, CoordinatesThatAreNoPlaces) {
    const Scene scene = make_ramp(4, 3);
    for (const Wrap wrap : {Wrap::repeat, Wrap::clamp, Wrap::mirror}) {
        const float at_zero = look_up(scene, wrap, 0.0f, false, 0.0f);
        for (const float bad : {float_nan, float_infinity, -float_infinity, 3e38f, -3e38f, 1e12f}) {
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
    scene.images.emplace_back();  // a picture without pixels
    scene.materials.resize(2);
    scene.materials[1].textures[TextureSlot::base_color].image = 0;
    const TextureSet set = make_texture_set(scene);
    ASSERT_EQ(set.materials.size(), 3u);  // one more for meshes without a material
    for (const MaterialTextures& textures : set.materials) {
        EXPECT_FALSE(textures.any);
        EXPECT_EQ(sample_texture(set, textures[TextureSlot::base_color], {0.5f, 0.5f}, {}), glm::vec4(1.0f));
    }
}

/// How many pyramids there are for a picture on a mesh below two nodes.
template <class Change>
std::size_t count_pyramids(const Change& change) {
    Scene scene = make_ramp(4, 4);
    scene.materials.resize(1);
    scene.materials[0].textures[TextureSlot::base_color].image = 0;
    scene.meshes.resize(1);
    scene.meshes[0].material = 0;
    scene.nodes.resize(2);
    scene.nodes[1].parent = 0;
    scene.nodes[1].meshes = {0};
    change(scene);
    const TextureSet set = make_texture_set(scene);
    EXPECT_EQ(set.materials[0].any, !set.textures.empty());
    return set.textures.size();
}

TEST(Texture, WhatIsNeverShownHasNoPyramid) {
    EXPECT_EQ(count_pyramids([](Scene&) {}), 1u);
    EXPECT_EQ(count_pyramids([](Scene& s) { s.meshes[0].material = no_index; }), 0u);
    EXPECT_EQ(count_pyramids([](Scene& s) { s.nodes[1].meshes.clear(); }), 0u);
    EXPECT_EQ(count_pyramids([](Scene& s) { s.nodes[1].visible = 0.0; }), 0u);
    EXPECT_EQ(count_pyramids([](Scene& s) { s.meshes[0].present = 0.0; }), 0u);
    EXPECT_EQ(count_pyramids([](Scene& s) { s.nodes[0].visible = 0.0; }), 0u) << "below a hidden node";
    const auto show_explicitly = [](Scene& s) {
        s.nodes[0].visible = 0.0;
        s.nodes[1].visible = 2.0;
    };
    EXPECT_EQ(count_pyramids(show_explicitly), 1u);
    const auto show_late = [](Scene& s) {
        s.nodes[0].visible.values = {0.0, 0.0, 1.0};
        s.nodes[0].visible.interpolation = Interpolation::step;
    };
    EXPECT_EQ(count_pyramids(show_late), 1u) << "at some time";
}

TEST(Texture, OnePyramidForEachPictureAndSpace) {
    Scene scene = make_ramp(4, 4);
    scene.images.emplace_back();
    scene.images[1].bytes = Image<glm::u8vec4>(8, 2, glm::u8vec4(10));
    Material material;
    material.textures[TextureSlot::base_color].image = material.textures[TextureSlot::metallic_roughness].image =
        0;  // float: one texture for both spaces
    material.textures[TextureSlot::emission].image = material.textures[TextureSlot::specular_color].image =
        1;                                               // both sRGB
    material.textures[TextureSlot::specular].image = 1;  // linear
    scene.materials = {material, material};
    scene.meshes.resize(2);
    scene.nodes.resize(1);
    scene.nodes[0].meshes = {0, 1};
    for (int i = 0; i < 2; ++i) scene.meshes[i].material = i;
    const TextureSet set = make_texture_set(scene);
    EXPECT_EQ(set.textures.size(), 3u);
    EXPECT_EQ(set.materials[0][TextureSlot::base_color].texture,
              set.materials[1][TextureSlot::metallic_roughness].texture);
    EXPECT_EQ(set.materials[0][TextureSlot::emission].texture, set.materials[0][TextureSlot::specular_color].texture);
    EXPECT_NE(set.materials[0][TextureSlot::emission].texture, set.materials[0][TextureSlot::specular].texture);
    const Texture& wide = set.textures[set.materials[0][TextureSlot::specular].texture];
    ASSERT_EQ(wide.coarse.size(), 3u);  // 8x2, 4x1, 2x1, 1x1
    EXPECT_EQ(wide.coarse[1].width, 2);
    EXPECT_EQ(wide.coarse[1].height, 1);
}

/// No surface reflects or passes more light than it gets, and none a negative amount.
TEST(Texture, ValuesOutsideOfZeroToOneAreShares) {
    for (const float value : {3.0f, -2.0f}) {
        Scene scene;
        scene.images.push_back({.floats = Image<glm::vec4>(1, 1, glm::vec4(value))});
        Material material{.gloss = {.metallic = 0.5, .roughness = 0.8},
                          .glass = {.transmission = 0.4},
                          .layers = {.clearcoat = 0.7,
                                     .clearcoat_roughness = 0.9,
                                     .sheen_color = {glm::dvec3(0.6)},
                                     .sheen_roughness = 0.9,
                                     .anisotropy = 0.8}};
        for (const MaterialTexture& texture : material_textures)
            if (!is_normal_map(texture.slot)) material.textures[texture.slot].image = 0;
        scene.materials.push_back(material);
        add_mesh(scene, make_quad(2.0, 2.0, 0), {0.0, 0.0, -1.0});
        const Stage stage(std::move(scene));
        RayTask task(stage.rays);
        const glm::vec3 forward(0.0f, 0.0f, -1.0f);
        const Hit hit = task.tracer.intersect({glm::vec3(-stage.shading.anchor), forward});
        ASSERT_NE(hit.instance, no_index);
        const SurfaceMaterial m = evaluate_material(stage.shading, make_surface_point(stage.shading, hit, forward), {});
        for (const Rgb& share : {m.diffuse, m.gloss.f0, m.glass.tint, m.sheen.color}) {
            EXPECT_GE(std::min({share.x, share.y, share.z}), 0.0f) << value;
            EXPECT_LE(largest_channel(share), 1.0f) << value;
        }
        for (const float share : {m.gloss.f90, m.gloss.alpha, m.gloss.stretch, m.glass.share, m.glass.specular,
                                  m.coat.strength, m.coat.alpha, m.sheen.alpha}) {
            EXPECT_GE(share, 0.0f) << value;
            EXPECT_LE(share, 1.0f) << value;
        }
    }
}

/// KHR_texture_transform: offset, then rotation, then scale, as columns of what acts on (u, v, 1). Its worked example:
/// the lower left quarter of the picture, turned clockwise by 90 degrees.
TEST(Texture, TransformFollowsTheExtension) {
    const Scene scene = make_ramp(8, 8);
    TextureRef reference{.image = 0, .nearest = true};
    reference.uv_offset = {0.0, 1.0};
    reference.uv_rotation = 1.57079632679;
    reference.uv_scale = {0.5, 0.5};
    // The mesh's left edge, read downwards, is the picture's lower edge from the left.
    for (int i = 0; i < 4; ++i) {
        const float along = (static_cast<float>(i) + 0.5f) / 4.0f;
        EXPECT_EQ(sample(scene, reference, {0.01f, along}), glm::vec4(i, 7, 0, 1)) << i;
        EXPECT_EQ(sample(scene, reference, {along, 0.99f}), glm::vec4(3, 7 - i, 0, 1)) << i;
    }
    // Its other one: v from the bottom up.
    reference = {.image = 0, .nearest = true};
    reference.uv_offset = {0.0, 1.0};
    reference.uv_scale = {1.0, -1.0};
    EXPECT_EQ(sample(scene, reference, {0.05f, 0.05f}), glm::vec4(0, 7, 0, 1));
    // Rotation comes after scale: with unequal scales the order shows.
    reference.uv_offset = {0.25, 0.5};
    reference.uv_scale = {2.0, 0.5};
    reference.uv_rotation = 0.3;
    const TextureUse use = make_texture_use(reference, 0);
    const double c = std::cos(0.3), s = std::sin(0.3), u = 0.7, v = 0.2;
    const glm::vec2 moved = use.offset + use.matrix * glm::vec2(u, v);
    EXPECT_NEAR(moved.x, 0.25 + c * 2.0 * u + s * 0.5 * v, 1e-6);
    EXPECT_NEAR(moved.y, 0.5 - s * 2.0 * u + c * 0.5 * v, 1e-6);
}

}  // namespace
}  // namespace aleph
