// The irradiance cache in pictures: corners, open scenes, winding, tiny accuracies, threads.

#include "engine/base/parallel.h"
#include "tests/support/first_hits.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Scene make_corner() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8));
    add_mesh(scene, make_quad(2.0, 2.0, white), {0.0, 0.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(2.0, 2.0, white), {0.0, 1.0, -1.0});
    add_mesh(scene, make_quad(2.0, 2.0, white), {-1.0, 1.0, 0.0}, turn_about_y(pi / 2));
    add_light(scene, Light::Kind::point, glm::dvec3(3.0), {0.3, 0.8, 0.3});
    add_camera(scene, {0.0, 1.0, 1.0}, {-1.0, 0.0, -1.0}, 0.25);
    return scene;
}

TEST(IrradianceCache, IC04_RecordsInACornerAreBounded) {
    const Stage stage(make_corner(), 64, 48);
    const ShadedFrame out = shade(stage, plain_settings(0.15, 64));
    double records = 0.0;
    for (const float r : out.records.pixels) records += r;
    // Radii of at least 4 px fill an image with at most about one record per 3.1 px (2 r / sqrt 3 ... packing).
    EXPECT_GT(records, 3.0);
    EXPECT_LT(records, 64.0 * 48.0 / 4.0);
    for (const Rgb& c : out.color.pixels) EXPECT_TRUE(std::isfinite(c.x) && c.x >= 0.0f);
    EXPECT_EQ(out.counts.invalid_samples, 0u);
}

/// A floor of plastic in the open that is lit by a low wall alone, at grazing angles.
Scene make_plastic_floor() {
    Scene scene;
    const int plastic = add_lambert(scene, glm::dvec3(0.5)), white = add_lambert(scene, glm::dvec3(0.8));
    scene.materials[plastic].gloss.specular = 1.0;
    add_mesh(scene, make_quad(2.0, 2.0, plastic), {0.0, 0.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(2.0, 0.4, white), {1.0, 0.2, 0.0}, turn_about_y(-pi / 2));
    add_light(scene, Light::Kind::directional, glm::dvec3(2.0), glm::dvec3(0.0), turn_about_y(-pi / 2));
    add_camera(scene, {0.0, 2.0, 1.0}, {0.0, 0.0, 0.0}, 0.4);
    return scene;
}

TEST(IrradianceCache, PlasticTakesInAsMuchGrazingLightAsPathsSay) {
    const Stage stage(make_plastic_floor(), 16, 12);
    const Mean paths = mean_of_pixels(shade(stage, path_settings(1, 16384)));
    RenderSettings settings = plain_settings(0.02, 4096);
    settings.sampling.spp = 64;  // for gloss
    const double records = mean_of_pixels(shade(stage, settings)).mean();
    settings.cache.accuracy = 0.0;
    settings.cache.gather = 256;
    const double rays = mean_of_pixels(shade(stage, settings)).mean();
    // Were all light to enter alike, both would be a fifth brighter.
    EXPECT_NEAR(records, paths.mean(), 0.015 * paths.mean());
    EXPECT_NEAR(rays, paths.mean(), 0.01 * paths.mean());
}

TEST(IrradianceCache, ARandomPathCountsByWhatEntersToo) {
    Gathering floor(make_plastic_floor());
    const LightingContext lighting = floor.stage.lighting();
    const SurfacePoint point = make_point(glm::vec3(0.5f, 0.0f, 0.0f) - glm::vec3(floor.stage.shading.anchor), up);
    SurfaceMaterial plastic;
    plastic.gloss.f0_max = 0.04f;
    plastic.gloss.f90_max = 1.0f;
    const auto gathered = [&](const SurfaceMaterial* material) {
        return luminance(floor.gather(point, {choose_strata(16384), {3, 0, 0, 0}}, {.material = material}).irradiance);
    };
    EXPECT_TRUE(holds([&](Trial& trial) {
        RandomStream random({trial.seed, 1, 2, 3});
        Mean paths;
        for (std::uint32_t i = 0; i < trial.times(20'000u); ++i) {
            paths.add(luminance(
                sample_multi_bounce_irradiance(lighting, floor.task, point, &plastic, {.bounces = 1}, 8, random)));
        }
        trial.near(paths, gathered(&plastic), 0.01 * gathered(&plastic));
    }));
    EXPECT_LT(gathered(&plastic), 0.95 * gathered(nullptr));
}

/// Two floor tiles 10 m apart in the open; beside the second stands a lit red wall.
Scene make_open_tiles() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8)), red = add_lambert(scene, {0.9, 0.05, 0.05});
    add_mesh(scene, make_quad(1.0, 1.0, white), {0.0, 0.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(1.0, 1.0, white), {10.0, 0.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(1.0, 1.0, red), {10.5, 0.5, 0.0}, turn_about_y(-pi / 2));
    add_light(scene, Light::Kind::directional, glm::dvec3(2.0), glm::dvec3(0.0), turn_about_y(-pi / 2));
    add_camera(scene, {5.0, 6.0, 6.0}, {5.0, 0.0, 0.0}, 1.2);
    return scene;
}

TEST(IrradianceCache, IC06_ARecordInTheOpenDoesNotCoverTheNextObject) {
    const Stage stage(make_open_tiles(), 80, 40);
    Gathering tiles(make_open_tiles());
    const glm::vec3 anchor(stage.shading.anchor);
    const glm::vec3 first = glm::vec3(-0.4f, 0.0f, 0.0f) - anchor, second = glm::vec3(10.3f, 0.0f, 0.0f) - anchor;
    const auto gather = [&](const glm::vec3& p) { return tiles.at(p, up, 1024); };
    const float largest = scene_radius(stage.shading);
    IrradianceCache cache = make_cache(stage.shading);
    cache.insert(make_record(first, up, 1.0f, gather(first), {1e-3f, largest}).value());
    EXPECT_LE(cache.records()[0].radius, largest);
    EXPECT_TRUE(std::isfinite(cache.records()[0].radius));
    EXPECT_FALSE(cache.covers({second, up, 1.0f}));
    EXPECT_LT(gather(first).irradiance.x, 0.01f);
    EXPECT_GT(gather(second).irradiance.x, 0.1f);
    // The same in the picture: the second tile is red next to the wall, the first is black (no light reaches it).
    const ShadedFrame out = shade(stage, plain_settings(1.0, 256));
    float first_tile = 0.0f, second_tile = 0.0f;
    const Image<Hit> hits = cast_first_hits(stage.rays, stage.view);
    for (std::size_t i = 0; i < hits.size(); ++i) {
        if (hits.pixels[i].instance == 0) first_tile = std::max(first_tile, out.color.pixels[i].x);
        if (hits.pixels[i].instance == 1) second_tile = std::max(second_tile, out.color.pixels[i].x);
    }
    EXPECT_LT(first_tile, 0.01f);
    EXPECT_GT(second_tile, 0.05f);
}

TEST(IrradianceCache, IC10_WindingDoesNotMatterToATwoSidedSurface) {
    const auto render = [](bool flipped) {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true);
        Mesh room = make_box({4.0, 3.0, 4.0}, white), block = make_box({0.8, 0.8, 0.8}, white);
        if (flipped) room = flip_winding(room), block = flip_winding(block);
        add_mesh(scene, room);
        add_mesh(scene, block, {0.5, -1.1, -0.5}, turn_about_y(0.4));
        add_light(scene, Light::Kind::point, glm::dvec3(4.0), {-0.5, 1.0, 0.3});
        add_camera(scene, {0.0, 0.0, 1.8}, {0.0, -0.4, 0.0}, 1.0);
        const Stage stage(std::move(scene), 64, 48);
        return shade(stage, plain_settings(0.2, 1024)).color;  // the noise of the records differs
    };
    const Image<Rgb> one = render(false), other = render(true);
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < one.size(); ++i) {
        EXPECT_GT(one.pixels[i].x, 0.0f);
        difference += std::abs(one.pixels[i].x - other.pixels[i].x);
        sum += one.pixels[i].x;
    }
    EXPECT_LT(difference, 0.01 * sum);
}

