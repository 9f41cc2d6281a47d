// The bounds of the effects plan: leaving an effect out changes no pixel by more.

#include "render/plan/effects_plan.h"
#include "tests/support/scenes/planned_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double rounding = 1e-4;  // cd/m2, of 32-bit sums below 100 cd/m2

/// With a threshold map, which plans need to leave out what can be seen a little.
RenderSettings seen_settings() {
    RenderSettings settings = planned_settings();
    settings.perception.guide = Guide::full;
    return settings;
}

RenderSettings force(RenderSettings settings, Effect effect) {
    settings.effects.force = EffectSet(effect);
    return settings;
}

RenderSettings forbid(RenderSettings settings, Effect effect) {
    settings.effects.forbid = EffectSet(effect);
    return settings;
}

Decision decide(const Scene& scene, const RenderSettings& settings, Effect effect, std::int64_t frame = 0) {
    return Sequence(scene, settings).plan(frame).of(effect).decision;
}

struct LeftOut {
    PlannedEffect planned;
    double difference = 0.0;  ///< cd/m2, largest of all pixels
    bool differs = false;
};

/// The difference that forcing the effect makes in frame 0.
LeftOut compare_forced(const Scene& scene, const RenderSettings& settings, Effect effect) {
    const FrameOutput planned = Sequence(scene, settings).render(0);
    const FrameOutput forced = Sequence(scene, force(settings, effect)).render(0);
    return {planned.statistics.plan.of(effect), largest_difference(scene, planned, forced),
            planned.shaded.color.pixels != forced.shaded.color.pixels};
}

/// @param slack  cd/m2, of rounding or noise
void expect_skipped_within_bound(const LeftOut& out, double slack = 0.0) {
    EXPECT_EQ(out.planned.decision, Decision::skip) << out.planned.reason;
    EXPECT_GT(out.planned.bound->luminance, 0.0);
    EXPECT_LE(out.difference, out.planned.bound->luminance + slack);
}

void expect_within_bound(const LeftOut& out, Decision decision) {
    ASSERT_EQ(out.planned.decision, decision) << out.planned.reason;
    ASSERT_TRUE(out.planned.bound);
    EXPECT_GT(out.planned.bound->luminance, 0.0);
    EXPECT_LE(out.planned.bound->thresholds, plan_share);
    EXPECT_TRUE(out.differs) << "nothing was left out";
    EXPECT_LE(out.difference, out.planned.bound->luminance + rounding);
}

/// Point lights in a grid, 40 m behind the camera.
Scene make_far_lights(int count, double power) {
    Scene scene = make_lit_square();
    scene.film.range = FrameRange{0, 0};
    for (int i = 0; i < count; ++i) {
        add_light(scene, Light::Kind::point, glm::dvec3(power), {0.2 * (i % 32), 0.2 * (i / 32), 40.0});
    }
    return scene;
}

TEST(EffectsBounds, FX14_TheSumOfLightsThatAreLeftOutFits) {
    const RenderSettings settings = seen_settings();
    const auto left_out = [&](const Scene& scene) { return Sequence(scene, settings).plan(0).lights_left_out.size(); };
    // Together they are a hundredth of a threshold or less.
    const Scene dim = make_far_lights(1000, 1e-5);
    EXPECT_EQ(left_out(dim), 1000u);
    expect_within_bound(compare_forced(dim, settings, Effect::direct_light), Decision::simplify);
    // Each is below what may be left out, and their sum is not.
    const std::size_t some = left_out(make_far_lights(1000, 1e-2));
    EXPECT_GT(some, 0u);
    EXPECT_LT(some, 1000u);
    expect_within_bound(compare_forced(make_far_lights(1000, 1e-2), settings, Effect::direct_light),
                        Decision::simplify);
    Scene near = make_lit_square();
    add_light(near, Light::Kind::point, glm::dvec3(1.0), {0.0, 0.0, 1.0});
    EXPECT_EQ(left_out(near), 0u);
}

TEST(EffectsBounds, FX14_LampsThatAreLeftOutAreStillSeen) {
    Scene scene = make_lit_square();
    scene.film.range = FrameRange{0, 0};
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.5));
    add_mesh(scene, make_quad(1.0, 1.0, lamp), {0.0, 0.0, 40.0}, z_to_up * z_to_up);
    const EffectsPlan plan = Sequence(scene, seen_settings()).plan(0);
    ASSERT_EQ(plan.lights_left_out.size(), 1u);
    EXPECT_EQ(plan.lights_left_out[0].kind, LightFacts::Kind::surface);
    EXPECT_FALSE(plan.skips(Effect::emission));
    expect_within_bound(compare_forced(scene, seen_settings(), Effect::direct_light), Decision::simplify);
}

