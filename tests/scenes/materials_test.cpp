// scenes/materials: each scene shows what it is there for, path traced at a small size.
// The scenes of scenes/furnace, whose pixels have known values.

#include "engine/base/color.h"
#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Scene load_material_scene(const std::string& name) {
    Scene scene = load_scene(source_folder() / "scenes/materials" / (name + ".json"));
    EXPECT_TRUE(scene.source.warnings.empty()) << name << ": " << scene.source.warnings.front();
    return scene;
}

Image<Rgb> render_small(const Scene& scene, int spp, std::int64_t frame = 20) {
    RenderSettings settings;
    apply_settings(settings, scene.source.settings, scene.source.file);
    settings.picture.width = 48;
    settings.picture.height = 32;
    settings.sampling.spp = spp;
    settings.picture.filter = PixelFilter::box;
    settings.perception.guide = Guide::none;
    const FrameOutput out = Sequence(scene, settings).render(frame);
    EXPECT_EQ(out.shaded.counts.invalid_samples, 0u);
    return out.shaded.color;
}

Rgb mean_of(const Image<Rgb>& picture, int x0, int x1, int y0, int y1) {
    glm::dvec3 sum(0.0);
    for (int y = y0; y < y1; ++y) {
        for (int x = x0; x < x1; ++x) sum += glm::dvec3(picture(x, y));
    }
    return Rgb(sum / static_cast<double>((x1 - x0) * (y1 - y0)));
}

TEST(MaterialScenes, GoldIsGold) {
    const Rgb ball = mean_of(render_small(load_material_scene("metal_ball"), 16), 3, 9, 14, 19);
    EXPECT_GT(ball.x, 1.3f * ball.z);
    EXPECT_GT(ball.z, 0.02f);
}

TEST(MaterialScenes, TheBallBehindTheCameraIsSeenInTheMirrorOnly) {
    Scene scene = load_material_scene("mirror");
    const Image<Rgb> with = render_small(scene, 64);
    scene.nodes[find_named(scene.nodes, "ball behind the camera")].visible = 0.0;
    const Image<Rgb> without = render_small(scene, 64);
    float bluest = 0.0f;
    int x_of = 0, y_of = 0;
    for (int y = 0; y < with.height; ++y) {
        for (int x = 0; x < with.width; ++x) {
            const Rgb& a = with(x, y);
            const Rgb& b = without(x, y);
            const float more_blue = (a.z - a.x) - (b.z - b.x);
            if (more_blue > bluest) bluest = more_blue, x_of = x, y_of = y;
        }
    }
    EXPECT_GT(bluest, 0.02f);
    EXPECT_TRUE(x_of > 15 && x_of < 28 && y_of > 7 && y_of < 21) << x_of << ", " << y_of;
}

TEST(MaterialScenes, GlassShowsTheWallAndTheBlockIsGreen) {
    const Image<Rgb> picture = render_small(load_material_scene("glass_ball"), 64);
    const Rgb ball = mean_of(picture, 18, 21, 15, 19), block = mean_of(picture, 27, 31, 17, 21);
    EXPECT_GT(ball.x, 0.05f);
    // Path traced at 4,096 samples: 1.304 and 1.195.
    EXPECT_NEAR(block.y / block.x, 1.304f, 0.04f);
    EXPECT_NEAR(block.y / block.z, 1.195f, 0.04f);
}

TEST(MaterialScenes, TheNormalMapChangesTheLightOnTheWall) {
    Scene scene = load_material_scene("brick_wall");
    const Image<Rgb> mapped = render_small(scene, 32);
    for (Material& material : scene.materials) material.textures[TextureSlot::normal] = {};
    const Image<Rgb> flat = render_small(scene, 32);
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < mapped.size(); ++i) {
        difference += std::abs(luminance(mapped.pixels[i]) - luminance(flat.pixels[i]));
        sum += luminance(flat.pixels[i]);
    }
    EXPECT_GT(difference / sum, 0.03);
    EXPECT_LT(difference / sum, 0.5);
}

TEST(MaterialScenes, TheCurtainStopsHalfOfTheLamp) {
    Scene scene = load_material_scene("curtain");
    const Rgb behind = mean_of(render_small(scene, 256), 23, 25, 16, 18);
    scene.nodes[find_named(scene.nodes, "curtain")].visible = 0.0;
    const Rgb open = mean_of(render_small(scene, 256), 23, 25, 16, 18);
    EXPECT_NEAR(luminance(behind) / luminance(open), 0.5, 0.03);
}

TEST(MaterialScenes, LayersAreWhatTheyShouldBe) {
    const Image<Rgb> picture = render_small(load_material_scene("layers"), 32);
    const Rgb lacquer = mean_of(picture, 11, 15, 15, 19), velvet = mean_of(picture, 22, 26, 15, 19);
    EXPECT_GT(lacquer.x, 1.5f * lacquer.z);
    EXPECT_GT(velvet.z, 1.2f * velvet.y);
}

struct Deviation {
    double mean = 0.0, largest = 0.0;
};

/// Mean luminance of a frame, and the largest deviation of a pixel from the expected value.
Deviation render_frame(const std::string& file, std::int64_t frame, double expected) {
    const Scene scene = load_scene(source_folder() / "scenes" / "furnace" / file);
    RenderSettings settings;
    apply_settings(settings, scene.source.settings, file);
    settings.picture.width = 64;
    settings.picture.height = 48;
    settings.cache.gather = 1024;
    settings.light.light_samples = 64;
    const FrameOutput output = Sequence(scene, settings).render(frame);
    Deviation deviation;
    for (const Rgb& pixel : output.shaded.color.pixels) {
        const double y = luminance(pixel);
        deviation.mean += y / static_cast<double>(output.shaded.color.size());
        deviation.largest = std::max(deviation.largest, std::abs(y - expected));
    }
    return deviation;
}

TEST(FurnaceScenes, AWhiteBoxInWhiteLightCannotBeSeen) {
    for (const std::int64_t frame : {0, 20, 59}) {
        SCOPED_TRACE(frame);
        const Deviation deviation = render_frame("scene.json", frame, 1.0);
        EXPECT_NEAR(deviation.mean, 1.0, 1e-3);
        EXPECT_LT(deviation.largest, 0.02);
    }
}

TEST(FurnaceScenes, MC14_AClosedGlowingSphereAddsUpItsBounces) {
    // Emission, direct light and one bounce: three terms of 1 + .8 + .8^2 + ...
    const double expected = 1.0 + 0.8 + 0.8 * 0.8;
    for (const std::int64_t frame : {0, 17}) {
        SCOPED_TRACE(frame);
        const Deviation deviation = render_frame("closed.json", frame, expected);
        EXPECT_NEAR(deviation.mean, expected, 0.01 * expected);
        EXPECT_LT(deviation.largest, 0.1 * expected);
    }
}

}  // namespace
}  // namespace aleph
