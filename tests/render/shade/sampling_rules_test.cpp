// Pictures with a closed form under every rule that ends the sampling of a pixel, and at an error that is asked for.

#include "render/frame/sequence.h"
#include "tests/support/penumbra.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double frame_rate = 30.0;

RenderSettings make_settings(int width, int height) {
    RenderSettings settings{.picture = {.width = width, .height = height, .filter = PixelFilter::box}};
    settings.cache.light_step = 0;
    settings.light.bounces = 0;
    return settings;
}

RenderSettings settings_of(Sampling rule, int width, int height) {
    RenderSettings settings = make_settings(width, height);
    settings.sampling.rule = rule;
    settings.sampling.spp = rule == Sampling::uniform ? 16 : 32;
    if (rule == Sampling::threshold) settings.error = 1.0;
    return settings;
}

Scene make_scene_seen_along_z(double half_height) {
    Scene scene;
    add_flat_view(scene, half_height);
    return scene;
}

using Truth = std::function<double(int x, int y)>;

/// A frame with several seeds against the truth, in each pixel and in the mean. Each sequence has rendered frame 0
/// before.
void expect_mean(const Scene& scene, RenderSettings settings, const Truth& truth, double darkest_error = 1e-5,
                 std::int64_t frame = 0) {
    constexpr std::uint32_t seeds = 12;
    EXPECT_TRUE(holds([&](Trial& trial) {
        PictureMeans means;
        for (settings.seed = trial.seed; settings.seed < trial.seed + trial.times(seeds); ++settings.seed) {
            Sequence sequence(scene, settings);
            ShadedFrame out = sequence.render(0).shaded;
            if (frame != 0) out = sequence.render(frame).shaded;
            means.add(out.color);
        }
        double truth_sum = 0.0;
        int beyond = 0, pixel = 0;
        for (const auto [x, y] : all_pixels(settings.picture)) {
            const double expected = truth(x, y);
            truth_sum += expected;
            const Mean& found = means.pixels[pixel++];
            // Where few samples met anything, their spread says little.
            const double error = std::max(found.error(), darkest_error * std::sqrt(expected * (1.0 - expected)));
            if (std::abs(found.mean() - expected) > 3.0 * error + 1e-5) ++beyond;
        }
        const double chance = 0.012 * pixel;  // Student's t of 11 degrees of freedom
        trial.at_most(beyond, std::sqrt(chance), chance);
        trial.near(means.all, truth_sum, 1e-4 * truth_sum);
        EXPECT_GT(truth_sum, 1.0);
    }));
}

/// How many pixels of frame 0, rendered to an error of one threshold, differ from the truth by more than it.
int count_beyond_threshold(const Scene& scene, RenderSettings settings, const Truth& truth) {
    follow_error(settings, 1.0);
    const FrameOutput out = Sequence(scene, settings).render(0);
    int beyond = 0;
    for (const auto [x, y] : all_pixels(settings.picture)) {
        const double error = std::abs(luminance(out.shaded.color(x, y)) - truth(x, y));
        if (error * scene.film.viewing.display_white > out.limits.threshold(x, y)) ++beyond;
    }
    return beyond;
}

struct SamplingRules : testing::TestWithParam<Sampling> {};
INSTANTIATE_TEST_SUITE_P(All, SamplingRules,
                         testing::Values(Sampling::uniform, Sampling::consecutive, Sampling::variance,
                                         Sampling::protocol, Sampling::threshold));

TEST_P(SamplingRules, MC17_WithoutLightEveryPixelIsBlackAndStops) {
    Scene scene = make_scene_seen_along_z(1.0);
    scene.environment.radiance.reset();
    add_mesh(scene, make_quad(5.0, 5.0, add_lambert(scene, glm::dvec3(0.5))));
    const FrameOutput out = Sequence(scene, settings_of(GetParam(), 12, 8)).render(0);
    for (const Rgb& color : out.shaded.color.pixels) EXPECT_EQ(color, Rgb(0.0f));
    // By the protocol a pixel takes the most samples where Aleph is 1.
    const float most = GetParam() == Sampling::protocol ? 32.0f : 16.0f;
    for (const float samples : out.shaded.samples.pixels) ASSERT_LE(samples, most);
}

constexpr int floor_width = 48, floor_height = 8;
constexpr double floor_pixel = 0.025;  // m

