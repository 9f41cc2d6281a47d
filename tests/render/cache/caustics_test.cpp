// Light that mirrors send to diffuse surfaces, against a closed form, and places that mirrors show.

#include "render/cache/bounce_places.h"
#include "render/cache/gather.h"
#include "render/settings/settings.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/lobes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr double ball_radius = 0.25, lamp_side = 0.3, lamp_height = 20.0, lamp_radiance = 1e4;

/// A perfect mirror ball at the origin, far below a small lamp. From 1.5 m the lamp's image has 2e-6 sr.
Scene make_ball_below_lamp() {
    Scene scene;
    scene.materials.push_back({.base_color = glm::dvec3(1.0), .gloss = {.metallic = 1.0, .roughness = 0.0}});
    const Shape ball{.kind = Shape::Kind::sphere, .radius = ball_radius, .segments = 256};
    add_mesh(scene, make_shape_mesh(ball, 0));
    add_lamp(scene, lamp_side, glm::dvec3(lamp_radiance), {0.0, lamp_height, 0.0});
    return scene;
}

/// A convex mirror spreads a beam of irradiance E by its focal lengths f_t and f_s (Coddington): at the distance s from
/// it arrives E f_t f_s / ((s + f_t) (s + f_s)).
TEST(Caustics, BlurredLightOfAMirrorBallIsThatOfAMirrorBall) {
    Gathering ball(make_ball_below_lamp());
    ball.stage.shading.caustic_width = find_caustic_width(RenderSettings{});
    const double distance = 1.5;
    for (const double incidence : {0.3, 0.6, 0.9}) {
        const double to_lamp = lamp_height - ball_radius * std::cos(incidence);
        const double beam = lamp_radiance * lamp_side * lamp_side / (to_lamp * to_lamp);
        const double tangential = 0.5 * ball_radius * std::cos(incidence);
        const double sagittal = 0.5 * ball_radius / std::cos(incidence);
        const double expected = beam * tangential * sagittal / ((distance + tangential) * (distance + sagittal));
        const glm::dvec3 normal(std::sin(incidence), std::cos(incidence), 0.0);
        const glm::dvec3 away(std::sin(2.0 * incidence), std::cos(2.0 * incidence), 0.0);
        const glm::dvec3 at = ball_radius * normal + distance * away - ball.stage.shading.anchor;
        EXPECT_TRUE(holds([&](Trial& trial) {
            Mean mean;
            for (std::uint32_t run = 0; run < trial.times(1024u); ++run) {
                const GatherPattern pattern{choose_strata(1024), {run + trial.seed, 0, 0, 0}};
                mean.add(ball.gather(make_point(at, -away), pattern, {.depth = 4}).irradiance.x);
            }
            EXPECT_LT(mean.error(), 0.03 * expected) << incidence;  // without the blur hardly a ray finds the lamp
            trial.near(mean, expected, 0.05 * expected);
        }));
    }
}

/// One ray of some hundreds finds the lamp by way of the ball: a record that has it is no blotch.
TEST(Caustics, LightThatFewRaysFindIsSpreadWhereAnErrorIsAsked) {
    const auto find_light = [](double error, int rays) {
        Scene scene = make_ball_below_lamp();
        const int grey = add_lambert(scene, glm::dvec3(0.5));
        add_mesh(scene, make_quad(8.0, 8.0, grey), {6.0, 3.0, 0.0}, turn_about_y(-pi / 2));
        // Even light on the wall, from another one that is far away and large.
        add_mesh(scene, make_quad(200.0, 200.0, grey), {-20.0, 0.6, 0.0}, turn_about_y(pi / 2));
        add_light(scene, Light::Kind::directional, glm::dvec3(0.03), glm::dvec3(0.0),
                  glm::quatLookAt(glm::dvec3(-1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0)));
        add_camera(scene, {1.0, 3.0, 0.0}, {6.0, 3.0, 0.0});
        IndirectStage stage(std::move(scene), 64, 48, 0.01, rays);
        stage.stage.shading.caustic_width = find_caustic_width(RenderSettings{});
        stage.settings.error = error;
        IrradianceCache cache = stage.fill().cache;
        cache.finish();
        Mean mean;
        for (const IrradianceRecord& record : cache.records()) mean.add(record.irradiance.x);
        return mean;
    };
    const Mean blotched = find_light(0.0, 256), even = find_light(1.0, 256);
    EXPECT_LT(even.error(), 0.6 * blotched.error());  // the rest is noise of other rays
    EXPECT_NEAR(even.mean(), blotched.mean(), 3.0 * blotched.error());
    // A gather of few rays has no rare light.
    EXPECT_EQ(find_light(1.0, 32).error(), find_light(0.0, 32).error());
}

