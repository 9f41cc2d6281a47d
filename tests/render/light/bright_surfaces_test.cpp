// Bright surfaces against closed forms, and gathers that aim at them against gathers that do not.

#include "render/light/bright_surfaces.h"

#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

constexpr float side = 0.2f, height = 1.0f;  // m

const glm::vec3 back(0.0f, 0.0f, -1.0f);

/// Places of a floor.
std::vector<Receiver> make_floor_places(float y) {
    std::vector<Receiver> places;
    for (const float x : {-0.9f, 0.0f, 0.9f}) {
        for (const float z : {-0.9f, 0.0f, 0.9f}) places.push_back({{x, y, z}, up});
    }
    return places;
}

BrightSurfaces find_bright(const Stage& stage, const std::vector<Receiver>& places, RayCounts& counts) {
    return find_bright_surfaces(stage.lighting(), places, counts);
}

/// A lamp that closes the top of a square tube, as wide as it is high, above a grey floor. The tube is white, with its
/// front side inside.
Scene make_shaded_lamp() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    const int grey = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_quad(6.0, 6.0, grey), glm::dvec3(0.0), z_to_up);
    add_lamp(scene, side, glm::dvec3(100.0), {0.0, height + side, 0.0});
    for (int i = 0; i < 4; ++i) {
        const double angle = i * std::numbers::pi / 2;
        add_mesh(scene, make_quad(side, side, white),
                 {-0.5 * side * std::sin(angle), height + 0.5 * side, -0.5 * side * std::cos(angle)},
                 turn_about_y(angle));
    }
    return scene;
}

struct ShadedLamp {
    ShadedLamp() : gathering(make_shaded_lamp()) {
        RayCounts counts;
        surfaces = find_bright(gathering.stage, make_floor_places(0.0f), counts);
        light_rays = counts.gather;
    }
    IrradianceSample gather(const glm::vec3& position, const glm::vec3& normal, int rays, std::uint32_t seed,
                            bool aims = true) {
        return gathering.gather(make_point(position, normal), {choose_strata(rays), {seed, 0, 0, 0}},
                                {.bright = aims ? &surfaces : nullptr});
    }

    Gathering gathering;
    BrightSurfaces surfaces;
    std::uint64_t light_rays = 0;
};

/// A face of a cube beside one that shines gets .200044 of its light, the opposite one .199825 (Howell 2010, "A
/// Catalog of Radiation Heat Transfer Configuration Factors", C-11 and C-14).
TEST(BrightSurfaces, AreTheInsideOfAShade) {
    const ShadedLamp lamp;
    EXPECT_EQ(lamp.light_rays, BrightSurfaces::light_rays + BrightSurfaces::more_light_rays);
    double reflected = 0.0;
    int patches = 0;
    for (const Emitter& patch : lamp.surfaces.patches.emitters) {
        if (patch.center.y < 0.5f * height) continue;  // of the floor under the opening
        ++patches;
        const glm::vec3 to_axis = glm::vec3(0.0f, patch.center.y, 0.0f) - patch.center;
        EXPECT_GT(glm::dot(patch.triangles.front().normal, to_axis), 0.09f);
        reflected += pi * patch.area * luminance(patch.radiance);
    }
    EXPECT_EQ(patches, 8);
    EXPECT_NEAR(reflected, 0.8 * 4.0 * 0.200044 * 100.0 * pi * side * side, 0.01 * reflected);
}

/// Share of what leaves a point of a plane in all directions that meets a rectangle parallel to it at distance 1, of
/// which a corner faces the point (Howell 2010, B-3).
double find_factor(double width, double depth) {
    const double a = std::sqrt(1.0 + width * width), b = std::sqrt(1.0 + depth * depth);
    return (width / a * std::atan(depth / a) + depth / b * std::atan(width / b)) / (2.0 * std::numbers::pi);
}

