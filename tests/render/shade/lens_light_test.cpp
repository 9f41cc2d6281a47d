// Lamps out of focus: their light by few samples, against closed forms and against paths, which have no rays for them.

#include "engine/base/pixel_loops.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int lens_width = 48, lens_height = 36;
constexpr double lens_fov = 0.6;

struct LampOutOfFocus {
    double depth, focus;
    bool ball;
    glm::dvec2 aside{0.0};
};

/// Before, behind and beside the plane that is sharp.
const LampOutOfFocus lamps_out_of_focus[] = {
    {4.0, 1.5, true}, {1.5, 5.0, true, {0.2, 0.1}}, {4.0, 1.5, false, {-0.9, 0.6}}};

constexpr double lamp_radius = 0.03, lens_radius = 0.08;

Scene make_lamp_out_of_focus(const LampOutOfFocus& lamp) {
    Scene scene;
    scene.film.exposure = 1.0;
    scene.environment.radiance.reset();
    const int material = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(500.0));
    Mesh mesh = lamp.ball ? make_faceted_sphere(lamp_radius, 24, material) : make_quad(0.05, 0.04, material);
    add_mesh(scene, std::move(mesh), {lamp.aside.x, lamp.aside.y, -lamp.depth});
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, lens_fov);
    scene.cameras[0].aperture = lens_radius;
    scene.cameras[0].focus_distance = lamp.focus;
    return scene;
}

SampleOptions through_lens(double focus) {
    SampleOptions options;
    options.lens = {lens_radius, focus};
    return options;
}

double sum_of_lens(const Image<Rgb>& picture) {
    double sum = 0.0;
    for (const Rgb& value : picture.pixels) sum += value.x;
    return sum;
}

TEST(LensLight, FewSamplesFindAllOfALampsLight) {
    const double pixels_per_unit = 0.5 * lens_height / std::tan(0.5 * lens_fov);
    for (const LampOutOfFocus& lamp : lamps_out_of_focus) {
        const Stage stage(make_lamp_out_of_focus(lamp), lens_width, lens_height);
        for (const PixelFilter filter : {PixelFilter::box, PixelFilter::blackman_harris}) {
            RenderSettings settings = plain_settings(0.0, 1);
            settings.sampling.spp = 32;
            settings.picture.filter = filter;
            const double found = sum_of_lens(shade(stage, settings, through_lens(lamp.focus)).color);
            // Each point of the lens sees all of the lamp.
            const double circle = 0.5 * 24.0 * std::sin(2.0 * std::numbers::pi / 24.0) * lamp_radius * lamp_radius;
            const double area = lamp.ball ? circle : 0.05 * 0.04;
            const double expected = 500.0 * area * std::pow(pixels_per_unit / lamp.depth, 2.0);
            EXPECT_NEAR(found / expected, 1.0, 0.02) << lamp.depth;
        }
    }
}

TEST(LensLight, WhatHidesALampFromAPartOfTheLensHidesThatPartOfItsDisc) {
    for (const LampOutOfFocus& lamp : {lamps_out_of_focus[0], LampOutOfFocus{1.5, 5.0, true}}) {
        const auto picture = [&](bool hidden) {
            Scene scene = make_lamp_out_of_focus(lamp);
            if (hidden) {
                // A card before the right half of the lens, and a sheet that half of the rays pass.
                add_mesh(scene, make_quad(1.0, 2.0, add_lambert(scene, glm::dvec3(0.0))), {0.5, 0.0, -0.05});
                const int sheet = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
                scene.materials[sheet].opacity.alpha = 0.5;
                scene.materials[sheet].opacity.mode = Opacity::Mode::blend;
                add_mesh(scene, make_quad(9.0, 9.0, sheet), {0.0, 0.0, -0.5});
            }
            SampleOptions options = through_lens(lamp.focus);
            options.blended = hidden;
            RenderSettings settings = plain_settings(0.0, 1);
            settings.sampling.spp = 64;
            return shade(Stage(std::move(scene), lens_width, lens_height), settings, options).color;
        };
        const Image<Rgb> whole = picture(false), part = picture(true);
        glm::dvec2 sides(0.0), sides_of_whole(0.0);
        for (const auto [x, y] : all_pixels(lens_width, lens_height)) {
            sides[x < lens_width / 2 ? 0 : 1] += part(x, y).x;
            sides_of_whole[x < lens_width / 2 ? 0 : 1] += whole(x, y).x;
        }
        // From the left of the lens, a lamp before the plane that is sharp is seen to the right of its middle.
        const int lit = lamp.depth < lamp.focus ? 1 : 0;
        EXPECT_NEAR((sides.x + sides.y) / (sides_of_whole.x + sides_of_whole.y), 0.25, 0.01) << lamp.depth;
        EXPECT_LT(sides[1 - lit], 0.2 * sides[lit]) << "the lamp is as wide as half of its disc";
        EXPECT_NEAR(sides_of_whole.x / sides_of_whole.y, 1.0, 0.03);
    }
}

TEST(LensLight, ASingleSampleShowsThePixelsCentreAlone) {
    const LampOutOfFocus& lamp = lamps_out_of_focus[0];
    const Stage stage(make_lamp_out_of_focus(lamp), lens_width, lens_height);
    const Image<Rgb> by_cache = shade(stage, plain_settings(0.0, 1), through_lens(lamp.focus)).color;
    EXPECT_EQ(by_cache.pixels, shade(stage, path_settings(1, 1), through_lens(lamp.focus)).color.pixels);
}

TEST(LensLight, AnErrorThatIsAskedForTakesFewSamples) {
    Scene scene = make_lamp_out_of_focus(lamps_out_of_focus[0]);
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(0.2));
    RenderSettings settings{.picture = {.width = lens_width, .height = lens_height}};
    follow_error(settings, 1.0);
    const FrameOutput frame = Sequence(std::move(scene), settings).render(0);
    EXPECT_LT(static_cast<double>(frame.shaded.counts.samples), 64.0 * lens_width * lens_height);
    EXPECT_LT(frame.shaded.error_shares.beyond, 0.01);
}

}  // namespace
}  // namespace aleph