Scene make_penumbra() {
    Scene scene = Penumbra::make_scene();
    scene.film.exposure = 1.0;
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(Penumbra::albedo))), glm::dvec3(0.0), z_to_up);
    add_camera(scene, {0.0, 0.9, 0.0}, glm::dvec3(0.0));
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 0.5 * floor_height * floor_pixel;
    return scene;
}

double find_penumbra(int x, int y) {
    constexpr int points = 16;
    double sum = 0.0;
    for (int i = 0; i < points; ++i) {
        sum += Penumbra::at((x + (i + 0.5) / points - 0.5 * floor_width) * floor_pixel,
                            (y + 0.5 - 0.5 * floor_height) * floor_pixel) /
               points;
    }
    return sum;
}

TEST_P(SamplingRules, MC22_ThePenumbraOfASquareLamp) {
    expect_mean(make_penumbra(), settings_of(GetParam(), floor_width, floor_height), find_penumbra);
}

TEST(AskedError, MC22_APenumbraIsWithinAThresholdEverywhere) {
    for (std::uint32_t seed = 0; seed < 16; ++seed) {
        RenderSettings settings = make_settings(floor_width, floor_height);
        settings.seed = seed;
        EXPECT_EQ(count_beyond_threshold(make_penumbra(), settings, find_penumbra), 0) << "seed " << seed;
    }
}

constexpr int lit_width = 12, lit_height = 8, lit_points = 1000;
constexpr double lit_pixel = 0.1;  // m

double intensity_of(int light) {
    return light % 7 == 0 ? 4e-3 : 1e-3;
}

/// @param moved  m along x: even lights, and odd ones the other way
glm::dvec3 place_light(int light, double moved = 0.0) {
    return {0.06 * (light % 32) - 0.96 + (light % 2 == 0 ? moved : -moved), 0.06 * (light / 32) - 0.96,
            0.8 + 0.3 * std::sin(1.7 * light)};
}

/// A floor under a thousand lamps without shadows, seen from above.
Scene make_many_lights() {
    Scene scene = make_scene_seen_along_z(0.5 * lit_height * lit_pixel);
    add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.6))));
    for (int i = 0; i < lit_points; ++i) {
        add_light(scene, Light::Kind::point, glm::dvec3(intensity_of(i)), place_light(i));
    }
    return scene;
}

double sum_of_moved_lights(int x, int y, double moved) {
    constexpr int side = 4;
    double sum = 0.0;
    for (int p = 0; p < side * side; ++p) {
        const glm::dvec3 point((x + (p % side + 0.5) / side - 0.5 * lit_width) * lit_pixel,
                               (0.5 * lit_height - y - (p / side + 0.5) / side) * lit_pixel, 0.0);
        for (int i = 0; i < lit_points; ++i) {
            const glm::dvec3 way = place_light(i, moved) - point;
            const double square = glm::dot(way, way);
            sum += 0.6 / pi * intensity_of(i) * way.z / (square * std::sqrt(square)) / (side * side);
        }
    }
    return sum;
}

/// Even lights go to the right by 0.8 m in ten frames, odd ones to the left.
TEST_P(SamplingRules, MC23_AThousandMovingLights) {
    // With an asked error, lights may be left out within its budget: AskedError tests that.
    if (GetParam() == Sampling::threshold) return;
    Scene scene = make_many_lights();
    for (int i = 0; i < lit_points; ++i) {
        scene.nodes[scene.nodes.size() - lit_points + static_cast<std::size_t>(i)].transform.translation =
            Track<glm::dvec3>({0.0, 10.0 / frame_rate}, {place_light(i), place_light(i, 0.8)});
    }
    RenderSettings settings = settings_of(GetParam(), lit_width, lit_height);
    settings.light.light_samples = 4;
    settings.effects.plan = EffectsPlanning::off;  // it leaves lights out, within a share of the threshold (FX-14)
    expect_mean(
        scene, settings, [](int x, int y) { return sum_of_moved_lights(x, y, 0.4); }, 1e-5, 5);
}

TEST(AskedError, MC23_AThousandLightsAreWithinAThreshold) {
    const Scene scene = make_many_lights();
    const auto truth = [](int x, int y) { return sum_of_moved_lights(x, y, 0.0); };
    EXPECT_EQ(count_beyond_threshold(scene, make_settings(lit_width, lit_height), truth), 0);
}

constexpr int shape_width = 24, shape_height = 16;
constexpr double shape_pixel = 0.25;  // m

glm::dvec2 place_in_pixel(int x, int y, int i, int count) {
    const glm::vec2 u = lattice_point(i, count, {0.0f, 0.5f});
    return {(x + u.x - 0.5 * shape_width) * shape_pixel, (0.5 * shape_height - y - u.y) * shape_pixel};
}

