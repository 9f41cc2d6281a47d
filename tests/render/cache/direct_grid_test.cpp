// Direct light from a grid of cells: the cells, and gathers with it against gathers without.

#include "render/cache/direct_grid.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(DirectGrid, CellsAreAsWideAsTheRaysFootprint) {
    const auto key = [](const glm::vec3& position, float width) { return DirectGrid().key_of(3, position, up, width); };
    // From 1 / sqrt(2) to sqrt(2) times a width of 1/16, cells are 1/16 wide.
    for (const float width : {0.0443f, 0.0625f, 0.0883f}) {
        EXPECT_EQ(key({0.01f, 0.01f, 0.01f}, width), key({0.06f, 0.03f, 0.06f}, 0.0625f));
        EXPECT_NE(key({0.01f, 0.01f, 0.01f}, width), key({0.07f, 0.01f, 0.01f}, width));
        EXPECT_NE(key({0.01f, 0.01f, 0.01f}, width), key({-0.01f, 0.01f, 0.01f}, width));
    }
    EXPECT_NE(key(glm::vec3(0.01f), 0.088f), key(glm::vec3(0.01f), 0.089f));
    // Widths and places of any size have cells.
    for (const float width : {0.0f, 1e-30f, 1e30f, float_infinity}) {
        for (const float place : {0.0f, -1e9f, 1e30f}) EXPECT_NE(key(glm::vec3(place), width), 0u);
    }
}

TEST(DirectGrid, EveryCellHasAKeyOfItsOwn) {
    const DirectGrid grid;
    std::set<std::uint64_t> keys;
    for (const int instance : {1, 2}) {
        for (int facing = 0; facing < 6; ++facing) {
            glm::vec3 normal(0.1f);
            normal[facing / 2] = facing % 2 == 0 ? 0.9f : -0.9f;
            for (const float width : {0.5f, 1.0f}) {
                for (int i = 0; i < 24 * 24 * 24; ++i) {
                    const glm::vec3 cell(i % 24 - 4, i / 24 % 24 - 4, i / 576 - 4);
                    keys.insert(grid.key_of(instance, width * (cell + 0.5f), normal, width));
                }
            }
        }
    }
    EXPECT_EQ(keys.size(), 24u * 24u * 24u * 2u * 6u * 2u);
}

