// Rays aimed at bright surfaces, of gathers and of samples, against those that are not.

#include "render/cache/aimed_rays.h"

#include "tests/support/shaded_lamp.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

using Gather = std::function<float(int rays, std::uint32_t seed, bool aims)>;

/// @param most  standard error over that without aimed rays
void expect_less_noise(const Gather& gather, double most) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean with, without;
        for (std::uint32_t run = 0; run < trial.times(256u); ++run) {
            with.add(gather(256, run + trial.seed, true));
            without.add(gather(384, run + trial.seed + 5000, false));
        }
        trial.near(with, without);
        EXPECT_LT(with.error(), most * without.error());
    }));
}

/// On the floor, where the tube's inside is small; under its opening; on its inside, with a bright surface an edge
/// away.
TEST(AimedRays, KeepTheMeanAndLowerTheNoise) {
    ShadedLamp lamp;
    const auto expect_at = [&](const glm::vec3& position, const glm::vec3& normal, double most) {
        SCOPED_TRACE(position.x);
        expect_less_noise([&](int rays, std::uint32_t seed,
                              bool aims) { return lamp.gather(position, normal, rays, seed, aims).irradiance.x; },
                          most);
    };
    expect_at({0.7f, 0.0f, 0.3f}, up, 0.25);
    expect_at({0.02f, ShadedLamp::height - 0.3f, 0.0f}, up, 0.5);
    expect_at({0.0f, ShadedLamp::height + 0.1f, -0.0999f}, {0.0f, 0.0f, 1.0f}, 1.25);
}

TEST(AimedRays, MeetASpotOfLight) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    add_small_room(scene, grey, grey, glm::dvec3(0.0), 0.1);
    add_light(scene, Light::Kind::spot, glm::dvec3(10.0), {0.5, 0.5, 0.0});  // along -z
    scene.lights.back().inner_cone = scene.lights.back().outer_cone = Track<double>(0.15);
    Gathering gathering(std::move(scene));
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(gathering.stage, make_floor_places(-1.0f), counts);
    ASSERT_FALSE(surfaces.empty());
    expect_less_noise(
        [&](int rays, std::uint32_t seed, bool aims) {
            const GatherPattern pattern{choose_strata(rays), {seed, 0, 0, 0}};
            return gathering
                .gather(make_point({-0.5f, -0.9999f, 0.2f}, up), pattern, {.bright = aims ? &surfaces : nullptr})
                .irradiance.x;
        },
        0.25);
}

TEST(AimedRays, TellTheirError) {
    ShadedLamp lamp;
    Mean value, told;
    for (std::uint32_t run = 0; run < 256; ++run) {
        const IrradianceSample sample = lamp.gather({0.7f, 0.0f, 0.3f}, up, 256, run);
        value.add(sample.irradiance.x);
        told.add(sample.relative_error);
        EXPECT_EQ(sample.rays, choose_strata(256).count() * 3 / 2);
    }
    const double spread = value.error() * 16.0 / value.mean();
    EXPECT_GT(told.mean(), 0.5 * spread);
    EXPECT_LT(told.mean(), 2.0 * spread);
}

TEST(AimedRays, HaveGradients) {
    ShadedLamp lamp;
    const auto mean_of = [&](const glm::vec3& position, const glm::vec3& normal, const auto& value) {
        double sum = 0.0;
        for (std::uint32_t run = 0; run < 64; ++run) sum += value(lamp.gather(position, normal, 4096, run));
        return sum / 64.0;
    };
    const auto light = [](const IrradianceSample& sample) { return sample.irradiance.x; };
    // Under the tube, where no edge of it hides its inside from one of the places and not from the other.
    const glm::vec3 here(0.03f, ShadedLamp::height - 0.5f, 0.0f), step(0.02f, 0.0f, 0.0f);
    const double slope = (mean_of(here + step, up, light) - mean_of(here - step, up, light)) / 0.04;
    const double told =
        mean_of(here, up, [](const IrradianceSample& sample) { return sample.gradients.translation[0].x; });
    EXPECT_NEAR(told, slope, 0.15 * std::abs(slope));
    const glm::vec3 aside(0.5f, 0.0f, 0.0f);
    const auto tilted = [](float angle) { return glm::vec3(std::sin(angle), std::cos(angle), 0.0f); };
    const double turn = (mean_of(aside, tilted(0.05f), light) - mean_of(aside, tilted(-0.05f), light)) / 0.1;
    const glm::vec3 axis = glm::cross(up, tilted(0.05f)) / 0.05f;
    const double told_turn = mean_of(
        aside, up, [&](const IrradianceSample& sample) { return glm::dot(axis, sample.gradients.rotation[0]); });
    EXPECT_NEAR(told_turn, turn, 0.05 * std::abs(turn));
}

