// Paths weigh light sampling against lobe sampling: the mean must be that of either alone.

#include "render/surface/glass.h"
#include "tests/support/lobes.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

enum class Surroundings { small_lamp, large_lamp, many_lamps, constant, picture };

/// A bright floor below the origin, a wall to its left, and a light.
Scene make_surroundings(Surroundings which) {
    Scene scene;
    const int grey = add_lambert(scene, {0.7, 0.5, 0.3}, glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 4.0, grey), {0.0, -1.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(4.0, 4.0, grey), {-1.5, 0.0, 0.0}, turn_about_y(1.2));
    const double radiance = which == Surroundings::small_lamp ? 20.0 : 2.0;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), radiance * glm::dvec3(2.0, 1.5, 1.0), true);
    switch (which) {
        case Surroundings::small_lamp:
            add_mesh(scene, make_quad(0.4, 0.4, lamp), {0.9, 1.0, 0.0}, z_to_down);
            add_mesh(scene, make_quad(0.4, 0.4, lamp), {-0.5, -0.6, 0.3}, z_to_down);
            break;
        case Surroundings::large_lamp:
            add_mesh(scene, make_quad(4.0, 3.0, lamp), {0.6, 1.5, 0.0}, z_to_down);
            break;
        case Surroundings::many_lamps:  // more than are compared at a point
            for (int i = 0; i < 40; ++i) {
                const double size = i % 4 == 0 ? 0.4 : 0.2;
                add_mesh(scene, make_quad(size, size, lamp),
                         {0.5 * (i % 8) - 1.2, i % 3 == 0 ? -0.7 : 1.2, 0.5 * (i / 8) - 1.0}, z_to_down);
            }
            break;
        case Surroundings::constant:
            scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0, 0.8, 0.6));
            break;
        case Surroundings::picture: {
            Image<Rgb> picture(16, 8, Rgb(0.2f));
            picture(11, 2) = Rgb(20.0f, 15.0f, 10.0f);
            picture(4, 5) = Rgb(10.0f);
            add_surroundings(scene, picture);
            break;
        }
    }
    return scene;
}

SurfaceMaterial make_plastic() {
    SurfaceMaterial material = make_white_plastic(0.15f);
    material.diffuse = Rgb(0.5f);
    return material;
}

SurfaceMaterial make_rough_sheet() {
    return {.gloss = {.alpha = 0.3f}, .glass = {.share = 0.9f, .tint = Rgb(0.9f, 0.8f, 0.7f)}};
}

SurfaceMaterial make_coated() {
    return with_sheen(with_coat(make_plastic(), 0.4f, 0.8f), std::sqrt(0.5f), 0.4f);
}

const glm::vec3 slanted_view = glm::normalize(glm::vec3(-0.7f, 0.6f, 0.2f));

class PathWeights : public testing::TestWithParam<Surroundings> {};

TEST_P(PathWeights, BothWaysAloneGiveTheSameMean) {
    const Stage stage(make_surroundings(GetParam()));
    SurfaceMaterial volume = make_rough_sheet();
    volume.glass.volume = true;
    constexpr int depth = 3, count = 5000;
    std::uint32_t seed = 0;
    for (const SurfaceMaterial& material :
         {make_lambert(0.8f), make_metal(0.3f), make_plastic(), make_rough_sheet(), volume, make_coated()}) {
        SCOPED_TRACE(seed);
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up, 1e-4f), material, slanted_view};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const auto mean_of = [&](int samples, const Estimator& estimator, std::uint32_t stream) {
                return estimate(stage, surface, trial.times(samples), estimator, seed + stream + trial.seed);
            };
            const Mean paths = mean_of(count, by_paths(depth, depth), 0);
            trial.near(paths, mean_of(2 * count, by_lobes(depth), 100));
            // Samples of a constant environment lie above the surface, so that glass finds the rest by its lobe.
            if (GetParam() != Surroundings::constant || !material.has_glass()) {
                trial.near(paths, mean_of(2 * count, by_lights(depth), 200));
            }
            EXPECT_GT(paths.mean(), 0.05);
            EXPECT_LT(paths.error(), 0.05 * paths.mean());
        }));
        ++seed;
    }
}

INSTANTIATE_TEST_SUITE_P(Lights, PathWeights,
                         testing::Values(Surroundings::small_lamp, Surroundings::large_lamp, Surroundings::many_lamps,
                                         Surroundings::constant, Surroundings::picture));

/// Samples of direct light, and as many of the lobes that meet lights, of which every one is weighted.
Estimator by_direct_samples_and_lobes(int count) {
    return [=](const Stage& stage, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        const LitSurface lit(surface);
        const LobeShares shares = share_lobes(lit, LobeSet::all);
        const PixelSequence sequence(static_cast<std::uint32_t>(random.next() * 0x1p24f), 0, 5, 7);
        Rgb sum = sample_direct_light(stage.lighting(), task, lit, shares, sequence, {0, count});
        for (int i = 0; i < count; ++i) {
            const ScatterSample sample =
                sample_scatter(lit, shares, random.next(), sequence.at_2d(SampleUse::lobe_direction, i), random.next());
            sum += follow_sample(stage.lighting(), task, lit, sample, {}, random) / static_cast<float>(count);
        }
        return sum;
    };
}

