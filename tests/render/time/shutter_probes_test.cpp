// Indirect light that changes far away while the shutter is open.

#include "render/time/shutter_probes.h"
#include "render/frame/sequence.h"
#include "render/light/find_sky_openings.h"
#include "tests/support/scenes/window_room.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int width = 32, height = 24;

/// Changes of the light of every second pixel in each direction.
LightChanges find_changes(const Scene& before, const Scene& after) {
    const Stage first(before, width, height), second(after, width, height);
    const SampleHits hits = cast_centers(first.rays, first.view, nullptr);
    std::vector<PixelSurface> places;
    for (const auto [x, y] : all_pixels(width / 2, height / 2))
        places.push_back(make_pixel_surface(first.shading, first.view, hits, 2 * x, 2 * y));
    RayCounts counts;
    LightingContext lighting = first.lighting(), later = second.lighting();
    const std::optional<SkyOpenings> openings = find_sky_openings(later, second.view, hits, counts);
    lighting.openings = later.openings = &openings.value();
    const LightChanges changes = find_light_changes(places, {width, height}, probe_light(lighting, places, counts),
                                                    probe_light(later, places, counts));
    EXPECT_GT(counts.shadow, 1000u);
    return changes;
}

TEST(ShutterProbes, LightThatABlindLetsInIsFoundFarAway) {
    const Scene closed = make_room_with_blind(place_blind(0.0)), open = make_room_with_blind(place_blind(1.3));
    const LightChanges changes = find_changes(closed, open);
    for (const auto [x, y] : all_pixels(width, height)) EXPECT_GT(changes.at(x, y), 0.3f) << x << " " << y;
    EXPECT_EQ(find_changes(open, open).largest(), 0.0f);
}

TEST(ShutterProbes, ABlindThatMovesALittleIsNoChange) {
    const Scene before = make_room_with_blind(place_blind(0.8)), after = make_room_with_blind(place_blind(0.81));
    EXPECT_LT(find_changes(before, after).largest(), 0.05f);
}

TEST(ShutterProbes, WhatIsHiddenAtOneTimeDoesNotCount) {
    const ProbedLight first{1.0f, -1.0f, 2.0f, 3.0f}, second{3.0f, 4.0f, -1.0f, 3.0f}, none;
    EXPECT_EQ(add_light({{&first, 0.5f}, {&second, 0.5f}}), (ProbedLight{2.0f, -1.0f, -1.0f, 3.0f}));
    EXPECT_TRUE(add_light({{&first, 0.5f}, {&none, 0.5f}}).empty());
    const std::vector<PixelSurface> places(4);
    EXPECT_EQ(find_light_changes(places, {4, 4}, first, none).largest(), 0.0f);
    // One of the places that both know changes by 2, one by nothing: that may be chance.
    EXPECT_EQ(find_light_changes(places, {4, 4}, first, second).largest(), 0.0f);
    const ProbedLight brighter{2.0f, 5.0f, 4.0f, 6.0f};
    // 1, 2 and 3 more: their sum, of 12, less two standard errors.
    EXPECT_NEAR(find_light_changes(places, {4, 4}, first, brighter).largest(), (6.0 - 2.0 * std::sqrt(3.0)) / 12.0,
                1e-6);
}

TEST(ShutterProbes, PartsOfThePictureAreInRows) {
    const LightChanges changes{.picture = {16, 8}};
    for (const auto& [x, y, part] : {std::array{0, 0, 0}, {15, 0, 3}, {4, 2, 5}, {3, 1, 0}, {0, 7, 12}, {15, 7, 15}})
        EXPECT_EQ(changes.part(x, y), static_cast<std::size_t>(part)) << x << ' ' << y;
}

/// The blind is closed up to the shutter's centre, and open at its end.
TEST(ShutterProbes, MC27_ARoomThatIsDarkAtTheCenterGetsItsLight) {
    Scene scene = make_room_with_blind(
        Track<glm::dvec3>({0.0, 1.0, 2.0}, {place_blind(0.0), place_blind(0.0), place_blind(1.2)}));
    scene.film.exposure = 1.0;
    scene.film.frame_rate = {.numerator = 1};
    scene.cameras[0].shutter = {-1.0, 1.0};
    const auto find_mean = [&](Integrator integrator, int spp) {
        RenderSettings settings;
        settings.picture = {.width = width / 2, .height = height / 2};
        settings.sampling.spp = spp;
        settings.light.integrator = integrator;
        settings.light.bounces = 3;
        const Image<Rgb> picture = Sequence(scene, settings).render(1).shaded.color;
        float sum = 0.0f;
        for (const Rgb& pixel : picture.pixels) sum += luminance(pixel);
        return sum / static_cast<float>(picture.size());
    };
    const float traced = find_mean(Integrator::path, 256);
    EXPECT_NEAR(find_mean(Integrator::cache, 64), traced, 0.06f * traced);
}

/// Frame 1 of a room whose blind moves while the shutter is open, by direct light alone.
double count_samples(const glm::dvec3& from, const glm::dvec3& to) {
    Scene scene = make_room_with_blind(Track<glm::dvec3>({0.0, 2.0}, {from, to}));
    scene.film.exposure = 100.0;
    scene.film.frame_rate = {.numerator = 1};
    scene.cameras[0].shutter = {-1.0, 1.0};
    RenderSettings settings;
    settings.picture = {.width = width, .height = height};
    follow_error(settings, 1.0);
    settings.light.bounces = 0;
    return static_cast<double>(Sequence(scene, settings).render(1).statistics.counts.samples);
}

/// Half of the window is hidden at the centre.
TEST(ShutterProbes, SamplesGoToTheWholeWindowThatABlindOpens) {
    const double still = count_samples(place_blind(0.6), place_blind(0.61));
    EXPECT_LT(count_samples(place_blind(0.0), place_blind(1.2)), 10.0 * still);
}

}  // namespace
}  // namespace aleph
