// The irradiance cache at thin things: sides of a few millimetres, posts of a few centimetres.

#include <gtest/gtest.h>

#include <functional>

#include "perception/tvi.h"
#include "tests/support/indirect_pictures.h"

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
    for (int y = 0; y < stage.view.height; ++y) {
        for (int x = 0; x < stage.view.width; ++x) {
            if (centers.hits(x, y).instance != thing) continue;
            const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, centers, x, y);
            if (is_side(surface.point.normal))
                sides.push_back({x, y, luminance(gather_indirect(stage, surface, 2048))});
        }
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
            const double threshold = tvi(100.0 * luminance(picture.all(x, y))) / 100.0;
            const double error = std::abs(luminance(picture.indirect(x, y)) - truth);
            wrong += error > std::max(0.05 * truth, threshold);
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
    Shape torus;
    torus.kind = Shape::Kind::torus;
    torus.radius = 0.3;
    torus.tube_radius = 0.03;
    add_mesh(scene, make_shape_mesh(torus, 0), {0.0, -1.47, 0.0});
    add_camera(scene, {0.0, -1.1, 1.4}, {0.0, -1.5, 0.2}, 0.5);
    expect_right_sides(std::move(scene), [](const glm::vec3& normal) { return normal.z > 0.6f && normal.y < 0.1f; });
}

/// A court without a roof, divided at x = 0 by posts of 1 cm that stand in two rows and leave no gap; a lamp, lower
/// than the posts, on the left.
Scene make_fenced_court() {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.8), glm::dvec3(0.0), true);
    add_mesh(scene, make_quad(4.0, 2.0, white), {0.0, 0.0, 0.0}, z_to_up);
    for (const double z : {-1.0, 1.0}) add_mesh(scene, make_quad(4.0, 1.0, white), {0.0, 0.5, z});
    for (const double x : {-2.0, 2.0}) {
        add_mesh(scene, make_quad(2.0, 1.0, white), {x, 0.5, 0.0},
                 glm::angleAxis(std::numbers::pi / 2, glm::dvec3(0.0, 1.0, 0.0)));
    }
    constexpr int posts = 220;
    for (int i = 0; i <= posts; ++i) {
        const double z = -1.0 + 2.0 * i / posts;
        add_mesh(scene, make_box({0.01, 1.0, 0.01}, white), {i % 2 == 0 ? 0.004 : -0.004, 0.5, z});
    }
    add_light(scene, Light::Kind::point, glm::dvec3(2.0), {-1.0, 0.6, 0.0});
    add_camera(scene, {0.0, 4.0, 0.0}, {0.0, 0.0, 0.0}, 0.9);
    return scene;
}

TEST(IrradianceCache, IC19_BehindAClosedFenceItIsDark) {
    const Stage stage(make_fenced_court(), 64, 48);
    const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
    for (const double accuracy : {0.0, 0.05, 0.15, 0.3, 0.5, 1.0}) {
        const ShadedFrame out = shade(stage, plain_settings(accuracy, accuracy > 0.0 ? 256 : 64));
        int dark = 0, leaking = 0, lit = 0;
        for (int y = 0; y < 48; ++y) {
            for (int x = 0; x < 64; ++x) {
                if (centers.hits(x, y).instance == no_index) continue;
                const PixelSurface surface = make_pixel_surface(stage.shading, stage.view, centers, x, y);
                const float from_fence = surface.point.position.x + static_cast<float>(stage.shading.anchor.x);
                if (from_fence > 0.01f) {
                    ++dark;
                    leaking += out.color(x, y) != Rgb(0.0f);
                } else if (from_fence < -0.05f) {
                    lit += out.color(x, y).x > 0.01f;
                }
            }
        }
        EXPECT_EQ(leaking, 0) << "of " << dark << " pixels at accuracy " << accuracy;
        EXPECT_GT(dark, 200);
        EXPECT_GT(lit, 200);
    }
}

TEST(IrradianceCache, IC19_ChairLegsCostFewRecords) {
    const auto count_records = [](bool legs) {
        Scene scene = make_lamp_room({0.5, 1.2, 0.3});
        for (int chair = 0; legs && chair < 3; ++chair) {
            for (int leg = 0; leg < 4; ++leg) {
                add_mesh(scene, make_box({0.03, 0.45, 0.03}, 0),
                         {-1.0 + 0.9 * chair + 0.4 * (leg % 2), -1.275, -0.8 + 0.4 * (leg / 2)});
            }
        }
        add_camera(scene, {0.0, 0.3, 1.9}, {0.0, -0.6, 0.0}, 1.0);
        const Stage stage(std::move(scene), 640, 480);  // the default size; in small pictures legs cost more
        return shade(stage, plain_settings(0.15, 512)).counts.records;
    };
    const auto without = count_records(false), with = count_records(true);
    EXPECT_GT(without, 100u);
    EXPECT_LE(2 * with, 3 * without) << with << " records, without legs " << without;
}

}  // namespace
}  // namespace aleph