TEST_P(PathWeights, SharedSamplesOfDirectLightHaveTheSameMean) {
    const Stage stage(make_surroundings(GetParam()));
    std::uint32_t seed = 0;
    for (const SurfaceMaterial& material : {make_lambert(0.8f), make_metal(0.3f), make_plastic(), make_coated()}) {
        SCOPED_TRACE(seed);
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up, 1e-4f), material, slanted_view};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean lobes = estimate(stage, surface, trial.times(6000), by_lobes(1), seed + 100 + trial.seed);
            for (const int count : {1, 4}) {
                const Mean shared = estimate(stage, surface, trial.times(2400) / count,
                                             by_direct_samples_and_lobes(count), seed + trial.seed);
                trial.near(shared, lobes);
                EXPECT_LT(shared.error(), 0.05 * shared.mean());
            }
        }));
        ++seed;
    }
}

TEST(PathWeights, BothWaysTogetherAreHardlyNoisierThanTheBetterOne) {
    // A lamp in the mirror direction: samples of it are better for broad lobes, those of the lobe for narrow ones.
    Scene scene;
    add_lamp(scene, 2.0, glm::dvec3(5.0), {0.0, 1.5, 0.0});
    const Stage stage(std::move(scene));
    const glm::vec3 view = glm::normalize(glm::vec3(-0.4f, 1.0f, 0.1f));
    for (const float alpha : {0.05f, 0.3f, 1.0f}) {
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up), make_metal(alpha), view};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const int rays = trial.times(100'000);
            const Mean lamps = estimate(stage, surface, rays, by_lights(1), 5 + trial.seed);
            const Mean lobes = estimate(stage, surface, rays, by_lobes(1), 6 + trial.seed);
            const Mean both = estimate(stage, surface, rays / 32, by_direct_samples_and_lobes(16), trial.seed);
            EXPECT_GT(both.mean(), 0.1);
            trial.near(both, lamps);
            trial.near(both, lobes);
            EXPECT_LT(both.error(), 2.0 * std::min(lamps.error(), lobes.error()));
        })) << alpha;
    }
}

TEST(PathWeights, AMirrorAndASmoothSheetFindLampsByThemselves) {
    const Stage stage(make_surroundings(Surroundings::large_lamp));
    SurfaceMaterial sheet = make_rough_sheet();
    sheet.gloss.alpha = 0.0f;
    const glm::vec3 view = glm::normalize(glm::vec3(-0.4f, 0.9f, 0.2f));
    for (const SurfaceMaterial& material : {make_metal(0.0f), sheet}) {
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up, 1e-4f), material, view};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean paths = estimate(stage, surface, trial.times(5000), by_paths(2, 3), 1 + trial.seed);
            trial.near(paths, estimate(stage, surface, trial.times(10'000), by_lobes(3), 2 + trial.seed), 1e-6);
            EXPECT_GT(paths.mean(), 0.1);
        }));
    }
}

/// Light that a sheet reflects and passes straight from lamps.
Estimator by_both_ways(int splits, float weight = 1.0f) {
    return [=](const Stage& stage, RayTask& task, const ViewedSurface& surface, RandomStream& random) {
        const LitSurface lit(surface);
        PathState state{.left = {1, 0}, .splits = splits};
        state.throughput = Rgb(weight);
        const ScatterSample sample = sample_scatter(lit, share_lobes(lit, LobeSet::specular), random);
        return follow_sample(stage.lighting(), task, lit, sample, state, random);
    };
}

