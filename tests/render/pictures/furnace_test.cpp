// White furnaces: closed emissive bodies seen from inside. Their radiance is a geometric series.

#include "tests/support/render_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

const glm::vec3 box_size(3.0f, 2.0f, 4.0f);

/// Returns whether a point of the box is not next to an edge.
bool is_off_edges(const glm::vec3& p) {
    const glm::vec3 to_faces = 0.5f * box_size - glm::abs(p);
    int near = 0;
    for (int k = 0; k < 3; ++k) near += to_faces[k] < 0.25f ? 1 : 0;
    return near <= 1;
}

bool is_anywhere(const glm::vec3&) {
    return true;
}

/// Compares every pixel's mean over independent renders with one number: within 3 standard errors, except for the few
/// pixels that these allow. The picture's mean is within 1 %.
/// @param counts  the surface points that are compared one by one. Next to an edge of a lamp that covers all walls, a
///                fifth of the light comes from a narrow strip across the edge, which samples rarely hit: their
///                statistics are not normal. Such pixels count in the picture's mean only.
void expect_everywhere(Scene scene, const RenderSettings& settings, double expected,
                       bool (*counts)(const glm::vec3& point) = is_anywhere) {
    constexpr int width = 20, height = 15;
    constexpr std::uint32_t runs = 16;
    const Stage stage(std::move(scene), width, height);
    EXPECT_TRUE(holds([&](Trial& trial) {
        std::vector<Mean> pixels(width * height);
        Mean picture;
        for (std::uint32_t run = 0; run < trial.times(runs); ++run) {
            RenderSettings seeded = settings;
            seeded.seed = run + trial.seed;
            const ShadedFrame out = shade(stage, seeded);
            ASSERT_EQ(out.counts.invalid_samples, 0u);
            double sum = 0.0;
            for (std::size_t i = 0; i < pixels.size(); ++i) {
                ASSERT_EQ(out.coverage.pixels[i], 1.0f);
                pixels[i].add(out.color.pixels[i].x);
                sum += out.color.pixels[i].x;
            }
            picture.add(sum / (width * height));
        }
        trial.near(picture, expected, 1e-4 * expected);
        EXPECT_NEAR(picture.mean(), expected, 0.01 * expected);
        const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
        int beyond = 0, judged = 0;
        for (std::size_t i = 0; i < pixels.size(); ++i) {
            const PixelSurface s = make_pixel_surface(stage.shading, stage.view, hits, static_cast<int>(i) % width,
                                                      static_cast<int>(i) / width);
            if (!counts(s.point.position + glm::vec3(stage.shading.anchor))) continue;
            ++judged;
            const Mean& pixel = pixels[i];
            // Without noise, float rounding and the offset of ray origins remain.
            const double difference = std::abs(pixel.mean() - expected), rounding = 2e-4 * expected;
            if (difference > 3.0 * pixel.error() + rounding) ++beyond;
            EXPECT_LT(difference, 8.0 * pixel.error() + rounding);
        }
        // Student's t with 15 degrees of freedom: .9 % are beyond 3.
        const double share = 0.009 * judged;
        trial.at_most(beyond, std::sqrt(share), share);
        EXPECT_GT(judged, width * height / 2);
    }));
}

Scene make_furnace(Mesh (*body)(int material), double albedo, double emission, bool double_sided) {
    Scene scene;
    const int material = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(emission), double_sided);
    // One-sided emitters emit from the front, which must face inwards.
    add_mesh(scene, double_sided ? body(material) : flip_winding(body(material)));
    add_camera(scene, {0.3, 0.2, 0.4}, {1.0, -0.3, -1.0}, 1.2);
    return scene;
}

Mesh make_sphere_body(int material) {
    return make_faceted_sphere(2.0, 48, material);
}
Mesh make_box_body(int material) {
    return make_box(glm::dvec3(box_size), material);
}

RenderSettings furnace_settings(int bounces, int light_samples) {
    RenderSettings settings = plain_settings(0.2, 256);
    settings.light.bounces = bounces;
    settings.light.light_samples = light_samples;
    return settings;
}

TEST(Furnace, SphereDirect) {
    expect_everywhere(make_furnace(make_sphere_body, 0.6, 0.5, false), furnace_settings(0, 16), 0.5 * 1.6);
}

TEST(Furnace, SphereOneBounce) {
    expect_everywhere(make_furnace(make_sphere_body, 0.6, 0.5, false), furnace_settings(1, 16), 0.5 * (1.6 + 0.36));
}

TEST(Furnace, SphereOneBounceGatheredEverywhere) {
    RenderSettings settings = furnace_settings(1, 16);
    settings.cache.accuracy = 0.0;
    settings.cache.gather = 64;
    expect_everywhere(make_furnace(make_sphere_body, 0.9, 1.0, true), settings, 1.0 + 0.9 + 0.81);
}

TEST(Furnace, BoxDirect) {
    expect_everywhere(make_furnace(make_box_body, 0.6, 0.5, false), furnace_settings(0, 512), 0.5 * 1.6, is_off_edges);
}

TEST(Furnace, BoxOneBounce) {
    expect_everywhere(make_furnace(make_box_body, 0.6, 0.5, true), furnace_settings(1, 512), 0.5 * (1.6 + 0.36),
                      is_off_edges);
}

TEST(Furnace, EnvironmentAroundAConvexBody) {
    // A white Lambert ball under a white sky cannot be seen. It reflects no light to itself, so bounces change nothing.
    for (const int bounces : {0, 1}) {
        Scene scene;
        scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0));
        add_mesh(scene, make_faceted_sphere(1.0, 48, add_lambert(scene, glm::dvec3(1.0))));
        add_camera(scene, {0.0, 0.0, 4.0}, {0.0, 0.0, 0.0}, 0.7);
        const Stage stage(std::move(scene), 20, 15);
        const ShadedFrame out = shade(stage, furnace_settings(bounces, 16));
        float covered = 0.0f;
        for (std::size_t i = 0; i < out.color.size(); ++i) {
            EXPECT_NEAR(out.color.pixels[i].x, 1.0f, 2e-3f);
            covered += out.coverage.pixels[i];
        }
        EXPECT_GT(covered, 50.0f);
        EXPECT_LT(covered, 250.0f);
    }
}

}  // namespace
}  // namespace aleph
