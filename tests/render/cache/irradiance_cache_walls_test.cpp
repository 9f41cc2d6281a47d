// The irradiance cache next to walls: no light may leak into a dark room, behind a thin wall or to the front of bars.

#include <gtest/gtest.h>

#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

/// Two rooms without a roof and a wall of this thickness between; a lamp, lower than the walls, in the left one.
Scene make_two_rooms(double thickness) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 2.0, white), {0.0, 0.0, 0.0}, z_to_up);
    add_mesh(scene, make_quad(4.0, 1.0, white), {0.0, 0.5, -1.0});
    add_mesh(scene, make_quad(4.0, 1.0, white), {0.0, 0.5, 1.0});
    for (const double x : {-2.0, 2.0}) {
        add_mesh(scene, make_quad(2.0, 1.0, white), {x, 0.5, 0.0},
                 glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0.0, 1.0, 0.0)));
    }
    add_mesh(scene, make_box({thickness, 1.0, 2.0}, white), {0.0, 0.5, 0.0});
    add_light(scene, Light::Kind::point, glm::dvec3(2.0), {-1.0, 0.6, 0.0});
    add_camera(scene, {0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, 0.9);
    return scene;
}

/// Floor and side walls continue from the lit room into the dark one: only distance separates their records.
struct DarkRoom {
    int dark = 0, lit = 0;      ///< pixels
    int leaking = 0;            ///< dark room's pixels that are not 0
    float darkest_lit = 1e30f;  ///< in the lit room
};

DarkRoom render_two_rooms(double thickness, double accuracy, double min_radius_pixels) {
    const Stage stage(make_two_rooms(thickness), 64, 48);
    RenderSettings settings = plain_settings(accuracy, accuracy > 0.0 ? 1024 : 64);  // the default gather
    settings.cache.min_radius_pixels = min_radius_pixels;
    const ShadedFrame out = shade(stage, settings);
    const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
    DarkRoom found;
    for (int y = 0; y < 48; ++y) {
        for (int x = 0; x < 64; ++x) {
            if (hits.hits(x, y).instance == no_index) continue;
            const PixelSurface s = make_pixel_surface(stage.shading, stage.view, hits, x, y);
            const double from_wall = s.point.position.x + stage.shading.anchor.x - 0.5 * thickness;
            if (from_wall > 0.0) {
                ++found.dark;
                found.leaking += out.color(x, y) != Rgb(0.0f);
            } else if (from_wall < -thickness - 0.05) {
                ++found.lit;
                found.darkest_lit = std::min(found.darkest_lit, out.color(x, y).x);
            }
        }
    }
    return found;
}

/// With Ward's criterion alone, light would leak here; the records' clearance and sight lines prevent it.
void expect_dark(double thickness) {
    for (const double accuracy : {0.0, 0.05, 0.15, 0.3, 0.5, 1.0}) {
        SCOPED_TRACE(accuracy);
        const DarkRoom found = render_two_rooms(thickness, accuracy, 4.0);
        EXPECT_EQ(found.leaking, 0);
        EXPECT_GT(found.dark, 200);
        EXPECT_GT(found.lit, 200);
        EXPECT_GT(found.darkest_lit, 0.01f);
    }
}

TEST(IrradianceCache, IC08_TheDarkRoomStaysDark) {
    expect_dark(0.1);
}

TEST(IrradianceCache, IC09_BehindAThinWallStaysDark) {
    expect_dark(1e-4);
}

/// Window bars in front of an emitting pane: points on the pane see the bars' lit backs; the bars' fronts get no light.
TEST(IrradianceCache, IC08_BarsBeforeAShiningPaneStayDark) {
    Scene scene;
    const int pane = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(5.0));
    const int wood = add_lambert(scene, glm::dvec3(0.8));
    add_mesh(scene, make_quad(4.0, 3.0, pane));
    for (int i = -6; i <= 6; ++i) add_mesh(scene, make_box({0.04, 3.0, 0.02}, wood), {0.3 * i, 0.0, 0.08});
    add_camera(scene, {0.0, 0.0, 3.0}, glm::dvec3(0.0), 0.9);
    const Stage stage(std::move(scene), 96, 72);
    const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
    for (const double accuracy : {0.05, 0.15, 0.3, 0.5}) {
        const ShadedFrame out = shade(stage, plain_settings(accuracy, 256));
        int fronts = 0, leaking = 0;
        for (int y = 0; y < 72; ++y) {
            for (int x = 0; x < 96; ++x) {
                if (hits.hits(x, y).instance <= 0) continue;
                const PixelSurface s = make_pixel_surface(stage.shading, stage.view, hits, x, y);
                if (s.point.normal.z < 0.99f) continue;
                ++fronts;
                leaking += out.color(x, y) != Rgb(0.0f);
            }
        }
        EXPECT_EQ(leaking, 0) << "accuracy " << accuracy << ", of " << fronts;
        EXPECT_GT(fronts, 300);
    }
}

}  // namespace
}  // namespace aleph
