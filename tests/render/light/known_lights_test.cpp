// Lights that do not reach what the camera sees take few samples, also where there are only two lights.

#include <numbers>

#include "render/frame/sequence.h"
#include "render/light/known_lights.h"
#include "tests/support/path_estimates.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A closed room of 4 x 3 x 5 m with a small lamp, and a box that moves if it is to.
/// @param sun  shines on the room from outside, 100 times as strong as the lamp on the floor
Scene make_closed_room(bool sun, bool moving = false) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_box({4.0, 3.0, 5.0}, grey));
    const int box = add_mesh(scene, make_box(glm::dvec3(0.8), grey), {0.5, -1.1, -1.0});
    if (moving)
        scene.nodes[box].transform.translation = Track<glm::dvec3>({0.0, 1.0}, {{0.5, -1.1, -1.0}, {-0.5, -1.1, -1.0}});
    add_lamp(scene, 0.1, glm::dvec3(50.0), {0.0, 1.2, 0.0});
    if (sun) add_light(scene, Light::Kind::directional, glm::dvec3(10.0), glm::dvec3(0.0), z_to_up);
    add_camera(scene, {-1.2, 0.2, 2.0}, {0.4, -0.6, -1.0});
    return scene;
}

FrameStatistics render_room(const Scene& scene, int light_step = 0) {
    RenderSettings settings;
    settings.picture = {24, 18};
    follow_error(settings, 1.0);
    settings.cache.light_step = light_step;
    return Sequence(scene, settings).render(0).statistics;
}

TEST(KnownLights, MC23_TheSunCostsNothingInAClosedRoom) {
    const FrameCounts lamp = render_room(make_closed_room(false)).counts,
                      both = render_room(make_closed_room(true)).counts;
    EXPECT_LT(both.samples, 1.5 * lamp.samples);
    EXPECT_LT(both.rays.gather, 1.5 * lamp.rays.gather);
    EXPECT_LT(both.rays.shadow, 1.5 * lamp.rays.shadow + 2 * (1 << 14));
}

TEST(KnownLights, MC23_TheSunCostsNothingAtLightingKeyframes) {
    const auto count = [](bool sun) {
        const FrameStatistics statistics = render_room(make_closed_room(sun, true), 4);
        std::uint64_t rays = 0;
        for (const KeyframeStatistics& keyframe : statistics.keyframes) rays += keyframe.counts.rays.gather;
        return rays;
    };
    const std::uint64_t lamp = count(false), both = count(true);
    ASSERT_GT(lamp, 0u);
    EXPECT_LT(both, 1.5 * lamp);
}

/// Under a lid, in a picture that shows nothing else: few of the places lie on it.
TEST(KnownLights, MC23_HiddenLightsHaveAShareOfTheSamplesHoweverLittleIsSeen) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(0.03, 0.03, grey), glm::dvec3(0.0), z_to_up);
    add_mesh(scene, make_quad(0.1, 0.1, grey), {0.0, 0.05, 0.0}, z_to_down);
    add_light(scene, Light::Kind::point, glm::dvec3(0.001), {0.04, 0.02, 0.0});
    add_light(scene, Light::Kind::directional, glm::dvec3(10.0), glm::dvec3(0.0), z_to_up);
    add_camera(scene, {0.0, 0.04, 0.3}, glm::dvec3(0.0));
    const Stage stage(std::move(scene), 120, 90);
    RayCounts counts;
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    const auto shown = std::ranges::count_if(centers.hits.pixels, [](const Hit& hit) { return hit.instance == 0; });
    ASSERT_GT(shown, 0);
    const HiddenLights hidden = find_known_lights(stage.lighting(), stage.view, centers, counts).unseen;
    ASSERT_FALSE(hidden.empty());
    EXPECT_LE(hidden.share, 0.5f);
}

TEST(KnownLights, MC23_SunsAndTheSkyAreHiddenInAClosedRoom) {
    Scene scene = make_closed_room(true);
    add_light(scene, Light::Kind::directional, glm::dvec3(5.0), glm::dvec3(0.0), z_to_up);
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
    const Stage stage(std::move(scene));
    RayCounts counts;
    const KnownLights known =
        find_known_lights(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), counts);
    const std::vector<bool> expected{false, false, false, true, true, true};  // room, box, lamp, suns, sky
    EXPECT_EQ(known.unseen.which, expected);
    EXPECT_EQ(known.unmet.which, expected);
    EXPECT_FLOAT_EQ(known.unseen.share, 2.0f / 32.0f) << "of 1,024 places";
}

