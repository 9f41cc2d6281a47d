// A thin lens against the closed form of its circle of confusion, and at the ends of its range.

#include "engine/base/pixel_loops.h"
#include "render/frame/sequence.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int picture_width = 64, picture_height = 48;

/// A small bright disc before black, on the axis of a camera at the origin.
Scene make_disc_scene(double distance, float radius, bool orthographic = false) {
    Scene scene;
    scene.film.exposure = 1.0;
    add_mesh(scene, make_disc_facing_down(radius, 64, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0), true)),
             {0.0, 0.0, -distance}, z_to_up);
    add_camera(scene, glm::dvec3(0.0), {0.0, 0.0, -1.0}, 0.9);
    scene.cameras[0].orthographic = orthographic;
    scene.cameras[0].half_height = 1.2;
    return scene;
}

ShadedFrame shade_through(const Stage& stage, double aperture, double focus, int spp = 16) {
    SampleOptions options;
    options.lens = {aperture, focus};
    return shade(stage, path_settings(0, spp), options);
}

struct Spot {
    double radius = 0.0;  ///< pixels: that of a uniform disc with the same second moment
    double sum = 0.0;     ///< pixels
};

Spot measure(const Image<float>& coverage) {
    double sum = 0.0, squares = 0.0;
    for (const auto [x, y] : all_pixels(picture_width, picture_height)) {
        const glm::dvec2 from_middle(x + 0.5 - 0.5 * picture_width, y + 0.5 - 0.5 * picture_height);
        sum += coverage(x, y);
        squares += coverage(x, y) * glm::dot(from_middle, from_middle);
    }
    return {std::sqrt(2.0 * squares / sum), sum};
}

TEST(DepthOfField, MC28_TheCircleOfConfusionHasItsClosedForm) {
    const double pixels_per_unit = 0.5 * picture_height / std::tan(0.45);
    for (const auto& [distance, focus] : {std::pair(4.0, 2.0), std::pair(2.0, 3.5)}) {
        const double aperture = 0.8, radius = 3.0 * distance / pixels_per_unit;  // of the disc: 3 pixels
        const Stage stage(make_disc_scene(distance, static_cast<float>(radius)), picture_width, picture_height);
        const Spot spot = measure(shade_through(stage, aperture, focus, 256).coverage);
        // Similar triangles: the lens, seen from the disc, on the plane in focus.
        const double blur = pixels_per_unit * aperture * std::abs(distance - focus) / (distance * focus);
        ASSERT_GT(blur, 3.0);
        // The moments of lens, disc and pixel add up: r^2/2, and 1/12 along each axis for the pixel.
        const double found = std::sqrt(spot.radius * spot.radius - 9.0 - 2.0 * 2.0 / 12.0);
        EXPECT_NEAR(found, blur, 0.01 * blur) << distance;
        // Light that leaves the sharp disc arrives elsewhere.
        const double sharp = measure(shade_through(stage, 0.0, 1.0, 64).coverage).sum;
        EXPECT_NEAR(spot.sum, sharp, 0.03 * sharp);
    }
}

double sum_of_differences(const Image<float>& a, const Image<float>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a.pixels[i] - b.pixels[i]);
    return sum;
}

TEST(DepthOfField, MC28_WhatIsInFocusIsSharpThroughAnyLens) {
    for (const auto& [orthographic, aperture] :
         {std::pair(false, 0.5), std::pair(true, 0.5), std::pair(false, 100.0)}) {
        const Stage stage(make_disc_scene(3.0, 0.7f, orthographic), picture_width, picture_height);
        const ShadedFrame sharp = shade_through(stage, 0.0, 1.0), lens = shade_through(stage, aperture, 3.0);
        EXPECT_LT(sum_of_differences(sharp.coverage, lens.coverage), 1.0);  // single samples at the rim
        EXPECT_GT(measure(sharp.coverage).sum, 100.0);
        for (std::size_t i = 0; i < lens.color.size(); ++i)
            EXPECT_EQ(lens.color.pixels[i].x, lens.coverage.pixels[i]) << aperture;
    }
}

TEST(DepthOfField, MC28_AParallelCameraBlursByTheDistanceFromFocus) {
    const double pixels_per_metre = 0.5 * picture_height / 1.2;
    const Stage stage(make_disc_scene(4.0, static_cast<float>(3.0 / pixels_per_metre), true), picture_width,
                      picture_height);
    const Spot spot = measure(shade_through(stage, 0.4, 2.5, 128).coverage);
    const double blur = pixels_per_metre * 0.4 * 1.5 / 2.5;
    EXPECT_NEAR(std::sqrt(spot.radius * spot.radius - 9.0 - 2.0 * 2.0 / 12.0), blur, 0.015 * blur);
}