TEST(Caustics, LobesAreWidenedWhereLightDoesNotPassStraight) {
    Stage stage(make_ball_below_lamp());
    stage.shading.caustic_width = 0.15f;
    SurfaceMaterial mirror = make_metal(0.0f), rough = make_metal(0.4f), sheet{.gloss{.f90 = 1.0f, .alpha = 0.0f}};
    sheet.glass.share = 1.0f;
    sheet.coat = {.strength = 1.0f, .alpha = 0.01f};
    SurfaceMaterial volume = sheet;
    volume.glass.volume = true;
    const auto blur = [&](SurfaceMaterial& material) {
        ViewedSurface surface = make_viewed(material, {0.0f, 0.0f, 1.0f});
        blur_caustics(stage.shading, surface);
        material = surface.material;
    };
    for (SurfaceMaterial* material : {&mirror, &rough, &sheet, &volume}) blur(*material);
    EXPECT_EQ(mirror.gloss.alpha, 0.15f);
    EXPECT_EQ(rough.gloss.alpha, 0.4f);
    EXPECT_EQ(volume.gloss.alpha, 0.15f);
    EXPECT_TRUE(sheet.passes_straight());
    EXPECT_EQ(sheet.coat.alpha, 0.15f);
    stage.shading.skipped.add(Effect::caustics);
    blur(mirror);
    EXPECT_FALSE(mirror.has_specular());
}

/// Without a correction a dielectric seen at a grazing angle reflects about half as much.
TEST(Caustics, WidenedLobesReflectAsMuchAsBefore) {
    Stage stage(make_ball_below_lamp());
    stage.shading.caustic_width = find_caustic_width(RenderSettings{});
    for (const float alpha : {0.01f, 0.05f, 0.1f}) {
        for (const auto& [cosine, metallic] : {std::pair{0.05f, true},
                                               {0.2f, true},
                                               {0.5f, true},
                                               {1.0f, true},
                                               {0.1f, false},
                                               {0.4f, false},
                                               {1.0f, false}}) {
            SurfaceMaterial material = metallic ? make_metal(alpha) : make_white_plastic(alpha);
            if (!metallic) material.diffuse = Rgb(0.0f);
            const ViewedSurface narrow = make_viewed(material, direction_of(cosine));
            ViewedSurface wide = narrow;
            blur_caustics(stage.shading, wide);
            ASSERT_GT(wide.material.gloss.alpha, alpha);
            EXPECT_TRUE(holds([&](Trial& trial) {
                const int count = trial.times(20000);
                const Mean before = mean_scattered(LitSurface(narrow), count, trial.seed);
                const Mean after = mean_scattered(LitSurface(wide), count, trial.seed + 7);
                trial.near(after, before.mean(), 0.012);
            })) << alpha
                << ' ' << cosine;
        }
    }
}

/// Wide microfacets would let out the light that is to stay in the glass.
TEST(Caustics, GlassSeenFromInsideReflectsAllBeyondTheCriticalAngle) {
    Stage stage(make_ball_below_lamp());
    stage.shading.caustic_width = 0.15f;
    SurfaceMaterial wall = make_glass(0.0f, 1.5f, true);
    wall.glass.ior_ratio = 1.0f / 1.5f;
    const float critical = std::asin(wall.glass.ior_ratio);
    const auto width_at = [&](float angle) {
        ViewedSurface surface = make_viewed(wall, direction_of(std::cos(angle)));
        blur_caustics(stage.shading, surface);
        return surface.material.gloss.alpha;
    };
    EXPECT_EQ(width_at(0.05f), 0.15f);
    EXPECT_EQ(width_at(critical - 0.31f), 0.15f);
    for (const float angle : {critical - 0.29f, critical + 0.01f, 1.5f}) EXPECT_EQ(width_at(angle), 0.0f) << angle;
}

TEST(Caustics, PathsAndForcedCausticsAreNotBlurred) {
    RenderSettings paths, forced, off;
    paths.light.integrator = Integrator::path;
    forced.effects.force.add(Effect::caustics);
    off.effects.plan = EffectsPlanning::off;
    EXPECT_GT(find_caustic_width(RenderSettings{}), 0.0f);
    for (const RenderSettings* exact : {&paths, &forced, &off}) EXPECT_EQ(find_caustic_width(*exact), 0.0f);
}

constexpr int width = 16, height = 12;

struct Mirror {
    double reflectance = 0.36, roughness = 0.25, anisotropy = 0.0;
    float accuracy = 0.1f;
    int path_depth = 4;
    const CarriedLight* carried = nullptr;