/// A lamp close above a wide floor of two triangles.
TEST(BrightSurfaces, ArePartsOfLargeTriangles) {
    constexpr double above = 0.25, radiance = 50.0, albedo = 0.5;  // m, cd/m2
    Scene scene;
    add_mesh(scene, make_quad(6.0, 6.0, add_lambert(scene, glm::dvec3(albedo))), glm::dvec3(0.0), z_to_up);
    add_lamp(scene, side, glm::dvec3(radiance), {0.0, above, 0.0});
    const Stage stage(std::move(scene));
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(stage, {{{0.0f, 1.0f, 1.0f}, back}}, counts);
    const auto find = [&](double x, double z) {
        RayTask task(stage.rays);
        const glm::vec3 down(0.0f, -1.0f, 0.0f);
        return surfaces.find(task.tracer.intersect({{x, 0.5 * above, z}, down}), down);
    };
    EXPECT_NE(find(0.01, 0.003), no_index);
    EXPECT_EQ(find(2.0, 1.0), no_index);
    EXPECT_EQ(find(-1.0, 2.0), no_index);
    const auto reflect = [&](const glm::vec3& place) {
        double factor = 0.0;
        for (const double x : {-1.0, 1.0}) {
            for (const double z : {-1.0, 1.0}) {
                factor += find_factor((0.5 * side + x * place.x) / above, (0.5 * side + z * place.z) / above);
            }
        }
        return albedo * radiance * factor;
    };
    double area = 0.0, found = 0.0, expected = 0.0;
    for (const Emitter& patch : surfaces.patches.emitters) {
        const Emitter::Triangle& t = patch.triangles.front();
        constexpr int rows = 16;
        double mean = 0.0;
        for (int i = 0; i < rows * rows; ++i) {
            const glm::vec2 b = sample_triangle({(i / rows + 0.5f) / rows, (i % rows + 0.5f) / rows});
            const glm::vec3 place = t.corner + b.x * t.edge1 + b.y * t.edge2;
            mean += reflect(place) / (rows * rows);
            EXPECT_EQ(find(place.x, place.z), &patch - surfaces.patches.emitters.data());
        }
        EXPECT_NEAR(luminance(patch.radiance), mean, 0.25 * mean);
        area += patch.area;
        found += patch.area * luminance(patch.radiance);
        expected += patch.area * mean;
    }
    EXPECT_NEAR(found, expected, 0.01 * expected);
    EXPECT_GT(found, 0.7 * albedo * radiance * side * side);
    EXPECT_LT(area, 1.5);
}

TEST(BrightSurfaces, AreMetFromTheirBrightSideOnly) {
    const ShadedLamp lamp;
    const auto find = [&](const glm::vec3& from, const glm::vec3& direction) {
        RayTask task(lamp.gathering.stage.rays);
        return lamp.surfaces.find(task.tracer.intersect({from, direction}), direction);
    };
    const glm::vec3 inside(0.0f, height + 0.1f, 0.0f);
    EXPECT_NE(find(inside, {1.0f, 0.0f, 0.0f}), no_index);
    EXPECT_EQ(find(inside + glm::vec3(2.0f, 0.0f, 0.0f), {-1.0f, 0.0f, 0.0f}), no_index);
    EXPECT_EQ(find(inside, {0.0f, -1.0f, 0.0f}), no_index);  // the floor
    EXPECT_EQ(find(inside + glm::vec3(2.0f, 0.0f, 0.0f), {0.0f, 1.0f, 0.0f}), no_index);
}

TEST(BrightSurfaces, AreNoneWhereNothingStandsOut) {
    for (const bool dark : {false, true}) {
        Scene scene;
        add_small_room(scene, add_lambert(scene, glm::dvec3(0.5)), add_lambert(scene, glm::dvec3(0.5)),
                       glm::dvec3(dark ? 0.0 : 10.0), 1.0);
        const Stage stage(std::move(scene));
        RayCounts counts;
        EXPECT_TRUE(find_bright(stage, make_floor_places(-1.0f), counts).empty());
        EXPECT_EQ(counts.gather, dark ? 0u : BrightSurfaces::light_rays);
        EXPECT_TRUE(find_bright(stage, {}, counts).empty());
    }
}