TEST(DepthOfField, MC28_FocusAtInfinityKeepsFarThingsSharp) {
    const Stage stage(make_disc_scene(1e4, 3e3f), picture_width, picture_height);
    const Image<float> sharp = shade_through(stage, 0.0, 1.0).coverage;
    for (const double focus : {1e30, 1e300})
        EXPECT_LT(sum_of_differences(sharp, shade_through(stage, 0.05, focus).coverage), 1.0);
}

TEST(DepthOfField, FX12_MC28_ATinyApertureIsAPinhole) {
    Scene scene = make_disc_scene(3.0, 0.7f);
    scene.materials.front().glow.strength = 0.4;  // too dark for bright_edges.h
    const int floor = add_lambert(scene, glm::dvec3(0.5));
    add_mesh(scene, make_quad(20.0, 20.0, floor), {0.0, -1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(4.0), {1.0, 1.0, -1.0});
    const Stage stage(std::move(scene), picture_width, picture_height);
    const ShadedFrame pinhole = shade_through(stage, 0.0, 1.0), lens = shade_through(stage, 1e-9, 2.0);
    int differing = 0;
    for (std::size_t i = 0; i < pinhole.color.size(); ++i) {
        const float a = pinhole.color.pixels[i].x, b = lens.color.pixels[i].x;
        if (std::abs(a - b) > 1e-4f * (a + 1e-3f)) ++differing;
    }
    EXPECT_LE(differing, 4);  // samples at an edge
}

/// Next to the camera, only the middle of the lens sees the disc: nearly none of it.
TEST(DepthOfField, MC28_FocusNextToTheCameraSpreadsTheDiscToNothing) {
    const Stage stage(make_disc_scene(3.0, 0.7f), picture_width, picture_height);
    for (const auto& [aperture, focus] : {std::pair(0.5, 1e-4), std::pair(1e9, 1e-4), std::pair(0.3, 1e-300)}) {
        const ShadedFrame out = shade_through(stage, aperture, focus, 16);
        EXPECT_LT(measure(out.coverage).sum, 1.0) << aperture << " " << focus;
        for (const Rgb& pixel : out.color.pixels) ASSERT_TRUE(pixel.x >= 0.0f && pixel.x <= 1.0f);
        EXPECT_EQ(out.counts.invalid_samples, 0u) << aperture << " " << focus;
    }
}

/// Lens and focus shrink together: on the disc, the lens is as wide as the disc is far. In the middle of the picture,
/// the disc's share of that circle.
TEST(DepthOfField, MC28_ATinyLensInATinyDistanceHasItsCircleOfConfusion) {
    const Stage stage(make_disc_scene(3.0, 0.7f), picture_width, picture_height);
    for (const double size : {1.0, 1e-9, 1e-30}) {
        const ShadedFrame out = shade_through(stage, size, size, 256);
        const double circle = 3.0 * std::abs(1.0 / size - 1.0 / 3.0) * size;
        double sum = 0.0;
        for (int y = picture_height / 2 - 4; y < picture_height / 2 + 4; ++y)
            for (int x = picture_width / 2 - 4; x < picture_width / 2 + 4; ++x) sum += out.color(x, y).x / 64.0;
        const double expected = 0.49 / (circle * circle);
        EXPECT_NEAR(sum, expected, 0.03 * expected) << size;  // 3 standard errors of 16384 samples
    }
}

TEST(DepthOfField, MC28_FocusAtTheCameraIsRefused) {
    RenderSettings settings = path_settings(0, 4);
    set_size(settings, 8, 6);
    for (const double focus : {0.0, -1.0}) {
        Scene scene = make_disc_scene(3.0, 0.7f);
        scene.cameras[0].aperture = 0.1;
        scene.cameras[0].focus_distance = focus;
        EXPECT_THROW(Sequence(scene, settings).render(0), InputError);
        scene.cameras[0].aperture = 0.0;
        EXPECT_NO_THROW(Sequence(scene, settings).render(0));
    }
}

TEST(DepthOfField, ALensThatIsClosedAtTheMiddleOfTheShutterAlone) {
    RenderSettings settings = path_settings(0, 64);
    set_size(settings, picture_width, picture_height);
    Scene scene = make_disc_scene(4.0, 0.4f);
    scene.cameras[0].shutter = {-0.5, 0.5};
    scene.cameras[0].focus_distance = 2.0;
    const auto spot = [&] {
        const ShadedFrame shaded = Sequence(scene, settings).render(0).shaded;
        return measure(map_pixels([](const Rgb& color) { return luminance(color); }, shaded.color));
    };
    scene.cameras[0].aperture = 0.8;
    const Spot open = spot();
    const double frame = scene.film.frame_rate.seconds_of(1);
    scene.cameras[0].aperture = Track<double>({-0.01 * frame, 0.0, 0.01 * frame}, {0.8, 0.0, 0.8});
    EXPECT_NEAR(spot().radius, open.radius, 0.02 * open.radius);
}

}  // namespace
}  // namespace aleph