    /// The camera is 4 m before the mirror and 3 m before the wall.
    Scene make_scene() const {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.5));
        scene.materials.push_back({.base_color = glm::dvec3(reflectance),
                                   .gloss = {.metallic = 1.0, .roughness = roughness},
                                   .layers = {.anisotropy = anisotropy}});
        add_mesh(scene, make_quad(40.0, 40.0, 1), {0.0, 0.0, -4.0});
        add_mesh(scene, make_quad(400.0, 400.0, white), {0.0, 0.0, 3.0}, turn_about_y(std::numbers::pi));
        add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0});
        return scene;
    }

    void expect(const std::function<void(const Stage&, const MirrorPlaces&, const RayCounts&)>& check) const {
        IndirectStage room(make_scene(), width, height, accuracy);
        room.settings.light.path_depth = path_depth;
        room.context.carried = carried;
        RayCounts counts;
        check(room.stage, cast_mirror_places(room.context, room.centers, counts), counts);
    }

    /// Checks that places are found, and their accuracy in the middle of the picture.
    void expect_accuracy(double expected) const {
        expect([&](const Stage&, const MirrorPlaces& found, const RayCounts&) {
            EXPECT_EQ(found.any, expected > 0.0);
            EXPECT_EQ(found.places.hits(width / 2, height / 2).instance != no_index, expected > 0.0);
            if (expected > 0.0) {
                EXPECT_NEAR(found.accuracy(width / 2, height / 2), expected, 1e-3 * expected);
            }
        });
    }
};

TEST(MirrorPlaces, PathsArriveAtTheWall) {
    Mirror().expect([](const Stage& stage, const MirrorPlaces& found, const RayCounts& counts) {
        EXPECT_TRUE(found.any);
        EXPECT_EQ(counts.specular, static_cast<std::uint64_t>(width * height));
        EXPECT_NEAR(found.places.solid_angle, std::pow(stage.view.pixels_per_unit, -2.0), 1e-9);
        for (const auto [x, y] : all_pixels(width, height)) {
            const glm::dvec3 ray = make_camera_ray(stage.view, x + 0.5, y + 0.5).direction;
            expect_near(found.places.directions(x, y), {ray.x, ray.y, -ray.z}, 1e-6);
            const double distance = 11.0 / std::abs(ray.z);
            ASSERT_EQ(found.places.hits(x, y).instance, 1);
            EXPECT_NEAR(found.places.hits(x, y).distance, distance, 1e-5 * distance);
        }
    });
}

TEST(MirrorPlaces, LobesUpToARoughnessOfAQuarterAreMirrors) {
    Mirror{.roughness = 0.0}.expect_accuracy(0.1 / 0.6);
    Mirror{.roughness = 0.25}.expect_accuracy(0.1 / 0.6);
    Mirror{.roughness = 0.26}.expect_accuracy(0.0);
    Mirror{.roughness = 0.25, .anisotropy = 0.5}.expect_accuracy(0.0);
}

TEST(MirrorPlaces, AccuracyFollowsTheShareOfLight) {
    Mirror{.reflectance = 1.0}.expect_accuracy(0.1);
    Mirror{.reflectance = 0.11}.expect_accuracy(0.1 / std::sqrt(0.11));
    Mirror{.reflectance = 0.09}.expect_accuracy(0.0);  // less than a tenth
    Mirror{.accuracy = 0.4f}.expect_accuracy(0.5);     // the loosest
    Mirror{.accuracy = 0.7f}.expect_accuracy(0.7);     // but where the pixel's own is looser
}

TEST(MirrorPlaces, TurnsEndWithThePath) {
    Mirror{.path_depth = 3}.expect_accuracy(0.1 / 0.6);
    Mirror{.path_depth = 2}.expect_accuracy(0.0);
}

TEST(MirrorPlaces, GlassIsLookedThrough) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5));
    scene.materials.push_back({.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}});
    add_mesh(scene, make_quad(40.0, 40.0, 1), {0.0, 0.0, -4.0});
    add_mesh(scene, make_quad(400.0, 400.0, white), {0.0, 0.0, -9.0});
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0});
    const IndirectStage room(std::move(scene), width, height, 0.1);
    RayCounts counts;
    const MirrorPlaces found = cast_mirror_places(room.context, room.centers, counts);
    for (const auto [x, y] : all_pixels(width, height)) {
        const glm::dvec3 ray = make_camera_ray(room.stage.view, x + 0.5, y + 0.5).direction;
        ASSERT_EQ(found.places.hits(x, y).instance, 1);
        expect_near(found.places.directions(x, y), ray, 1e-6);
        EXPECT_NEAR(found.places.hits(x, y).distance, 9.0 / std::abs(ray.z), 1e-4);
    }
}

/// Knows all light up to some accuracy.
struct Known : CarriedLight {
    float finest = 0.0f;
    std::optional<Rgb> find(const PixelSurface&, float accuracy, RayTask&, RecordUse*) const override {
        return accuracy >= finest ? std::optional<Rgb>(Rgb(1.0f)) : std::nullopt;
    }
};

TEST(MirrorPlaces, WhatIsKnownIsLeftOut) {
    Known known;
    known.finest = 0.15f;
    Mirror{.carried = &known}.expect_accuracy(0.0);
    known.finest = 0.2f;
    Mirror{.carried = &known}.expect_accuracy(0.1 / 0.6);
}

}  // namespace
}  // namespace aleph
