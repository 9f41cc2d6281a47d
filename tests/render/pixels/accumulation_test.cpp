// MC-13: many samples of one value have that value as their mean.

#include <gtest/gtest.h>

#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

TEST(Accumulation, MC13_TheMeanOfTheMostSamplesIsExact) {
    // 65,536 samples of .7, the largest number that a setting may have: a sum in single precision is off by 2e-4, and
    // by a tenth at 1e7 samples.
    Scene scene;
    scene.environment = Track<glm::dvec3>(glm::dvec3(0.7, 0.1, 1e-3));
    const Stage stage(std::move(scene), 2, 1);
    RenderSettings settings = plain_settings(0.2, 16);
    settings.sampling.spp = 65536;
    const ShadedFrame out = shade(stage, settings);
    for (const Rgb& pixel : out.color.pixels) {
        EXPECT_NEAR(pixel.x / 0.7, 1.0, 1e-6);
        EXPECT_NEAR(pixel.y / 0.1, 1.0, 1e-6);
        EXPECT_NEAR(pixel.z / 1e-3, 1.0, 1e-6);
    }
}

}  // namespace
}  // namespace aleph
