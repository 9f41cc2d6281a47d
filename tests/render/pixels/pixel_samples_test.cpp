// The samples of a pixel: their mean and its error, and irradiance that they share.

#include "render/pixels/pixel_samples.h"
#include "engine/base/sampling.h"
#include "perception/noise_threshold.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

TEST(PixelSamples, HalvesTellTheErrorOfTheMean) {
    // Independent samples: on average over many pixels, a quarter of the squared difference of halves is the variance.
    EXPECT_TRUE(holds([](Trial& trial) {
        Mean told;
        constexpr int samples = 32;
        for (std::uint32_t pixel = 0; pixel < trial.times(4000u); ++pixel) {
            PixelSamples sum;
            for (std::uint32_t i = 0; i < samples; ++i)
                sum.add(grey_sample(RandomStream({1 + trial.seed, 2, pixel, i}).next()));
            EXPECT_EQ(sum.error().samples, samples);
            told.add(static_cast<double>(sum.error().total));
        }
        trial.near(told, 1.0 / 12.0 / samples);
    }));
}

TEST(PixelSamples, NoiseOfHueAloneIsAnError) {
    // Red and green light of one luminance, by turns: a mean of two samples is off by the other hue's half.
    const auto sample = [](const Rgb& color) {
        SampleLight light;
        light[LightPart::direct] = color / luminance(color);
        return light;
    };
    PixelSamples sum;
    sum.add(sample(Rgb(1.0f, 0.0f, 0.0f)));
    sum.add(sample(Rgb(0.0f, 1.0f, 0.0f)));
    const double red_green = (0.12682 / 0.2126 + 0.08977 / 0.7152) / 2.0;
    EXPECT_NEAR(sum.error().total, std::pow(red_green_worth * red_green, 2.0), 1e-4);
    EXPECT_EQ(sum.error().parts[static_cast<std::size_t>(LightPart::direct)], sum.error().total);
    EXPECT_NEAR(sum.sample_variance(), 0.0, 1e-12);  // of luminance
}

TEST(PixelSamples, IrradianceIsSharedOnOneFaceOnly) {
    PixelSamples sum;
    SampleLight sample = grey_sample(1.0f);
    sample.place.normal = sample.place.geometric = glm::vec3(0.0f, 0.0f, 1.0f);
    sample.place.footprint = 0.01f;
    for (int i = 0; i < 4; ++i) {
        EXPECT_FALSE(sum.find_irradiance(sample).has_value());
        sample.irradiance = Rgb(static_cast<float>(i));
        sample.place.position = glm::vec3(0.01f * static_cast<float>(i), 0.0f, 0.0f);
        sum.add(sample);
    }
    EXPECT_EQ(sum.find_irradiance(sample), Rgb(1.5f));
    EXPECT_FALSE(sum.has_edge());
    SampleLight other = sample;
    other.place.instance = 1;
    EXPECT_FALSE(sum.find_irradiance(other).has_value());
    other = sample;
    other.place.normal = glm::normalize(glm::vec3(0.1f, 0.0f, 1.0f));  // of a normal map
    EXPECT_FALSE(sum.find_irradiance(other).has_value());
    other = sample;
    other.place.position.z = -0.5f;  // a parallel face of the same mesh, farther away
    EXPECT_FALSE(sum.find_irradiance(other).has_value());
    sum.add(other);
    EXPECT_TRUE(sum.has_edge());
}

TEST(PixelSamples, InvalidSamplesAreLeftOut) {
    PixelSamples sum;
    sum.add(grey_sample(1.0f));
    sum.add_invalid();
    sum.add(grey_sample(3.0f));
    sum.add(grey_sample(3.0f));
    EXPECT_EQ(sum.taken(), 4);
    EXPECT_NEAR(sum.mean().x, 7.0f / 3.0f, 1e-6f);
    EXPECT_EQ(sum.error().samples, 3);
    EXPECT_NEAR(sum.error().total, 1.0 * 2.0 / 9.0 * 4.0, 1e-5);  // means 1 and 3 of one and two samples
}

}  // namespace
}  // namespace aleph
