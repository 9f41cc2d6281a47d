// The scenes of scenes/furnace, whose pixels have known values.

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "engine/base/color.h"
#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "tests/support/paths.h"

namespace aleph {
namespace {

struct Deviation {
    double mean = 0.0, largest = 0.0;
};

/// Mean luminance of a frame, and the largest deviation of a pixel from the expected value.
Deviation render_frame(const std::string& file, std::int64_t frame, double expected) {
    const Scene scene = load_scene(source_folder() / "scenes" / "furnace" / file);
    RenderSettings settings;
    apply_settings(settings, scene.settings, file);
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
