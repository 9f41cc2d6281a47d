// Sums of samples: nearly equal, very many, and not numbers at all.

#include "render/pixels/pixel_samples.h"
#include "tests/support/path_estimates.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(PathValues, MC01_TheVarianceOfAPixelKeepsItsDigits) {
    for (const float mean : {1.0f, 1e2f, 1e3f, 1e4f}) {
        for (std::uint32_t seed = 0; seed < 20; ++seed) {
            std::mt19937 engine(seed);
            std::normal_distribution<float> around(mean, 0.1f);
            std::vector<float> values(512);
            PixelSamples sum;
            long double total = 0.0L, squares = 0.0L;
            for (float& value : values) {
                const SampleLight sample = grey_sample(around(engine));
                value = luminance(sample.total());  // rounded to float, so that 0.1 has few digits beside 1e4
                total += value;
                sum.add(sample);
            }
            for (const float value : values) squares += (value - total / 512) * (value - total / 512);
            const auto expected = static_cast<double>(squares / 511 / 512);
            ASSERT_NEAR(sum.variance(), expected, 1e-6 * expected) << mean;
        }
    }
    PixelSamples equal;
    for (int i = 0; i < 1000; ++i) equal.add(grey_sample(1e4f / 3.0f));
    EXPECT_EQ(equal.variance(), 0.0);
}

TEST(PathValues, MC13_AHundredMillionSamplesKeepTheirMean) {
    PixelSamples sum;
    constexpr int count = 100'000'000;
    SampleLight sample = grey_sample(0.7f);
    for (int i = 0; i < count; ++i) {
        sample.place.instance = i % 2 == 0 ? 0 : no_index;
        sum.add(sample);
    }
    EXPECT_NEAR(sum.mean().x, 0.7f, 1e-6 * 0.7);
    EXPECT_LT(sum.variance(), 1e-20);
    EXPECT_GE(sum.variance(), 0.0);
    EXPECT_EQ(sum.coverage(), 0.5f);
}

TEST(PathValues, MC13_SmallSamplesAreNotLostBesideASpark) {
    PixelSamples sum;
    constexpr int count = 1'000'000;
    sum.add(grey_sample(1e8f));
    for (int i = 0; i < count; ++i) sum.add(grey_sample(0.7f));
    const double expected = (1e8 + static_cast<double>(0.7f) * count) / (count + 1.0);
    EXPECT_NEAR(sum.mean().x, expected, 1e-6 * expected);
}

/// Left a floor whose material can be spoiled, right a good one behind a wall: light cannot get from one to the other.
Scene make_halves() {
    Scene scene;
    const int spoiled = add_lambert(scene, glm::dvec3(0.5)), good = add_lambert(scene, glm::dvec3(0.5));
    scene.materials[0].gloss.specular = 1.0;
    scene.materials[0].gloss.roughness = 0.5;
    add_mesh(scene, make_quad(2.0, 4.0, spoiled), {-1.0, 0.0, -3.0});
    add_mesh(scene, make_quad(2.0, 4.0, good), {1.0, 0.0, -3.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(3.0), glm::dvec3(0.0));
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.9);
    return scene;
}

TEST(PathValues, MC03_AMaterialThatIsNotANumberIsDroppedAndCounted) {
    const auto spoil_color = [&](Material& m) { m.base_color = glm::dvec3(0.5, not_a_number, 0.5); };
    const auto spoil_roughness = [&](Material& m) { m.gloss.roughness = not_a_number; };
    const auto spoil_emission = [&](Material& m) { m.glow.color = glm::dvec3(not_a_number); };
    const auto spoil_specular = [&](Material& m) { m.gloss.specular_color = glm::dvec3(0.5, 0.5, not_a_number); };
    const std::vector<std::function<void(Material&)>> all{spoil_color, spoil_roughness, spoil_emission, spoil_specular};
    for (std::size_t which = 0; which < all.size(); ++which) {
        SCOPED_TRACE(which);
        Scene scene = make_halves();
        all[which](scene.materials[0]);
        const Stage stage(std::move(scene), 16, 12);
        const ShadedFrame out = shade(stage, path_settings(2, 4));
        double invalid = 0.0;
        for (int y = 2; y < 10; ++y) {
            for (const int x : {4, 11}) {
                const bool bad = x == 4;
                EXPECT_EQ(out.color(x, y) == Rgb(0.0f), bad) << x;
                EXPECT_EQ(out.invalid_samples(x, y), bad ? 4.0f : 0.0f) << x;
                EXPECT_TRUE(is_finite(out.color(x, y)));
            }
        }
        for (const float count : out.invalid_samples.pixels) invalid += count;
        EXPECT_EQ(invalid, static_cast<double>(out.counts.invalid_samples));
    }
}

TEST(PathValues, MC03_ALightThatIsNotANumberIsDroppedAndCounted) {
    for (const double value : {not_a_number, 1e39}) {
        for (const int lights : {1, 40}) {  // all are compared, or some are drawn
            Scene scene = make_halves();
            for (int i = 1; i < lights; ++i) add_light(scene, Light::Kind::point, glm::dvec3(1.0), glm::dvec3(0.0));
            scene.lights[0].color = glm::dvec3(value);
            const Stage stage(std::move(scene), 16, 12);
            const ShadedFrame out = shade(stage, path_settings(0, 64));
            for (const Rgb& pixel : out.color.pixels) EXPECT_TRUE(is_finite(pixel));
            EXPECT_GT(out.invalid_samples(4, 6), lights == 1 ? 63.0f : 0.0f);
        }
    }
}

TEST(Accumulation, MC13_TheMeanOfTheMostSamplesIsExact) {
    // 65,536 samples of .7, the largest number that a setting may have: a sum in single precision is off by 2e-4, and
    // by a tenth at 1e7 samples.
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.7, 0.1, 1e-3));
    const Stage stage(std::move(scene), 2, 1);
    RenderSettings settings = plain_settings(0.2, 16);
    settings.sampling.spp = 65'536;
    for (const Rgb& pixel : shade(stage, settings).color.pixels) EXPECT_EQ(pixel, Rgb(0.7f, 0.1f, 1e-3f));
}

}  // namespace
}  // namespace aleph
