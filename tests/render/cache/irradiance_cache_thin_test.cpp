// The irradiance cache at thin things: sides of a few millimetres, posts of a few centimetres.
// The irradiance cache next to walls: no light may leak into a dark room, behind a thin wall or to the front of bars.

#include "perception/vision/tvi.h"
#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int thing = 1;  // instance; the room is 0

/// A pixel of a side, and what a dense gather finds there.
struct SidePixel {
    int x = 0, y = 0;
    double truth = 0.0;
};

std::vector<SidePixel> gather_sides(const Stage& stage, const std::function<bool(const glm::vec3& normal)>& is_side) {
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    std::vector<SidePixel> sides;
    for (const auto [x, y] : all_pixels(stage.view)) {
        if (centers.hits(x, y).instance != thing) continue;
        const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, centers, x, y);
        if (is_side(surface.point.normal)) sides.push_back({x, y, luminance(gather_indirect(stage, surface, 2048))});
    }
    return sides;
}

/// Every pixel of the sides is within 5 %, or within one threshold: that of its own luminance, where white is
/// 100 cd/m2. The lamp is behind the thing, so that the sides towards the camera have indirect light only.
void expect_right_sides(Scene scene, const std::function<bool(const glm::vec3& normal)>& is_side) {
    const Stage stage(std::move(scene), 80, 60);
    const std::vector<SidePixel> sides = gather_sides(stage, is_side);
    EXPECT_GT(sides.size(), 40u);
    EXPECT_LT(sides.size(), 250u);  // for the test's own time
    for (const double accuracy : {0.15, 0.1, 0.05}) {
        const IndirectPicture picture = shade_indirect(stage, plain_settings(accuracy, 1024));
        int wrong = 0;
        double worst = 0.0;
        for (const auto& [x, y, truth] : sides) {
            const float shown = 100.0f * luminance(picture.all(x, y));
            float threshold = 0.0f;
            tvi_row(&shown, 1, &threshold);
            const double error = std::abs(luminance(picture.indirect(x, y)) - truth);
            wrong += error > std::max(0.05 * truth, 0.01 * double{threshold});
            worst = std::max(worst, error / truth);
        }
        EXPECT_EQ(wrong, 0) << "of " << sides.size() << " at accuracy " << accuracy << "; the worst is off by "
                            << 100.0 * worst << " %";
    }
}

TEST(IrradianceCache, IC18_TheEdgeOfACarpet) {
    Scene scene = make_lamp_room({0.0, 1.0, -1.5});
    add_mesh(scene, make_box({1.2, 0.005, 0.8}, 0), {0.0, -1.4975, 0.0});
    add_camera(scene, {0.0, -1.1, 1.4}, {0.0, -1.5, 0.4}, 0.5);
    expect_right_sides(std::move(scene), [](const glm::vec3& normal) { return normal.z > 0.5f; });
}

TEST(IrradianceCache, IC18_TheSidesOfAPictureFrame) {
    Scene scene = make_lamp_room({-1.5, 1.2, -1.0});
    add_mesh(scene, make_box({0.6, 0.45, 0.02}, 0), {0.0, 0.0, -1.99});
    add_camera(scene, {1.0, -0.6, -0.9}, {0.15, -0.05, -2.0}, 0.45);
    expect_right_sides(std::move(scene), [](const glm::vec3& normal) { return normal.x > 0.5f || normal.y < -0.5f; });
}

TEST(IrradianceCache, IC18_TheRimOfATorusOnTheFloor) {
    Scene scene = make_lamp_room({0.0, 1.0, -1.5});
    const Shape torus{.kind = Shape::Kind::torus, .radius = 0.3, .tube_radius = 0.03};
    add_mesh(scene, make_shape_mesh(torus, 0), {0.0, -1.47, 0.0});
    add_camera(scene, {0.0, -1.1, 1.4}, {0.0, -1.5, 0.2}, 0.5);
    expect_right_sides(std::move(scene), [](const glm::vec3& normal) { return normal.z > 0.6f && normal.y < 0.1f; });
}

/// A court of 4 m by 2 m without a roof, lit by a lamp on its left that is lower than its walls, seen from above.
Scene make_court() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 2.0, white), {0.0, 0.0, 0.0}, z_to_up);
    for (const double z : {-1.0, 1.0}) add_mesh(scene, make_quad(4.0, 1.0, white), {0.0, 0.5, z});
    for (const double x : {-2.0, 2.0}) add_mesh(scene, make_quad(2.0, 1.0, white), {x, 0.5, 0.0}, turn_about_y(pi / 2));
    add_light(scene, Light::Kind::point, glm::dvec3(2.0), {-1.0, 0.6, 0.0});
    add_camera(scene, {0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, 0.9);
    return scene;
}