TEST(KnownLights, HiddenAtTwoTimesIsWhatIsHiddenAtBoth) {
    const HiddenLights first{0.5f, 1.0f, {true, true, false}}, second{0.5f, 1.0f, {true, false, true}};
    KnownLights known{.openings = {}, .unseen = first, .unmet = first};
    add_known_lights({.openings = {}, .unseen = second, .unmet = {}}, glm::vec3(0.0f), known);
    EXPECT_EQ(known.unseen.which, (std::vector<bool>{true, false, false}));
    EXPECT_TRUE(known.unmet.empty()) << "nothing is hidden at the other time";
}

/// Ways of light from one place, with lights as they are known or by power alone.
struct SpotLight {
    Mean direct, indirect;
};

SpotLight light_spot(const LightingContext& lighting, const ViewedSurface& spot) {
    SpotLight light;
    RayTask task(lighting.rays);
    RandomStream random({7, 0, 0, 0});
    const auto add = [&](Mean& mean, const ScatteredLight& way) {
        const bool arrives = way.radiance != Rgb(0.0f) && !task.tracer.occluded(way.shadow_ray);
        mean.add(arrives ? way.radiance.x : 0.0f);
    };
    for (int i = 0; i < 20'000; ++i) {
        const PixelSequence sequence(static_cast<std::uint32_t>(i), 0, 5, 7);
        light.direct.add(sample_direct_light(lighting, task, LitSurface(spot), {}, sequence, {0, 1}).x);
        add(light.indirect, choose_lambert_light(lighting, spot.point, {random.next(), random.next_2d()}));
    }
    return light;
}

/// The sun comes through a hole of 4 cm in a ceiling, which none of the places sees.
TEST(KnownLights, MC23_ASunThatIsTakenForHiddenKeepsItsLight) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 4.0, grey), glm::dvec3(0.0), z_to_up);
    add_mesh(scene, make_box(glm::dvec3(0.8), grey), {-0.8, 0.4, -0.6});
    for (const double side : {-1.0, 1.0}) {
        add_mesh(scene, make_quad(3.0, 6.0, grey), {side * 1.52, 2.0, 0.0}, z_to_down);
        add_mesh(scene, make_quad(0.04, 3.0, grey), {0.0, 2.0, side * 1.52}, z_to_down);
    }
    add_light(scene, Light::Kind::point, glm::dvec3(0.2), {0.5, 1.0, 0.5});
    add_light(scene, Light::Kind::directional, glm::dvec3(10.0), glm::dvec3(0.0), z_to_up);
    add_camera(scene, {0.0, 1.9, 1.9}, glm::dvec3(0.0), 1.2);
    const Stage stage(std::move(scene), 24, 18);
    RayCounts counts;
    const KnownLights known =
        find_known_lights(stage.lighting(), stage.view, cast_centers(stage.rays, stage.view, nullptr), counts);
    ASSERT_FALSE(known.unseen.empty());
    ASSERT_FALSE(known.unmet.empty());
    const KnownLightTrees trees(stage.shading, stage.lights, known);
    LightingContext lighting = stage.lighting();
    lighting.seen = &trees.seen;
    lighting.met = &trees.met;
    const ViewedSurface spot{make_point(-glm::vec3(stage.shading.anchor), up), make_lambert(0.5f), up};
    const SpotLight by_power = light_spot(stage.lighting(), spot), by_rays = light_spot(lighting, spot);
    const double sun = 10.0 * 0.5 / std::numbers::pi;
    EXPECT_GT(by_rays.direct.mean(), sun);
    EXPECT_NEAR(by_rays.direct.mean(), by_power.direct.mean(), 4.0 * by_rays.direct.error());
    EXPECT_NEAR(by_rays.indirect.mean(), by_power.indirect.mean(), 4.0 * by_rays.indirect.error());
}

}  // namespace
}  // namespace aleph