TEST_P(SamplingRules, MC27_ATurningSquareWhileTheShutterIsOpen) {
    // 2 m by 1 m; 179 degrees and 1 m to the side.
    const double turn = 179.0 * pi / 180.0;
    Scene scene = make_scene_seen_along_z(0.5 * shape_height * shape_pixel);
    scene.cameras[0].shutter = {-0.5, 0.5};
    const int node = add_mesh(scene, make_quad(2.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0), true)));
    AxisRotation rotation{.axis = {0.0, 0.0, 1.0},
                          .angle = Track<double>({-0.5 / frame_rate, 0.5 / frame_rate}, {0.2, 0.2 + turn})};
    scene.nodes[node].transform.axis_rotation = rotation;
    const Truth truth = [turn](int x, int y) {
        constexpr int times = 4096;
        int inside = 0;
        for (int t = 0; t < times; ++t) {
            const glm::dvec2 p = place_in_pixel(x, y, t, times);
            const double angle = 0.2 + turn * std::fmod((t + 0.5) * 0.41421356237309505, 1.0);
            const double c = std::cos(angle), s = std::sin(angle);
            if (std::abs(c * p.x + s * p.y) < 1.0 && std::abs(c * p.y - s * p.x) < 0.5) ++inside;
        }
        return static_cast<double>(inside) / times;
    };
    expect_mean(scene, settings_of(GetParam(), shape_width, shape_height), truth, 1.0 / std::sqrt(16.0 * 12.0));
}

TEST_P(SamplingRules, MC28_ADiscThroughALens) {
    // 5 m away, the lens focused to 2.5 m: each point covers a disc as large as the lens.
    constexpr double radius = 1.0, lens = 0.7;
    Scene scene = make_scene_seen_along_z(0.5 * shape_height * shape_pixel);
    scene.cameras[0].aperture = lens;
    scene.cameras[0].focus_distance = 2.5;
    add_mesh(scene, make_disc_facing_down(radius, 128, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0), true)),
             glm::dvec3(0.0), z_to_up);
    const Truth truth = [](int x, int y) {
        constexpr int points = 4096;
        int inside = 0;
        for (int i = 0; i < points; ++i) {
            const double r = lens * std::sqrt((i + 0.5) / points), angle = 2.399963229728653 * i;  // golden angle
            const glm::dvec2 p = place_in_pixel(x, y, (i * 1571) % points, points);
            if (glm::length(p + r * glm::dvec2(std::cos(angle), std::sin(angle))) < radius) ++inside;
        }
        return static_cast<double>(inside) / points;
    };
    expect_mean(scene, settings_of(GetParam(), shape_width, shape_height), truth, 1.0 / std::sqrt(16.0 * 12.0));
}

/// Columns from 4 on have enough at 64 samples.
struct ColumnRule final : StoppingRule {
    std::vector<std::uint8_t> find_enough(const StagePixels& pixels) const override {
        std::vector<std::uint8_t> enough;
        for (std::size_t i = 0; i < pixels.x.size(); ++i) {
            EXPECT_EQ(pixels.tolerance[i], pixels.tolerance[0]);
            EXPECT_TRUE(pixels.error[i] >= 0.0f && pixels.deviation[i] >= 0.0f && pixels.y[i] < 6);
            enough.push_back(pixels.x[i] < 4 || pixels.samples[i] >= 64);
        }
        enough.resize(enough.size() + extra);
        return enough;
    }
    std::size_t extra = 0;
};

TEST(SamplingRules, ARuleOfAProgramDecides) {
    ColumnRule own;
    Scene scene = make_scene_seen_along_z(1.0);
    add_mesh(scene, make_quad(5.0, 5.0, add_lambert(scene, glm::dvec3(0.5))));
    RenderSettings settings = settings_of(Sampling::variance, 8, 6);
    settings.sampling.own_rule = &own;
    settings.sampling.spp = 256;
    const Image<float> samples = Sequence(scene, settings).render(0).shaded.samples;
    for (const auto [x, y] : all_pixels(8, 6)) EXPECT_EQ(samples(x, y), x < 4 ? samples(0, 0) : 64.0f);
    EXPECT_LT(samples(0, 0), 64.0f);
    own.extra = 1;
    EXPECT_THROW(Sequence(scene, settings).render(0), InputError);
}

}  // namespace
}  // namespace aleph