/// A wall of one mesh, in tiles as wide as the lamp that shines on its middle from close by.
Scene make_lit_spot() {
    constexpr int tiles = 15;
    Scene scene;
    Mesh wall;
    wall.material = add_lambert(scene, glm::dvec3(0.8));
    for (int y = 0; y <= tiles; ++y) {
        for (int x = 0; x <= tiles; ++x) {
            wall.positions.emplace_back(ShadedLamp::side * (static_cast<float>(x) - 0.5f * tiles),
                                        ShadedLamp::side * (static_cast<float>(y) - 0.5f * tiles), 0.0f);
        }
    }
    const auto corner = [](int x, int y) { return static_cast<unsigned>(y * (tiles + 1) + x); };
    for (const auto [x, y] : all_pixels(tiles, tiles)) {
        wall.triangles.emplace_back(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
        wall.triangles.emplace_back(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
    }
    add_mesh(scene, wall);
    add_lamp(scene, ShadedLamp::side, glm::dvec3(100.0), {0.0, 0.0, 0.1},
             glm::angleAxis(pi, glm::dvec3(0.0, 1.0, 0.0)));
    return scene;
}

/// Rays that are aimed meet the middle of the wall far more often than the rest. Gathers that share its light must not
/// take that for the light of the whole wall, nor that of its brightest patches for all of them: they share it in cells
/// as wide as what a ray represents.
TEST(AimedRays, DoNotStandForAllSharedLight) {
    Gathering gathering(make_lit_spot());
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(gathering.stage, make_floor_places(-1.0f), counts);
    ASSERT_FALSE(surfaces.empty());
    DirectGrid grid;
    std::vector<DirectSample> found;
    const auto gather = [&](std::uint32_t run, int rays, const DirectGrid* known) {
        const SurfacePoint point =
            make_point({1.0f + 1e-3f * static_cast<float>(run % 64), 0.0f, 2.0f}, glm::vec3(0.0f, 0.0f, -1.0f));
        return gathering.gather(point, {choose_strata(rays), {run, 0, 0, 0}},
                                {.grid = known, .found = known != nullptr ? &found : nullptr, .bright = &surfaces});
    };
    for (std::uint32_t run = 0; run < 512; ++run) {
        gather(run, 128, &grid);
        grid.insert(found);
        found.clear();
    }
    for (const int rays : {16, 32, 64, 128, 512, 2048, 8192}) {
        Mean shared, own;
        for (std::uint32_t run = 0; run < 65536u / static_cast<unsigned>(rays); ++run) {
            shared.add(gather(1000 + run, rays, &grid).irradiance.x);
            own.add(gather(5000 + run, rays, nullptr).irradiance.x);
        }
        EXPECT_NEAR(shared.mean(), own.mean(), 0.03 * own.mean() + 3.0 * own.error()) << rays;
    }
}

/// A wall of dark and bright squares, a lamp in front of it.
Scene make_lit_squares() {
    constexpr int squares = 15, texels = 8;  // along each side; of a square's side
    Scene scene;
    SceneImage image{.bytes = Image<glm::u8vec4>(squares * texels, squares * texels)};
    for (const auto [x, y] : all_pixels(image.bytes.width, image.bytes.height)) {
        const bool bright = (x / texels + y / texels) % 2 == 0;
        image.bytes(x, y) = bright ? glm::u8vec4(255) : glm::u8vec4(0, 0, 0, 255);
    }
    scene.images.push_back(image);
    const int wall = add_lambert(scene, glm::dvec3(1.0));
    scene.materials[wall].textures[TextureSlot::base_color] = {.image = 0};
    add_mesh(scene, make_quad(3.0, 3.0, wall));
    add_lamp(scene, 0.5f * ShadedLamp::side, glm::dvec3(100.0), {0.03, 0.05, 0.6},
             glm::angleAxis(pi, glm::dvec3(0.0, 1.0, 0.0)));
    return scene;
}

/// Rays are aimed at the bright squares. Were textures filtered less there than beside them, squares would be as bright
/// as they are, and the dark ones between them half as bright.
TEST(AimedRays, KeepTheMeanOfTextures) {
    Gathering gathering(make_lit_squares());
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(gathering.stage, make_floor_places(-1.0f), counts);
    ASSERT_FALSE(surfaces.empty());
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean with, without;
        for (std::uint32_t run = 0; run < trial.times(512u); ++run) {
            const SurfacePoint point = make_point({1.0f, 0.2f, 2.0f}, glm::vec3(0.0f, 0.0f, -1.0f));
            const std::uint32_t seed = run + trial.seed;
            const auto gather = [&](std::uint32_t number, const BrightSurfaces* bright) {
                return gathering.gather(point, {choose_strata(128), {number, 0, 0, 0}}, {.bright = bright})
                    .irradiance.x;
            };
            with.add(gather(seed, &surfaces));
            without.add(gather(seed + 50000, nullptr));
        }
        trial.near(with, without, 0.01 * without.mean());
    }));
}

/// Samples whose irradiance no record knows aim as well. The noise of single pictures is compared to that of paths,
/// which do not.
TEST(AimedRays, OfSamplesAgreeWithThePathTracer) {
    Scene scene = ShadedLamp::make_scene();
    add_camera(scene, {1.2, 0.8, 1.2}, {0.5, 0.0, 0.0}, 0.5);
    const Stage stage(std::move(scene), 12, 9);
    RenderSettings aiming = plain_settings(0.0, 0);
    aiming.light.bounces = 1;
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean samples, paths;
        for (std::uint32_t run = 0; run < trial.times(48u); ++run) {
            aiming.sampling.spp = 16;
            aiming.seed = run + trial.seed;
            samples.add(mean_of_pixels(shade(stage, aiming)).mean());
            paths.add(mean_of_pixels(shade(stage, path_settings(1, 32, run + trial.seed))).mean());
        }
        trial.near(samples, paths);
        EXPECT_LT(samples.error(), 0.5 * paths.error());
    }));
}

}  // namespace
}  // namespace aleph