/// Something at x = 0 divides a court. Floor and side walls continue from the lit side into the dark one: only distance
/// separates their records. With Ward's criterion alone, light would leak; the records' clearance and sight lines
/// prevent it.
/// @param half  of the thickness, m
void expect_dark_right(Scene court, double half, RenderSettings settings) {
    const Stage stage(std::move(court), 64, 48);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    const int gather = settings.cache.gather;
    for (const double accuracy : {0.0, 0.05, 0.15, 0.3, 0.5, 1.0}) {
        SCOPED_TRACE(accuracy);
        settings.cache.accuracy = accuracy;
        settings.cache.gather = accuracy > 0.0 ? gather : 64;
        const ShadedFrame out = shade(stage, settings);
        int dark = 0, leaking = 0, lit = 0;
        float darkest_lit = float_infinity;
        for (const auto [x, y] : all_pixels(out.color)) {
            if (centers.hits(x, y).instance == no_index) continue;
            const PixelSurface s = make_pixel_surface(stage.shading, stage.view, centers, x, y);
            const double at = s.point.position.x + stage.shading.anchor.x;
            if (at > half) {
                ++dark;
                leaking += out.color(x, y) != Rgb(0.0f);
            } else if (at < -half - 0.05) {
                ++lit;
                darkest_lit = std::min(darkest_lit, out.color(x, y).x);
            }
        }
        EXPECT_EQ(leaking, 0) << "of " << dark;
        EXPECT_GT(dark, 200);
        EXPECT_GT(lit, 200);
        EXPECT_GT(darkest_lit, 0.01f);
    }
}

/// Posts of 1 cm that stand in two rows and leave no gap.
TEST(IrradianceCache, IC19_BehindAClosedFenceItIsDark) {
    Scene scene = make_court();
    constexpr int posts = 220;
    for (int i = 0; i <= posts; ++i) {
        const double z = -1.0 + 2.0 * i / posts;
        add_mesh(scene, make_box({0.01, 1.0, 0.01}, 0), {i % 2 == 0 ? 0.004 : -0.004, 0.5, z});
    }
    expect_dark_right(std::move(scene), 0.01, plain_settings(0.0, 256));
}

/// Twelve legs of chairs on the floor of a room.
Scene make_room_of_chairs(bool legs) {
    Scene scene = make_lamp_room({0.5, 1.2, 0.3});
    for (int leg = 0; legs && leg < 12; ++leg) {
        add_mesh(scene, make_box({0.03, 0.45, 0.03}, 0),
                 {-1.0 + 0.9 * (leg / 4) + 0.4 * (leg % 2), -1.275, -0.8 + 0.4 * (leg / 2 % 2)});
    }
    add_camera(scene, {0.0, 0.3, 1.9}, {0.0, -0.6, 0.0}, 1.0);
    return scene;
}

/// Posts of 1 cm, 10 cm apart, divide a court.
Scene make_fenced_court(bool posts) {
    Scene scene = make_court();
    for (int i = 0; posts && i <= 20; ++i) add_mesh(scene, make_box({0.01, 1.0, 0.01}, 0), {0.0, 0.5, -1.0 + 0.1 * i});
    return scene;
}

TEST(IrradianceCache, IC19_LegsAndPostsCostFewRecords) {
    for (const auto& [name, make_scene] :
         {std::pair("legs", &make_room_of_chairs), std::pair("posts", &make_fenced_court)}) {
        for (const double accuracy : {0.15, 0.05}) {
            const auto count_records = [&, make = make_scene](bool things) {
                return shade(Stage(make(things), 160, 120), plain_settings(accuracy, 0)).counts.records;
            };
            const auto without = count_records(false), with = count_records(true);
            EXPECT_GT(without, 100u);
            EXPECT_LE(2 * with, 3 * without) << name << " at " << accuracy << ": " << with << ", not " << without;
        }
    }
}

void expect_dark_behind_wall(double thickness) {
    Scene scene = make_court();
    add_mesh(scene, make_box({thickness, 1.0, 2.0}, 0), {0.0, 0.5, 0.0});
    RenderSettings settings = plain_settings(0.0, 1024);  // the default gather
    settings.cache.min_radius_pixels = 4.0;
    expect_dark_right(std::move(scene), 0.5 * thickness, settings);
}

TEST(IrradianceCache, IC08_TheDarkRoomStaysDark) {
    expect_dark_behind_wall(0.1);
}

TEST(IrradianceCache, IC09_BehindAThinWallStaysDark) {
    expect_dark_behind_wall(1e-4);
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
        for (const auto [x, y] : all_pixels(96, 72)) {
            if (hits.hits(x, y).instance <= 0) continue;
            const PixelSurface s = make_pixel_surface(stage.shading, stage.view, hits, x, y);
            if (s.point.normal.z < 0.99f) continue;
            ++fronts;
            leaking += out.color(x, y) != Rgb(0.0f);
        }
        EXPECT_EQ(leaking, 0) << "accuracy " << accuracy << ", of " << fronts;
        EXPECT_GT(fronts, 300);
    }
}

}  // namespace
}  // namespace aleph
