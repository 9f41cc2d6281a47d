// Places that mirrors show: a mirror faces a wall behind the camera.

#include "render/cache/bounce_places.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

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