/// A lamp above the sheet, and none below: one sample of many would be reflected.
TEST(PathWeights, SmoothGlassIsFollowedBothWays) {
    const Stage lamp(make_surroundings(Surroundings::large_lamp));
    SurfaceMaterial sheet = make_rough_sheet();
    sheet.gloss.alpha = 0.0f;
    const ViewedSurface surface{make_point(glm::vec3(0.0f), up, 1e-4f), sheet, up};
    EXPECT_TRUE(holds([&](Trial& trial) {
        const int count = trial.times(20'000);
        const Mean chosen = estimate(lamp, surface, count, by_both_ways(0), 1 + trial.seed);
        const Mean both = estimate(lamp, surface, count, by_both_ways(3), 2 + trial.seed);
        EXPECT_GT(both.mean(), 0.05);
        EXPECT_LT(both.error(), 0.5 * chosen.error());
        trial.near(both, chosen);
    }));
    // Near the horizon most of it is reflected: of even light, what is not reflected passes the tint.
    Scene even;
    even.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    const Stage sky(std::move(even));
    const ViewedSurface slanted{surface.point, sheet, glm::normalize(glm::vec3(1.0f, 0.1f, 0.0f))};
    const float reflected = glass_reflectance(slanted.material, LitSurface(slanted).cos_view);
    EXPECT_GT(reflected, 0.5f);
    const double expected = sheet.glass.share * (reflected + (1.0 - reflected) * luminance(sheet.glass.tint));
    for (const auto& [splits, weight] : {std::pair(0, 1.0f), std::pair(3, 1.0f), std::pair(3, 0.03f)}) {
        EXPECT_TRUE(holds([&, splits = splits, weight = weight](Trial& trial) {
            const Mean found = estimate(sky, slanted, trial.times(20'000), by_both_ways(splits, weight), trial.seed);
            trial.near(found, weight * expected, 1e-5 * weight);
        }));
    }
}

/// Its samples may fail, and then count as nothing.
TEST(PathWeights, RoughGlassIsFollowedOneWay) {
    Scene surroundings;
    surroundings.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    const Stage stage(surroundings);
    SurfaceMaterial sheet = make_rough_sheet();
    sheet.gloss.alpha = 0.64f;
    const ViewedSurface surface{make_point(glm::vec3(0.0f), up, 1e-4f), sheet, glm::normalize(glm::vec3(1.7f, 1, 0))};
    EXPECT_TRUE(holds([&](Trial& trial) {
        const int count = trial.times(20'000);
        trial.near(estimate(stage, surface, count, by_both_ways(3), 1 + trial.seed),
                   estimate(stage, surface, count, by_both_ways(0), 2 + trial.seed));
    }));
}

/// A floor under a lamp, with a sheet of glass between them.
Scene make_sheet_scene(double roughness, double lamp_side = 1.0) {
    Scene scene;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(6.0), true);
    add_mesh(scene, make_quad(lamp_side, lamp_side, lamp), {0.0, 2.0, 0.0}, z_to_down);
    scene.materials.push_back({.base_color = glm::dvec3(0.9, 0.7, 0.8),
                               .gloss = {.metallic = 0.0, .roughness = roughness},
                               .glass = {.transmission = 1.0}});
    add_mesh(scene, make_quad(6.0, 6.0, 1), {0.0, 1.0, 0.0}, z_to_up);
    return scene;
}

TEST(PathWeights, LightPassesAThinSheet) {
    const Stage clear(make_sheet_scene(0.0)), rough(make_sheet_scene(0.6));
    EXPECT_TRUE(clear.shading.has_thin_glass);
    Scene textured = make_sheet_scene(0.0);
    textured.materials[1].glass.thickness = 1.0;
    EXPECT_FALSE(Stage(textured).shading.has_thin_glass);
    textured.images.push_back({.floats = Image<glm::vec4>(1, 1)});
    textured.materials[1].textures[TextureSlot::thickness].image = 0;
    EXPECT_TRUE(Stage(textured).shading.has_thin_glass) << "texels may be 0";
    const ViewedSurface floor{make_point({0.2f, 0.0f, 0.1f}, up, 1e-4f), make_lambert(0.6f), up};
    for (const Stage* stage : {&clear, &rough}) {
        EXPECT_TRUE(holds([&](Trial& trial) {
            trial.near(estimate(*stage, floor, trial.times(20'000), by_paths(4, 4), 1 + trial.seed),
                       estimate(*stage, floor, trial.times(100'000), by_lobes(4), 2 + trial.seed));
        }));
    }
    // Light straight from the lamp: each sample is what an open floor would get, times the share that passes.
    Scene open = make_sheet_scene(0.0);
    open.nodes[1].visible = 0.0;
    const Stage bare(std::move(open));
    Scene two = make_sheet_scene(0.0);
    add_mesh(two, make_quad(6.0, 6.0, 1), {0.0, 0.5, 0.0}, z_to_up);
    const Stage doubled(std::move(two));
    for (const Estimator& estimator : {by_paths(0, 1), by_direct_samples(1)}) {
        const Mean through = estimate(clear, floor, 4000, estimator, 1),
                   without = estimate(bare, floor, 4000, estimator, 1);
        const double passed = through.mean() / without.mean(), tint = luminance({0.9f, 0.7f, 0.8f});
        EXPECT_LT(passed, 0.96 * tint);  // index 1.5: 4 % is reflected, more at an angle
        EXPECT_GT(passed, 0.93 * tint);
        const double twice = estimate(doubled, floor, 4000, estimator, 1).mean() / without.mean();
        EXPECT_NEAR(twice, passed * passed, 0.02);
    }
}

/// The light sample of the last surface leaves a part of its weight to the ray, which looks through the sheet too.
TEST(PathWeights, TheLastSurfaceSeesALargeLampThroughASheet) {
    const Stage stage(make_sheet_scene(0.0, 8.0));
    const ViewedSurface floor{make_point({0.2f, 0.0f, 0.1f}, up, 1e-4f), make_lambert(0.6f), up};
    EXPECT_TRUE(holds([&](Trial& trial) {
        trial.near(estimate(stage, floor, trial.times(40'000), by_paths(3, 1), 1 + trial.seed),
                   estimate(stage, floor, trial.times(40'000), by_paths(3, 2), 2 + trial.seed));
    }));
}

}  // namespace
}  // namespace aleph
