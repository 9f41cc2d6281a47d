// Filling in rounds needs at most 3 % more records than a sequential fill. Gathers that are not finite make no records.

#include "render/cache/cache_fill.h"
#include "engine/load/load_scene.h"
#include "render/cache/gather_at.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

Scene load(const std::string& name) {
    return load_scene(source_folder() / "scenes" / name / "scene.json");
}

/// A sequential fill: each record is inserted before the next pixel is looked at. The order of pixels is that of
/// fill_cache, and all pixels are looked at again until all are covered.
std::size_t count_sequentially(const IndirectStage& fill) {
    IrradianceCache cache = make_cache(fill.stage.shading);
    GatherScratch scratch;
    RayTask task(fill.stage.rays);
    const auto visit = [&](int stride, bool all) {
        for (int y = 0; y < fill.stage.view.height; y += stride) {
            for (int x = 0; x < fill.stage.view.width; x += stride) {
                if (!all && stride < 64 && x % (2 * stride) == 0 && y % (2 * stride) == 0) continue;
                if (fill.centers.hits(x, y).instance == no_index) continue;
                const PixelSurface s = make_pixel_surface(fill.stage.shading, fill.stage.view, fill.centers, x, y);
                const float accuracy = fill.alpha(x, y);
                if (!s.material.has_diffuse()) continue;
                const CacheQuery query{s.point.position, s.point.normal, accuracy, &task};
                if (cache.covers(query)) continue;
                const auto expected = cache.expect(query, fill.context.max_radius);
                const int rays = choose_rays(fill.settings, accuracy,
                                             expected ? std::optional(expected->ray_variance) : std::nullopt);
                const IrradianceSample value = gather_at(fill.context, task, s, scratch, rays);
                const RadiusBounds bounds = radius_bounds(fill.context, s.footprint, accuracy);
                cache.insert(make_record(query.position, query.normal, accuracy, value, bounds).value());
            }
        }
    };
    for (int stride = 64; stride >= 1; stride /= 2) visit(stride, false);
    for (std::size_t before = 0; before != cache.records().size();) {
        before = cache.records().size();
        visit(1, true);
    }
    return cache.records().size();
}

void expect_rounds_cost_little(const IndirectStage& fill) {
    const double rounds = static_cast<double>(fill.fill().cache.records().size());
    const double sequential = static_cast<double>(count_sequentially(fill));
    EXPECT_GT(sequential, 100.0);
    EXPECT_LE(rounds, 1.03 * sequential);
}

TEST(CacheFill, RoundsCostLittle) {
    expect_rounds_cost_little({load("pool"), 320, 240, 0.15});
    expect_rounds_cost_little({load("room"), 320, 240, 0.15});
    // With fewer rays noise alone would change the numbers by several percent.
    expect_rounds_cost_little({load("room"), 320, 240, 0.4, 256});
    expect_rounds_cost_little({load("cornell"), 320, 240, 0.1});
}

TEST(CacheFill, GuidedAccuracyToo) {
    IndirectStage fill(load("cornell"), 320, 240, 0.15);
    for (const auto [x, y] : all_pixels(fill.alpha)) fill.alpha(x, y) = (x / 40 + y / 40) % 2 == 0 ? 0.1f : 0.9f;
    expect_rounds_cost_little(fill);
}

/// Neighbour clamping may shrink a record after it covered a place. Filling reviews all pixels for that; otherwise,
/// shading would gather at each uncovered pixel.
TEST(CacheFill, EverySampleIsCoveredAfterwards) {
    for (const auto& [name, accuracy] : {std::pair("cornell", 0.3), std::pair("pool", 0.5)}) {
        const IndirectStage fill(load(name), 160, 120, accuracy);
        const auto [cache, tally] = fill.fill();
        RayTask task(fill.stage.rays);
        std::size_t uncovered = 0, asked = 0;
        for (const auto [x, y] : all_pixels(160, 120)) {
            if (fill.centers.hits(x, y).instance == no_index) continue;
            const PixelSurface s = make_pixel_surface(fill.stage.shading, fill.stage.view, fill.centers, x, y);
            if (!s.material.has_diffuse()) continue;
            ++asked;
            if (!cache.covers({s.point.position, s.point.normal, fill.alpha(x, y), &task})) ++uncovered;
        }
        EXPECT_GT(asked, 5000u);
        EXPECT_LE(uncovered, asked / 1000) << name;
        // No rays below the true surface.
        EXPECT_LE(tally.counts.rays.gather, 64 * cache.records().size());
        EXPECT_GT(tally.counts.rays.gather, 60 * cache.records().size());
        EXPECT_GE(tally.counts.cache.lookups, tally.counts.cache.hits + cache.records().size());
    }
}

/// Two rooms without a roof. The light in the right one is brighter on the nearest wall than a float can hold.
Scene make_overexposed_room() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 2.0, white), glm::dvec3(0.0), z_to_up);
    for (const double x : {-2.0, 0.0, 2.0}) add_mesh(scene, make_box({0.1, 1.0, 2.0}, white), {x, 0.5, 0.0});
    add_light(scene, Light::Kind::point, glm::dvec3(1e38), {1.7, 0.5, 0.0});
    add_camera(scene, {0.0, 4.0, 0.0}, glm::dvec3(0.0), 0.9);
    return scene;
}

TEST(CacheFill, GathersThatAreNotFiniteMakeNoRecords) {
    const auto [cache, tally] = IndirectStage(make_overexposed_room(), 64, 48, 0.15).fill();
    for (const IrradianceRecord& record : cache.records()) ASSERT_TRUE(is_finite(record.irradiance));
    EXPECT_GT(cache.records().size(), 10u);
    EXPECT_GT(tally.counts.invalid_samples, 10u);
    // Every gather is either a record or invalid, and the sums over pixels agree.
    EXPECT_EQ(tally.counts.records, cache.records().size() + tally.counts.invalid_samples);
    double records = 0.0, invalid = 0.0;
    for (const float n : tally.records.pixels) records += n;
    for (const float n : tally.invalid_samples.pixels) invalid += n;
    EXPECT_EQ(records, static_cast<double>(tally.counts.records));
    EXPECT_EQ(invalid, static_cast<double>(tally.counts.invalid_samples));
}

}  // namespace
}  // namespace aleph
