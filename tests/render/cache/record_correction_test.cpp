// Records that correct each other: reach by disagreement, less noise by averaging; and how many rays a record takes.

#include "render/cache/gather_at.h"
#include "render/cache/irradiance_cache.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

IrradianceRecord make_flat_record(const glm::vec3& position, float irradiance, float noise) {
    return {.position = position,
            .radius = 1.0f,
            .normal = up,
            .irradiance = Rgb(irradiance),
            .noise = {.error = noise},
            .accuracy = 0.2f};
}

TEST(RecordCorrection, AveragesLowerNoiseAndKeepEdges) {
    constexpr float noise = 0.03f, edge = 0.4f;
    std::mt19937 engine(5);
    std::normal_distribution<float> deviate(0.0f, noise);
    IrradianceCache cache(glm::vec3(-1.0f), glm::vec3(1.0f));
    for (int z = 0; z < 12; ++z) {
        for (int x = 0; x < 24; ++x) {
            const float light = x < 12 ? 1.0f : edge;
            const glm::vec3 place(0.05f * static_cast<float>(x - 12) + 0.025f, 0.0f, 0.05f * static_cast<float>(z - 6));
            cache.insert(make_flat_record(place, light * (1.0f + deviate(engine)), noise));
        }
    }
    const auto squared_error = [&] {
        double sum = 0.0;
        for (const IrradianceRecord& record : cache.records()) {
            const double light = record.position.x < 0.0f ? 1.0 : edge;
            sum += std::pow(record.irradiance.x / light - 1.0, 2.0);
        }
        return sum / static_cast<double>(cache.records().size());
    };
    const double before = squared_error();
    EXPECT_NEAR(before, noise * noise, 0.3 * noise * noise);
    cache.finish();
    EXPECT_EQ(cache.records().size(), 288u);
    EXPECT_LT(squared_error(), 0.3 * before);
}

TEST(RecordCorrection, RaysFollowVarianceAndAccuracy) {
    RenderSettings settings;
    settings.cache.accuracy = 0.1;
    EXPECT_EQ(choose_rays(settings, 0.1f, 1.0f), 2500);  // a standard error of a fifth of the accuracy: 1 / .02^2
    EXPECT_EQ(choose_rays(settings, 0.2f, 1.0f), 625);
    EXPECT_EQ(choose_rays(settings, 1.0f, 1.0f), 64);
    EXPECT_EQ(choose_rays(settings, 0.01f, 1.0f), 8192);
    EXPECT_EQ(choose_rays(settings, 0.1f, std::nullopt), 512);
    settings.cache.gather = 1000;
    EXPECT_EQ(choose_rays(settings, 0.1f, 9.0f), 1000);
    EXPECT_EQ(choose_rays(settings, 0.2f, 9.0f), 250);
}

TEST(RecordCorrection, ContactsHaveNoGradientBeyondThem) {
    const auto gradient = [](float nearest) {
        IrradianceSample sample{.irradiance = Rgb(1.0f)};
        sample.gradients.translation.fill({0.5f, 0.0f, 0.0f});
        sample.nearest_distance = nearest;
        return make_record(glm::vec3(0.0f), up, 0.2f, sample, {0.7f, 10.0f, 0.01f})->gradients.translation[0].x;
    };
    EXPECT_EQ(gradient(0.2f), 0.5f);   // a radius of 3.5 x 0.2 m
    EXPECT_EQ(gradient(0.05f), 0.5f);  // the least radius is 4 times that by distance
    EXPECT_NEAR(gradient(0.025f), 0.25f, 1e-6f);
    EXPECT_EQ(gradient(0.0f), 0.0f);
}

}  // namespace
}  // namespace aleph