TEST(DirectGrid, BlocksOfEightByEightLieInTheSurfacesPlane) {
    const DirectGrid grid;
    for (int axis = 0; axis < 3; ++axis) {
        const int across = axis == 0 ? 1 : 0, along = axis == 2 ? 1 : 2;
        glm::vec3 normal(0.3f);
        normal[axis] = -0.8f;
        std::set<std::uint64_t> blocks;
        for (int a = 8; a < 16; ++a) {
            for (int b = -8; b < 0; ++b) {
                glm::vec3 place(0.5f);
                place[across] = static_cast<float>(a) + 0.5f;
                place[along] = static_cast<float>(b) + 0.5f;
                const std::uint64_t key = grid.key_of(3, place, normal, 1.0f);
                EXPECT_EQ(key & 63, static_cast<std::uint64_t>((a - 8) + 8 * (b + 8))) << axis;
                blocks.insert(key >> 6);
            }
        }
        EXPECT_EQ(blocks.size(), 1u) << axis;
        // Along the normal, cells begin at .63.
        glm::vec3 place(8.5f);
        const auto at = [&](float height) {
            place[axis] = height;
            return grid.key_of(3, place, normal, 1.0f);
        };
        EXPECT_EQ(at(0.64f), at(1.62f)) << axis;
        EXPECT_NE(at(0.64f), at(0.62f)) << axis;
        EXPECT_NE(at(1.64f), at(1.62f)) << axis;
    }
    // Between axes the first counts.
    const auto key = [&](const glm::vec3& normal) { return grid.key_of(0, {1.5f, 2.5f, 3.5f}, normal, 1.0f); };
    EXPECT_EQ(key({0.6f, 0.6f, 0.1f}), key({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(key({0.6f, 0.1f, -0.6f}), key({1.0f, 0.0f, 0.0f}));
    EXPECT_EQ(key({0.1f, 0.6f, 0.6f}), key(up));
}

TEST(DirectGrid, CellsScaleWithTheUnit) {
    const DirectGrid one, eight(8.0f);
    const glm::vec3 place(0.3f, -0.7f, 1.9f);
    for (const float width : {0.01f, 0.3f, 2.0f}) {
        EXPECT_EQ(one.key_of(1, place, up, width), eight.key_of(1, 8.0f * place, up, 8.0f * width)) << width;
        EXPECT_NE(one.key_of(1, place, up, width), eight.key_of(1, place, up, width)) << width;
    }
}

/// The cells of what a gather under a ceiling meets are as wide as its rays' shares of the hemisphere.
TEST(DirectGrid, GathersNoteTheCellsOfTheirHits) {
    Scene scene;
    add_mesh(scene, make_quad(400.0, 400.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, 2.0, 0.0}, z_to_down);
    add_light(scene, Light::Kind::directional, glm::dvec3(1.0), glm::dvec3(0.0), z_to_up);
    Gathering ceiling(std::move(scene));
    const GatherScratch& scratch = ceiling.scratch;
    const DirectGrid grid;
    std::vector<DirectSample> found;
    ceiling.gather(make_point(-glm::vec3(ceiling.stage.shading.anchor), up), {{6, 16}, {1, 2, 3, 4}},
                   {.grid = &grid, .found = &found});
    std::multiset<std::uint64_t> expected, noted;
    for (std::size_t i = 0; i < scratch.rays.size(); ++i) {
        const Hit& hit = scratch.hits[i];
        if (hit.instance == no_index) continue;
        const glm::vec3 direction = scratch.rays[i].direction;
        const double solid_angle = std::numbers::pi / (96.0 * std::max(direction.y, 0.05f));
        const glm::vec3 place(direction.x * hit.distance, 0.0f, direction.z * hit.distance);  // the quad's origin
        expected.insert(
            grid.key_of(hit.instance, place, -up, hit.distance * static_cast<float>(std::sqrt(solid_angle))));
    }
    for (const DirectSample& sample : found) noted.insert(sample.cell);
    EXPECT_GT(noted.size(), 90u);
    EXPECT_EQ(noted.size(), expected.size());
    std::vector<std::uint64_t> common;
    std::ranges::set_intersection(noted, expected, std::back_inserter(common));
    EXPECT_GE(common.size() + 4, expected.size());  // a few hits lie on borders, up to rounding
}

TEST(DirectGrid, SamplesAddUp) {
    DirectGrid grid;
    constexpr std::uint64_t cells = 50'000;  // it grows
    for (std::uint64_t i = 0; i < cells; ++i) {
        const DirectSample samples[] = {{mix_bits(i) | 1, Rgb(1.0f)}, {mix_bits(i) | 1, Rgb(static_cast<float>(i))}};
        grid.insert(samples);
    }
    const DirectSample bad[] = {{7, Rgb(float_nan)}, {7, Rgb(float_infinity)}};
    grid.insert(bad);
    for (std::uint64_t i = 0; i < cells; ++i) {
        const DirectGrid::Cell& cell = grid.find(mix_bits(i) | 1);
        ASSERT_EQ(cell.count, 2u);
        ASSERT_EQ(cell.sum, Rgb(1.0f + static_cast<float>(i)));
    }
    EXPECT_EQ(grid.find(7).count, 0u);
    DirectGrid single;
    const DirectSample one[] = {{5, Rgb(1.0f)}};
    single.insert(one);
    EXPECT_EQ(single.find(5).count, 1u);
}

/// Gathers all over the floor and a wall, with a grid that they fill or without one.
struct Gathers {
    std::vector<double> light;
    RayCounts counts;

    Gathers(const Stage& stage, std::uint32_t seed, bool with_grid) {
        DirectGrid grid;
        GatherScratch scratch;
        RayTask task(stage.rays);
        std::vector<DirectSample> found;
        for (int i = 0; i < 800; ++i) {
            const float x = glm::fract(static_cast<float>(i) * 0.75487767f),
                        y = glm::fract(static_cast<float>(i) * 0.56984029f);
            const SurfacePoint point =
                i % 2 == 0 ? make_point({3.8f * x - 1.9f, -1.499f, 4.8f * y - 2.4f}, up)
                           : make_point({-1.999f, 2.8f * x - 1.4f, 4.8f * y - 2.4f}, {1.0f, 0.0f, 0.0f});
            GatherOptions options;
            if (with_grid) options = {0, &grid, &found};
            const RandomKey key{seed, 0, static_cast<std::uint32_t>(i), 0};
            light.push_back(gather_irradiance(stage.lighting(), task, point, {choose_strata(96), key}, scratch, options)
                                .irradiance.y);
            if (i % 16 == 15) {
                grid.insert(found);
                found.clear();
            }
        }
        counts = task.counts;
    }
};

TEST(DirectGrid, GathersAreBiasedByLessThanOnePercent) {
    const Stage stage(make_cluttered_room());
    Mean bias, error, error_without;
    RayCounts with, without;
    for (std::uint32_t seed = 0; seed < 5; ++seed) {
        const Gathers truth(stage, seed, false), grid(stage, seed + 100, true), other(stage, seed + 200, false);
        double sum = 0.0, expected = 0.0;
        for (std::size_t i = 0; i < truth.light.size(); ++i) {
            sum += grid.light[i];
            expected += truth.light[i];
            error.add(std::abs(grid.light[i] / truth.light[i] - 1.0));
            error_without.add(std::abs(other.light[i] / truth.light[i] - 1.0));
        }
        bias.add(sum / expected - 1.0);
        with += grid.counts;
        without += truth.counts;
    }
    EXPECT_LT(std::abs(bias.mean()), 0.006 + 2.0 * bias.error());
    EXPECT_LT(bias.error(), 0.004);
    EXPECT_LT(error.mean(), error_without.mean());  // the cells' means have less noise than single samples
    EXPECT_EQ(with.gather, without.gather);
    EXPECT_LT(static_cast<double>(with.shadow), 0.7 * static_cast<double>(without.shadow));
}

TEST(DirectGrid, AGridOfItsOwnSamplesNeedsNoShadowRays) {
    Gathering room(make_cluttered_room());
    DirectGrid grid;
    const auto gather = [&](const GatherOptions& options) {
        return room.gather(make_point({-0.2f, -1.499f, -0.2f}, up), {choose_strata(256), {1, 2, 3, 4}}, options);
    };
    std::vector<DirectSample> found;
    const IrradianceSample first = gather({.grid = &grid, .found = &found});
    // An empty grid changes nothing.
    const IrradianceSample alone = gather({});
    EXPECT_NEAR(first.irradiance.y, alone.irradiance.y, 1e-5f * alone.irradiance.y);
    EXPECT_FALSE(found.empty());
    for (std::uint32_t i = 0; i < DirectGrid::enough; ++i) grid.insert(found);
    const std::uint64_t shadow = room.task.counts.shadow;
    // Each ray has the mean of its cell: the sum is that of the samples.
    EXPECT_NEAR(gather({.grid = &grid}).irradiance.y, first.irradiance.y, 1e-4f * first.irradiance.y);
    EXPECT_EQ(room.task.counts.shadow, shadow);
}

}  // namespace
}  // namespace aleph
