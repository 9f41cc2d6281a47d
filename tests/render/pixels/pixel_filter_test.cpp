// The default pixel filter against its window: places, a step, a point, and the border of the picture.

#include "render/pixels/pixel_surfaces.h"
#include "tests/support/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// The four-term Blackman-Harris window (Harris 1978) over 3 pixels, not normalized.
double window(double x) {
    if (std::abs(x) >= 1.5) return 0.0;
    const double turn = 2.0 * std::numbers::pi * x / 3.0;  // 0 in the middle
    return 0.35875 + 0.48829 * std::cos(turn) + 0.14128 * std::cos(2.0 * turn) + 0.01168 * std::cos(3.0 * turn);
}

/// Share of the filter left of x, by the midpoint rule.
double share_left_of(double x) {
    constexpr int steps = 60'000;
    double left = 0.0, all = 0.0;
    for (int i = 0; i < steps; ++i) {
        const double at = -1.5 + 3.0 * (i + 0.5) / steps;
        all += window(at);
        if (at < x) left += window(at);
    }
    return left / all;
}

TEST(PixelFilterTest, PlacesAreDistributedLikeTheWindow) {
    double last = -1.5;
    for (int i = 1; i < 100; ++i) {
        const double u = i / 100.0, place = place_in_filter(PixelFilter::blackman_harris, u);
        EXPECT_NEAR(share_left_of(place), u, 1e-4) << u;
        EXPECT_NEAR(place, -place_in_filter(PixelFilter::blackman_harris, 1.0 - u), 1e-9);
        EXPECT_GT(place, last);
        last = place;
    }
    EXPECT_EQ(place_in_filter(PixelFilter::blackman_harris, 0.0), -1.5);
    EXPECT_EQ(place_in_filter(PixelFilter::blackman_harris, 1.0), 1.5);
}

TEST(PixelFilterTest, TheBoxIsUniform) {
    for (const double u : {0.0, 0.25, 0.5, 0.999}) EXPECT_EQ(place_in_filter(PixelFilter::box, u), u - 0.5);
}

/// A flat, parallel view of 16 x 12 pixels of 1 m, whose rows and columns begin at the origin.
Scene make_flat_view(double left, double right, double bottom, double top) {
    Scene scene;
    add_mesh(scene, make_quad(right - left, top - bottom, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))),
             {0.5 * (left + right), 0.5 * (bottom + top), 0.0});
    add_camera(scene, {8.0, 6.0, 5.0}, {8.0, 6.0, 0.0});
    scene.cameras[0].orthographic = true;
    scene.cameras[0].half_height = 6.0;
    return scene;
}

Image<Rgb> render_flat(Scene scene, PixelFilter filter) {
    const Stage stage(std::move(scene), 16, 12);
    RenderSettings settings = path_settings(0, 4096);
    settings.picture.filter = filter;
    return shade(stage, settings).color;
}

TEST(PixelFilterTest, AStepIsTheIntegralOfTheFilter) {
    for (const double edge : {8.0, 8.3}) {
        const Image<Rgb> picture = render_flat(make_flat_view(-10.0, edge, -10.0, 30.0), PixelFilter::blackman_harris);
        const Image<Rgb> boxes = render_flat(make_flat_view(-10.0, edge, -10.0, 30.0), PixelFilter::box);
        for (int x = 0; x < 16; ++x) {
            EXPECT_NEAR(picture(x, 5).x, share_left_of(edge - (x + 0.5)), 2e-3) << edge << ' ' << x;
            EXPECT_NEAR(boxes(x, 5).x, std::clamp(edge - x, 0.0, 1.0), 2e-3) << edge << ' ' << x;
        }
    }
}

TEST(PixelFilterTest, APointIsTheFilter) {
    constexpr double half = 0.05;
    const Image<Rgb> picture =
        render_flat(make_flat_view(7.8 - half, 7.8 + half, 5.3 - half, 5.3 + half), PixelFilter::blackman_harris);
    const auto share = [](double place, int pixel) {
        return share_left_of(place + half - (pixel + 0.5)) - share_left_of(place - half - (pixel + 0.5));
    };
    double sum = 0.0;
    for (const auto [x, y] : all_pixels(16, 12)) {
        sum += picture(x, y).x;
        // About n of 4096 samples are met: n is right within its square root.
        const double expected = share(7.8, x) * share(5.3, 11 - y);
        EXPECT_NEAR(picture(x, y).x, expected, 4.5 * std::sqrt(expected / 4096.0) + 1e-3) << x << ' ' << y;
    }
    EXPECT_NEAR(sum, 4.0 * half * half, 0.002);
}

TEST(PixelFilterTest, TheBorderIsNoDarker) {
    for (const Rgb& pixel : render_flat(make_flat_view(-10.0, 30.0, -10.0, 30.0), PixelFilter::blackman_harris).pixels)
        EXPECT_EQ(pixel.x, 1.0f);
    // Light just outside of the picture counts, in the outermost row of pixels alone.
    const Image<Rgb> outside = render_flat(make_flat_view(-10.0, 0.0, -10.0, 30.0), PixelFilter::blackman_harris);
    EXPECT_NEAR(outside(0, 6).x, share_left_of(-0.5), 2e-3);
    EXPECT_GT(outside(0, 6).x, 0.05f);
    EXPECT_EQ(outside(1, 6).x, 0.0f);
}

}  // namespace
}  // namespace aleph