/// On the floor, where the tube's inside is small; under its opening; on its inside, with a bright surface an edge
/// away.
TEST(BrightSurfaces, AimedRaysKeepTheMeanAndLowerTheNoise) {
    ShadedLamp lamp;
    struct Place {
        glm::vec3 position, normal;
        double most;  ///< standard error over that without aimed rays
    };
    for (const Place& place : {Place{{0.7f, 0.0f, 0.3f}, up, 0.25}, Place{{0.02f, height - 0.3f, 0.0f}, up, 0.5},
                               Place{{0.0f, height + 0.1f, -0.0999f}, {0.0f, 0.0f, 1.0f}, 1.25}}) {
        SCOPED_TRACE(place.position.x);
        EXPECT_TRUE(holds([&](Trial& trial) {
            Mean with, without;
            for (std::uint32_t run = 0; run < trial.times(256u); ++run) {
                with.add(lamp.gather(place.position, place.normal, 256, run + trial.seed).irradiance.x);
                without.add(
                    lamp.gather(place.position, place.normal, 384, run + trial.seed + 5000, false).irradiance.x);
            }
            trial.near(with, without);
            EXPECT_LT(with.error(), place.most * without.error());
        }));
    }
}

/// A spot light on a wall.
TEST(BrightSurfaces, ArePlacesInSpotLight) {
    Scene scene;
    add_small_room(scene, add_lambert(scene, glm::dvec3(0.5)), add_lambert(scene, glm::dvec3(0.5)), glm::dvec3(0.0),
                   0.1);
    add_light(scene, Light::Kind::spot, glm::dvec3(10.0), {0.5, 0.5, 0.0});  // along -z
    scene.lights.back().inner_cone = scene.lights.back().outer_cone = Track<double>(0.15);
    Gathering gathering(std::move(scene));
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(gathering.stage, make_floor_places(-1.0f), counts);
    ASSERT_FALSE(surfaces.empty());
    const auto gather = [&](int rays, std::uint32_t seed, const BrightSurfaces* bright) {
        const GatherPattern pattern{choose_strata(rays), {seed, 0, 0, 0}};
        return gathering.gather(make_point({-0.5f, -0.9999f, 0.2f}, up), pattern, {.bright = bright}).irradiance.x;
    };
    EXPECT_TRUE(holds([&](Trial& trial) {
        Mean with, without;
        for (std::uint32_t run = 0; run < trial.times(256u); ++run) {
            with.add(gather(256, run + trial.seed, &surfaces));
            without.add(gather(384, run + trial.seed + 5000, nullptr));
        }
        trial.near(with, without);
        EXPECT_LT(with.error(), 0.25 * without.error());
    }));
}

/// Sunlight through a window, on the floor of a room whose roof it lights as well.
TEST(BrightSurfaces, ArePlacesInSunlightThatFaceTheRoom) {
    Scene scene;
    add_small_room(scene, add_lambert(scene, glm::dvec3(0.5)), add_lambert(scene, glm::dvec3(0.5)), glm::dvec3(0.0),
                   0.1);
    add_mesh(scene, make_quad(2.0, 1.6, add_lambert(scene, glm::dvec3(0.5))), {0.0, 0.2, 1.0},
             turn_about_y(std::numbers::pi));
    add_light(scene, Light::Kind::directional, glm::dvec3(10.0), {}, glm::angleAxis(-0.6, glm::dvec3(1.0, 0.0, 0.0)));
    const Stage stage(std::move(scene));
    RayCounts counts;
    const glm::vec3 forth(0.0f, 0.0f, 1.0f);  // from the back wall
    const std::vector<Receiver> places{
        {{-0.9f, -0.9f, -1.0f}, forth}, {{0.9f, 0.9f, -1.0f}, forth}, {{0.0f, -1.0f, 0.9f}, up}};
    const BrightSurfaces surfaces = find_bright(stage, places, counts);
    // Light enters under the window's upper edge, which is .4 m above the floor.
    const double reach = 0.4 / std::tan(0.6);
    double area = 0.0, reflected = 0.0;
    for (const Emitter& patch : surfaces.patches.emitters) {
        const Emitter::Triangle& t = patch.triangles.front();
        EXPECT_GT(t.normal.y, 0.99f);
        EXPECT_NEAR(patch.center.y, -1.0, 1e-5);
        reflected += std::numbers::pi * patch.area * luminance(patch.radiance);
        EXPECT_GT(std::max({t.corner.z, t.corner.z + t.edge1.z, t.corner.z + t.edge2.z}), 1.0 - reach);
        area += patch.area;
    }
    EXPECT_LT(area, 1.5 * 2.0 * reach);  // some are lit in part
    EXPECT_NEAR(reflected, 0.5 * 10.0 * std::sin(0.6) * 2.0 * reach, 0.1 * reflected);
}

