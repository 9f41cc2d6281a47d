// A checker texture at a grazing angle, filtered by the footprints of pixels, against many samples per pixel.

#include <gtest/gtest.h>

#include <cmath>

#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

/// A floor with a checker texture, seen from a low camera. Only its albedo is rendered (no light, `flat` estimate).
struct Checker {
    static Scene make() {
        Scene scene;
        const int material = add_lambert(scene, glm::dvec3(1.0));
        SceneImage image;
        image.bytes = Image<glm::u8vec4>(64, 64);
        for (int y = 0; y < 64; ++y) {
            for (int x = 0; x < 64; ++x) {
                image.bytes(x, y) = ((x / 8 + y / 8) % 2 == 0) ? glm::u8vec4(255) : glm::u8vec4(40, 10, 90, 255);
            }
        }
        scene.images.push_back(image);
        scene.materials[0].base_color_texture = {.image = 0};
        Mesh floor = make_quad(400.0, 400.0, material);
        for (glm::vec2& uv : floor.uv[0]) uv *= 800.0f;
        add_mesh(scene, floor, glm::dvec3(0.0), z_to_up);
        add_camera(scene, {0.3, 0.6, 3.0}, {0.0, 0.2, 0.0}, 0.6);
        return scene;
    }

    Checker() : stage(make(), 48, 36) {}

    /// Mean of n by n samples in every pixel, each averaged over `footprints` of its own spacing.
    Image<Rgb> render(int n, bool footprints) const {
        Image<Rgb> sum(stage.view.width, stage.view.height);
        for (int i = 0; i < n * n; ++i) {
            const double offset_x = (i % n + 0.5) / n, offset_y = (i / n + 0.5) / n;
            SamplePlace place;
            place.spacing = footprints ? 1.0f / static_cast<float>(n) : 0.0f;
            const Image<Hit> hits = cast_first_hits(stage.rays, stage.view, offset_x, offset_y);
            for (int y = 0; y < sum.height; ++y) {
                for (int x = 0; x < sum.width; ++x) {
                    if (hits(x, y).instance == no_index) continue;
                    const glm::vec3 direction(make_camera_ray(stage.view, x + offset_x, y + offset_y).direction);
                    sum(x, y) += make_pixel_surface(stage.shading, stage.view, place, hits(x, y), direction, {x, y})
                                     .material.diffuse /
                                 static_cast<float>(n * n);
                }
            }
        }
        return sum;
    }

    /// Over the pixels of the floor, from two rows below the horizon down.
    double rms(const Image<Rgb>& a, const Image<Rgb>& b) const {
        double sum = 0.0;
        int count = 0;
        for (int y = 0; y < a.height; ++y) {
            for (int x = 0; x < a.width; ++x) {
                const int above = std::max(0, y - 2);
                if (!(reached(x, above) && reached(x, y))) continue;
                const float d = a(x, y).x - b(x, y).x;
                sum += d * d;
                ++count;
            }
        }
        EXPECT_GT(count, 500);
        return std::sqrt(sum / count);
    }
    bool reached(int x, int y) const {
        const CameraRay ray = make_camera_ray(stage.view, x, y);
        return ray.direction.y < 0.0;
    }

    Stage stage;
};

TEST(TextureFilter, GrazingCheckerConvergesAtOnce) {
    const Checker checker;
    const Image<Rgb> truth = checker.render(32, false);  // 1024 per pixel
    const double filtered = checker.rms(checker.render(1, true), truth);
    const double pointwise = checker.rms(checker.render(1, false), truth);
    EXPECT_LT(filtered, 0.04);
    EXPECT_GT(pointwise, 10.0 * filtered);
    // More samples and smaller footprints come closer.
    EXPECT_LT(checker.rms(checker.render(4, true), truth), 0.6 * filtered);
    RecordProperty("filtered", std::to_string(filtered));
    RecordProperty("pointwise", std::to_string(pointwise));
}

}  // namespace
}  // namespace aleph
