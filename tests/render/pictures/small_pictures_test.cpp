// Small pictures of authored scenes: gathers, cache, frames and every kind of surface, for the sanitizer too.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"
#include "tests/support/quick_settings.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Renders a frame with its maps; every pixel is finite, and there is light.
void expect_picture(const std::string& name, std::int64_t frame, const RenderSettings& settings) {
    const Scene scene = load_scene(source_folder() / "scenes" / name);
    Sequence sequence(scene, settings);
    const FrameOutput output = sequence.render(frame, {.frame = true, .maps = true, .progress = {}});
    float brightest = 0.0f;
    for (const Rgb& pixel : output.shaded.color.pixels) {
        ASSERT_TRUE(std::isfinite(luminance(pixel))) << name;
        brightest = std::max(brightest, luminance(pixel));
    }
    EXPECT_GT(brightest, 0.0f) << name;
}

TEST(SmallPictures, WithTheCache) {
    RenderSettings settings = quick_settings(40, 30);
    settings.sampling.spp = 2;
    settings.cache.gather = 16;
    expect_picture("pool/scene.json", 12, settings);
    apply_settings(settings, {{"vision", "castle"}}, "test");
    expect_picture("cornell/scene.json", 10, settings);
}

TEST(SmallPictures, OfPathsWithEveryMaterial) {
    RenderSettings settings = quick_settings(24, 16);
    settings.light.integrator = Integrator::path;
    settings.sampling.spp = 4;
    settings.light.bounces = 2;
    for (const char* name : {"metal_ball", "mirror", "glass_ball", "brick_wall", "curtain", "layers"})
        expect_picture(std::string("materials/") + name + ".json", 20, settings);
}

}  // namespace
}  // namespace aleph