TEST(BrightSurfaces, GathersTellTheErrorOfAimedRays) {
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

TEST(BrightSurfaces, GradientsHoldTheLightOfAimedRays) {
    ShadedLamp lamp;
    const auto mean_of = [&](const glm::vec3& position, const glm::vec3& normal, const auto& value) {
        double sum = 0.0;
        for (std::uint32_t run = 0; run < 64; ++run) sum += value(lamp.gather(position, normal, 4096, run));
        return sum / 64.0;
    };
    const auto light = [](const IrradianceSample& sample) { return sample.irradiance.x; };
    // Under the tube, where no edge of it hides its inside from one of the places and not from the other.
    const glm::vec3 here(0.03f, height - 0.5f, 0.0f), step(0.02f, 0.0f, 0.0f);
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
            wall.positions.emplace_back(side * (static_cast<float>(x) - 0.5f * tiles),
                                        side * (static_cast<float>(y) - 0.5f * tiles), 0.0f);
        }
    }
    const auto corner = [](int x, int y) { return static_cast<unsigned>(y * (tiles + 1) + x); };
    for (int y = 0; y < tiles; ++y) {
        for (int x = 0; x < tiles; ++x) {
            wall.triangles.emplace_back(corner(x, y), corner(x + 1, y), corner(x + 1, y + 1));
            wall.triangles.emplace_back(corner(x, y), corner(x + 1, y + 1), corner(x, y + 1));
        }
    }
    add_mesh(scene, wall);
    add_lamp(scene, side, glm::dvec3(100.0), {0.0, 0.0, 0.1}, glm::angleAxis(pi, glm::dvec3(0.0, 1.0, 0.0)));
    return scene;
}

/// Rays that are aimed meet the middle of the wall far more often than the rest. Gathers that share its light must not
/// take that for the light of the whole wall: they share it in cells as wide as what a ray represents.
TEST(BrightSurfaces, SharedLightIsNotThatOfAimedRaysAlone) {
    Gathering gathering(make_lit_spot());
    RayCounts counts;
    const BrightSurfaces surfaces = find_bright(gathering.stage, make_floor_places(-1.0f), counts);
    ASSERT_FALSE(surfaces.empty());
    DirectGrid grid;
    std::vector<DirectSample> found;
    const auto gather = [&](std::uint32_t run, int rays, const DirectGrid* known) {
        const SurfacePoint point = make_point({1.0f + 1e-3f * static_cast<float>(run % 64), 0.0f, 2.0f}, back);
        return gathering.gather(point, {choose_strata(rays), {run, 0, 0, 0}},
                                {.grid = known, .found = known != nullptr ? &found : nullptr, .bright = &surfaces});
    };
    for (std::uint32_t run = 0; run < 512; ++run) {
        gather(run, 128, &grid);
        grid.insert(found);
        found.clear();
    }
    for (const int rays : {128, 2048, 8192}) {
        Mean shared, own;
        for (std::uint32_t run = 0; run < 65536u / static_cast<unsigned>(rays); ++run) {
            shared.add(gather(1000 + run, rays, &grid).irradiance.x);
            own.add(gather(5000 + run, rays, nullptr).irradiance.x);
        }
        EXPECT_NEAR(shared.mean(), own.mean(), 0.03 * own.mean() + 3.0 * own.error()) << rays;
    }
}

/// Samples whose irradiance no record knows aim as well. The noise of single pictures is compared to that of paths,
/// which do not.
TEST(BrightSurfaces, SamplesThatAimAgreeWithThePathTracer) {
    Scene scene = make_shaded_lamp();
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