TEST(EffectsBounds, LampsAreSampledWhereWideLobesReflectThem) {
    const auto left_out = [](const Material& material) {
        Scene scene = make_lit_square();
        scene.film.range = FrameRange{0, 0};
        scene.materials[scene.meshes[0].material] = material;
        const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(50.0));
        add_mesh(scene, make_quad(0.1, 0.1, lamp), {1.0, 0.0, 3.0}, z_to_up * z_to_up);
        return Sequence(scene, seen_settings()).plan(0).lights_left_out.size();
    };
    EXPECT_EQ(left_out({.gloss = {.metallic = 1.0, .roughness = 0.3}}), 0u);
    EXPECT_EQ(left_out({.gloss = {.metallic = 1.0, .roughness = 0.0}}), 1u) << "a mirror meets it by itself";
    EXPECT_EQ(left_out({.gloss = {.metallic = 0.0, .roughness = 0.3}, .glass = {.transmission = 1.0}}), 0u);
    EXPECT_EQ(left_out({.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}}), 1u);
}

/// Two walls that face each other, lit by a lamp in front of the camera; one is seen.
Scene make_corridor(double albedo) {
    Scene scene = make_empty_view();
    scene.film.range = FrameRange{0, 0};
    const int wall = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(2.0, 2.0, wall));
    add_mesh(scene, make_quad(2.0, 2.0, wall), {0.0, 0.0, 4.0});
    add_light(scene, Light::Kind::point, glm::dvec3(40.0), {0.0, 3.0, 2.0});
    return scene;
}

TEST(EffectsBounds, FX16_ASecondBounceBetweenDarkWalls) {
    RenderSettings settings = seen_settings();
    settings.light.bounces = 2;
    expect_within_bound(compare_forced(make_corridor(0.05), settings, Effect::more_bounces), Decision::skip);
    EXPECT_EQ(decide(make_corridor(0.9), settings, Effect::more_bounces), Decision::simulate);
    // The bound holds where it is not small enough either.
    RenderSettings one = settings;
    one.light.bounces = 1;
    for (const double albedo : {0.05, 0.5, 0.9}) {
        const Scene scene = make_corridor(albedo);
        const FrameOutput with = Sequence(scene, force(settings, Effect::more_bounces)).render(0);
        const FrameOutput without = Sequence(scene, one).render(0);
        const std::optional<EffectBound> bound = without.statistics.plan.of(Effect::more_bounces).bound;
        ASSERT_TRUE(bound) << albedo;
        const double difference = largest_difference(scene, with, without);
        EXPECT_GT(difference, 0.0);
        EXPECT_LE(difference, bound->luminance) << albedo;
        const FrameOutput forbidden = Sequence(scene, forbid(settings, Effect::more_bounces)).render(0);
        EXPECT_EQ(largest_difference(scene, forbidden, without), 0.0);
    }
}

TEST(EffectsBounds, FX13_AFarSmallBodySendsHardlyAnyLight) {
    Scene scene = make_lit_square();
    scene.film.range = FrameRange{0, 0};
    add_mesh(scene, make_faceted_sphere(0.01, 8, 0), {3.0, 0.0, 30.0});
    RenderSettings settings = seen_settings();
    settings.cache.gather = 4096;
    expect_skipped_within_bound(compare_forced(scene, settings, Effect::indirect_diffuse));
}

TEST(EffectsBounds, FX13_AMirrorOutOfViewThatLightsWhatIsInView) {
    Scene scene = make_lit_square();
    scene.nodes.back().transform.translation = glm::dvec3(0.0, 4.0, 0.5);
    scene.materials.push_back({.gloss = {.metallic = 1.0, .roughness = 0.0}});
    add_mesh(scene, make_quad(3.0, 3.0, 1), {4.0, 0.0, 1.0},
             glm::angleAxis(-0.5 * std::numbers::pi, glm::dvec3(0.0, 1.0, 0.0)));
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(40.0));
    add_mesh(scene, make_quad(2.0, 2.0, lamp), {-2.0, 0.0, 4.5},
             glm::angleAxis(0.5 * std::numbers::pi, glm::dvec3(0.0, 1.0, 0.0)));
    RenderSettings settings = seen_settings();
    settings.cache.gather = 1024;
    const EffectsPlan plan = Sequence(scene, settings).plan(0);
    EXPECT_EQ(plan.of(Effect::caustics).decision, Decision::simulate);
    EXPECT_EQ(plan.of(Effect::mirror_reflection).decision, Decision::skip);
    const FrameOutput lit = Sequence(scene, settings).render(0);
    const FrameOutput unlit = Sequence(scene, forbid(settings, Effect::caustics)).render(0);
    EXPECT_GT(largest_difference(scene, lit, unlit), 0.1);
}