Scene make_room() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true);
    const int red = add_lambert(scene, {0.7, 0.1, 0.1}, glm::dvec3(0.0), true);
    add_mesh(scene, make_box({4.0, 3.0, 4.0}, white));
    add_mesh(scene, make_box({0.8, 0.8, 0.8}, red), {0.5, -1.1, -0.5}, turn_about_y(0.4));
    add_lamp(scene, 1.0, glm::dvec3(10.0), {0.0, 1.49, 0.0});
    add_camera(scene, {0.0, 0.0, 1.8}, {0.0, -0.4, 0.0}, 1.0);
    return scene;
}

TEST(IrradianceCache, IC13_TheSameRecordsFromAnyNumberOfThreads) {
    IndirectStage room(make_room(), 96, 72, 0.15);
    room.settings.light.light_samples = 4;
    for (const auto [x, y] : all_pixels(room.alpha)) room.alpha(x, y) = x < 48 ? 0.15f : 0.6f;  // as by a guide
    std::vector<IrradianceRecord> first;
    Image<Rgb> first_picture;
    for (const int threads : {1, 2, 4, 8}) {
        const ThreadLimit limit(threads);
        const std::vector<IrradianceRecord> records = room.fill().cache.records();
        const Image<Rgb> picture = shade_frame(room.context, room.centers, 1.0).color;
        if (threads == 1) {
            first = records;
            first_picture = picture;
            ASSERT_GT(first.size(), 50u);
        }
        ASSERT_EQ(records.size(), first.size());
        for (std::size_t i = 0; i < first.size(); ++i) {
            const IrradianceRecord &a = first[i], &b = records[i];
            ASSERT_EQ(a.position, b.position);
            ASSERT_EQ(a.normal, b.normal);
            ASSERT_EQ(a.irradiance, b.irradiance);
            ASSERT_EQ(a.radius, b.radius);
            ASSERT_EQ(a.gradients.translation, b.gradients.translation);
            ASSERT_EQ(a.gradients.rotation, b.gradients.rotation);
        }
        EXPECT_EQ(picture, first_picture) << threads;
    }
}

}  // namespace
}  // namespace aleph
