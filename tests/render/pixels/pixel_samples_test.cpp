// The samples of a pixel: their mean and its error, irradiance that they share, and the filter that places them.

#include "render/pixels/pixel_samples.h"
#include "engine/base/sampling.h"
#include "perception/noise_threshold.h"
#include "render/pixels/pixel_surfaces.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

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

TEST(PixelSamples, NoiseBeyondWhiteIsNoError) {
    // Light of a fire: red beyond white, blue within. All samples differ by a factor of their own.
    const Rgb fire(5.0f, 1.0f, 0.1f);
    const auto take = [&fire](float white, std::uint32_t samples, float deviation) {
        PixelSamples sum(white);
        for (std::uint32_t i = 0; i < samples; ++i) {
            SampleLight light;
            const float factor = 1.0f + deviation * (2.0f * RandomStream({8, 2, 3, i}).next() - 1.0f);
            light[LightPart::direct] = factor * fire;
            sum.add(light);
        }
        return sum.error();
    };
    const float inf = std::numeric_limits<float>::infinity();
    const auto signal = [](const Rgb& light) {
        return std::hypot(luminance(light), red_green_worth * glm::dot(red_green_weights, light));
    };
    const Rgb within(0.0f, fire.y, fire.z), blue(0.0f, 0.0f, fire.z);
    const float all = take(inf, 64, 0.5f).total;
    EXPECT_NEAR(take(2.0f, 64, 0.5f).total / all, std::pow(signal(within) / signal(fire), 2.0f), 1e-5);
    EXPECT_NEAR(take(0.5f, 64, 0.5f).total / all, std::pow(signal(blue) / signal(fire), 2.0f), 1e-5);
    EXPECT_EQ(take(0.5f, 64, 0.5f).parts[1], take(0.5f, 64, 0.5f).total);
    EXPECT_EQ(take(0.05f, 64, 0.5f).total, 0.0f);
    EXPECT_EQ(take(0.99f, 64, 0.5f).total, take(2.0f, 64, 0.5f).total) << "green may be below white";
    EXPECT_EQ(take(2.0f, 8, 0.5f).total, take(inf, 8, 0.5f).total) << "too few samples to tell";
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

/// The four-term Blackman-Harris window (Harris 1978) over 3 pixels, not normalized.
double window(double x) {
    if (std::abs(x) >= 1.5) return 0.0;
    const double turn = 2.0 * std::numbers::pi * x / 3.0;  // 0 in the middle
    return 0.35875 + 0.48829 * std::cos(turn) + 0.14128 * std::cos(2.0 * turn) + 0.01168 * std::cos(3.0 * turn);
}

/// Share of the filter left of x, by the midpoint rule.
double share_left_of(double x) {
    constexpr int steps = 60'000;
    double left = 0.0, all = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double at = -1.5 + 3.0 * (i + 0.5) / steps;
        all += window(at);
        if (at < x) left += window(at);
    }
    return left / all;
}

TEST(PixelFilterTest, PlacesAreDistributedLikeTheWindow) {
    double last = -1.5;
    for (int i = 1; i < 100; ++i) {
        const double u = i / 100.0, place = place_in_filter(PixelFilter::blackman_harris, u);
        EXPECT_NEAR(share_left_of(place), u, 1e-4) << u;
        EXPECT_NEAR(place, -place_in_filter(PixelFilter::blackman_harris, 1.0 - u), 1e-9);
        EXPECT_GT(place, last);
        last = place;
    }
    EXPECT_EQ(place_in_filter(PixelFilter::blackman_harris, 0.0), -1.5);
    EXPECT_EQ(place_in_filter(PixelFilter::blackman_harris, 1.0), 1.5);
}

TEST(PixelFilterTest, DensityIsThatOfThePlaces) {
    for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
        EXPECT_EQ(filter_density(filter, 1.0001 * place_in_filter(filter, 1.0)), 0.0);
        constexpr int count = 4096;
        for (int i = 0; i < count; ++i) {
            const double u = (i + 0.5) / count, step = 1e-6;
            const double along = place_in_filter(filter, u + step) - place_in_filter(filter, u - step);
            EXPECT_NEAR(filter_density(filter, place_in_filter(filter, u)) * along / (2.0 * step), 1.0, 1e-6) << u;
        }
    }
}

/// A flat, parallel view of 16 x 12 pixels of 1 m, whose rows and columns begin at the origin.
Scene make_flat_view(double left, double right, double bottom, double top) {
    Scene scene;
    add_mesh(scene, make_quad(right - left, top - bottom, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))),
             {0.5 * (left + right), 0.5 * (bottom + top), 0.0});
    add_camera(scene, {8.0, 6.0, 5.0}, {8.0, 6.0, 0.0});
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 6.0;
    return scene;
}

Image<Rgb> render_flat(Scene scene, PixelFilter filter) {
    const Stage stage(std::move(scene), 16, 12);
    RenderSettings settings = path_settings(0, 4096);
    settings.picture.filter = filter;
    return shade(stage, settings).color;
}

TEST(PixelFilterTest, AStepIsTheIntegralOfTheFilter) {
    for (const double edge : {8.0, 8.3}) {
        const Image<Rgb> picture = render_flat(make_flat_view(-10.0, edge, -10.0, 30.0), PixelFilter::blackman_harris);
        const Image<Rgb> boxes = render_flat(make_flat_view(-10.0, edge, -10.0, 30.0), PixelFilter::box);
        for (int x = 0; x < 16; ++x) {
            EXPECT_NEAR(picture(x, 5).x, share_left_of(edge - (x + 0.5)), 2e-3) << edge << ' ' << x;
            EXPECT_NEAR(boxes(x, 5).x, std::clamp(edge - x, 0.0, 1.0), 2e-3) << edge << ' ' << x;
        }
    }
}

TEST(PixelFilterTest, APointIsTheFilter) {
    constexpr double half = 0.05;
    const Image<Rgb> picture =
        render_flat(make_flat_view(7.8 - half, 7.8 + half, 5.3 - half, 5.3 + half), PixelFilter::blackman_harris);
    const auto share = [](double place, int pixel) {
        return share_left_of(place + half - (pixel + 0.5)) - share_left_of(place - half - (pixel + 0.5));
    };
    double sum = 0.0;
    for (const auto [x, y] : all_pixels(16, 12)) {
        sum += picture(x, y).x;
        // About n of 4096 samples are met: n is right within its square root.
        const double expected = share(7.8, x) * share(5.3, 11 - y);
        EXPECT_NEAR(picture(x, y).x, expected, 4.5 * std::sqrt(expected / 4096.0) + 1e-3) << x << ' ' << y;
    }
    EXPECT_NEAR(sum, 4.0 * half * half, 0.002);
}

TEST(PixelFilterTest, TheBorderIsNoDarker) {
    for (const Rgb& pixel : render_flat(make_flat_view(-10.0, 30.0, -10.0, 30.0), PixelFilter::blackman_harris).pixels)
        EXPECT_EQ(pixel.x, 1.0f);
    // Light just outside of the picture counts, in the outermost row of pixels alone.
    const Image<Rgb> outside = render_flat(make_flat_view(-10.0, 0.0, -10.0, 30.0), PixelFilter::blackman_harris);
    EXPECT_NEAR(outside(0, 6).x, share_left_of(-0.5), 2e-3);
    EXPECT_GT(outside(0, 6).x, 0.05f);
    EXPECT_EQ(outside(1, 6).x, 0.0f);
}

}  // namespace
}  // namespace aleph