TEST(EffectsBounds, FX13_GlossThatHardlyReflects) {
    Scene scene = make_lit_square();
    scene.film.range = FrameRange{0, 0};
    scene.materials[0].gloss.specular = 1e-4;
    scene.materials[0].gloss.roughness = 0.7;
    expect_within_bound(compare_forced(scene, seen_settings(), Effect::glossy_reflection), Decision::skip);
    scene.materials[0].gloss.specular = 1.0;
    EXPECT_EQ(decide(scene, seen_settings(), Effect::glossy_reflection), Decision::simulate);
}

/// A value at the middle of frame 0, and another at its ends; the shutter is open for all of it.
template <class T>
Track<T> swing(Scene& scene, const T& middle, const T& ends) {
    scene.cameras[0].shutter = {-0.5, 0.5};
    const double half = 0.5 * scene.film.frame_rate.seconds_of(1);
    return Track<T>({-half, 0.0, half}, {ends, middle, ends});
}

/// The camera turns by this angle while the shutter is open.
Scene make_turning_view(double degrees) {
    Scene scene = make_lit_square();
    const double angle = degrees * std::numbers::pi / 180.0;
    scene.cameras[0].shutter = {-0.5, 0.5};
    const double frame = scene.film.frame_rate.seconds_of(1);
    scene.nodes[0].transform.rotation =
        Track<glm::dquat>({-0.5 * frame, 0.5 * frame}, {glm::angleAxis(-0.5 * angle, glm::dvec3(0.0, 1.0, 0.0)),
                                                        glm::angleAxis(0.5 * angle, glm::dvec3(0.0, 1.0, 0.0))});
    return scene;
}

TEST(EffectsBounds, FX15_AShutterInWhichThePictureHardlyMoves) {
    RenderSettings settings = seen_settings();
    settings.picture.filter = PixelFilter::blackman_harris;
    settings.sampling.spp = 1024;
    constexpr double noise = 0.05;  // of samples at edges
    expect_skipped_within_bound(compare_forced(make_turning_view(0.05), settings, Effect::motion_blur), noise);
    EXPECT_EQ(decide(make_turning_view(3.0), settings, Effect::motion_blur), Decision::simulate);
}

TEST(EffectsBounds, FX15_AParallelViewThatHardlyMoves) {
    RenderSettings settings = seen_settings();
    settings.picture.filter = PixelFilter::blackman_harris;
    settings.sampling.spp = 256;
    Scene turning = make_turning_view(1e-3);
    turning.cameras[0].orthographic = true;
    add_mesh(turning, make_quad(1.0, 9.0, add_lambert(turning, glm::dvec3(0.0), glm::dvec3(1.0))), {0.7, 0.0, -1e5});
    EXPECT_EQ(decide(turning, settings, Effect::motion_blur), Decision::simulate) << "1.7 m at a distance of 1e5 m";
    Scene shifting = make_lit_square();
    shifting.cameras[0].orthographic = true;
    shifting.nodes[0].transform.translation = swing(shifting, glm::dvec3(0.0, 0.0, 3.0), glm::dvec3(2e-4, 0.0, 3.0));
    expect_skipped_within_bound(compare_forced(shifting, settings, Effect::motion_blur), 0.05);
}

TEST(EffectsBounds, FX15_WhatChangesWhileTheShutterIsOpen) {
    const auto decision = [](const Scene& scene, std::int64_t frame = 0) {
        return decide(scene, seen_settings(), Effect::motion_blur, frame);
    };
    Scene scene = make_lit_square();
    scene.cameras[0].shutter = {0.0, 0.8};
    EXPECT_EQ(decision(scene), Decision::skip) << "nothing moves";
    const double frame = scene.film.frame_rate.seconds_of(1);
    Scene door = scene;
    const int node = add_mesh(door, make_quad(9.0, 9.0, add_lambert(door, glm::dvec3(0.0))), {0.0, 0.0, 9.0});
    door.nodes[node].visible = Track<double>({0.0, 0.3 * frame}, {1.0, 0.0}, Interpolation::step);
    EXPECT_EQ(decision(door), Decision::simulate) << "a door out of view opens";
    EXPECT_EQ(decision(door, 1), Decision::skip) << "it is open";
    Scene lamp = scene;
    lamp.nodes.back().transform.translation =
        Track<glm::dvec3>({0.0, frame}, {glm::dvec3(0.3, 0.2, 2.0), glm::dvec3(-0.3, 0.2, 2.0)});
    EXPECT_EQ(decision(lamp), Decision::simulate) << "a lamp moves, and no object does";
    Scene glow = scene;
    glow.materials[0].glow.color = Track<glm::dvec3>({0.0, frame}, {glm::dvec3(0.0), glm::dvec3(1.0)});
    EXPECT_EQ(decision(glow), Decision::simulate);
    Scene entering = scene;
    entering.nodes[add_mesh(entering, make_quad(0.5, 0.5, 0), {9.0, 0.0, 0.0})].transform.translation =
        Track<glm::dvec3>({0.0, frame}, {glm::dvec3(9.0, 0.0, 0.0), glm::dvec3(0.0)});
    EXPECT_EQ(decision(entering), Decision::simulate) << "an object enters";
}

TEST(EffectsBounds, FX02_FX03_LightAtTheMiddleOfTheShutterBoundsNone) {
    Scene scene = make_lit_square();
    add_mesh(scene, make_quad(1.0, 1.0, 0), {0.0, -0.5, 0.5}, z_to_up);
    scene.nodes[2].visible = 0.0;
    const int shining = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(4.0));
    const int lamp = add_mesh(scene, make_quad(0.5, 0.5, shining), {0.0, 0.5, 0.5});
    RenderSettings settings = seen_settings();
    settings.light.bounces = 2;
    scene.nodes[lamp].transform.scale = glm::dvec3(0.0);
    EXPECT_EQ(decide(scene, settings, Effect::indirect_diffuse), Decision::skip) << "a lamp without area";
    scene.nodes[lamp].transform.scale = swing(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    EXPECT_EQ(decide(scene, settings, Effect::indirect_diffuse), Decision::simulate) << "it grows";
    EXPECT_EQ(decide(scene, settings, Effect::more_bounces), Decision::simulate);

    Scene gloss = make_lit_square();
    gloss.meshes[0].material = add_material(gloss, 1.0, 0.6);
    gloss.lights[0].intensity = 1e-12;
    EXPECT_EQ(decide(gloss, settings, Effect::glossy_reflection), Decision::skip) << "a dim light";
    gloss.lights[0].intensity = swing(gloss, 1e-12, 3.0);
    EXPECT_EQ(decide(gloss, settings, Effect::glossy_reflection), Decision::simulate) << "it brightens";
}

TEST(EffectsBounds, FX12_AnApertureWhileTheShutterIsOpen) {
    RenderSettings settings = seen_settings();
    settings.picture.filter = PixelFilter::blackman_harris;
    Scene scene = make_lit_square();
    scene.cameras[0].aperture = swing(scene, 0.0, 0.1);
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::simulate) << "it is 0 at the middle alone";
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field, 2), Decision::simulate);
    scene.cameras[0].aperture = swing(scene, 0.0, 0.0);
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::skip);
    scene.cameras[0].aperture = 3e-4;
    scene.cameras[0].focus_distance = 3.0;
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::skip);
    const int near = add_mesh(scene, make_quad(0.01, 0.01, 0), {0.0, 0.0, 2.99});
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::simulate) << "something is near";
    scene.nodes[near].visible = swing(scene, 0.0, 1.0);
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::simulate) << "it comes and goes";
}

TEST(EffectsBounds, FX12_AnApertureThatHardlyBlurs) {
    Scene scene = make_lit_square();
    scene.cameras[0].aperture = 1e-9;
    RenderSettings settings = seen_settings();
    settings.picture.filter = PixelFilter::blackman_harris;
    settings.sampling.spp = 256;
    expect_skipped_within_bound(compare_forced(scene, settings, Effect::depth_of_field), 1e-3);
    scene.cameras[0].aperture = 0.1;
    EXPECT_EQ(decide(scene, settings, Effect::depth_of_field), Decision::simulate);
}

}  // namespace
}  // namespace aleph
