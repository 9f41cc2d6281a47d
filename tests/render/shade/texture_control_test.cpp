// Samples of textured pixels, corrected by texels beside them.

#include "render/shade/texture_control.h"

#include "render/pixels/pixel_surfaces.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A floor of squares, some smaller than a pixel, seen from a low camera under the sun.
Scene make_checkered_floor(const glm::dvec3& at, bool orthographic) {
    Scene scene;
    scene.film.exposure = 1.0;
    const int material = add_lambert(scene, glm::dvec3(1.0));
    SceneImage image{.bytes = Image<glm::u8vec4>(64, 64)};
    for (const auto [x, y] : all_pixels(64, 64))
        image.bytes(x, y) = ((x / 8 + y / 8) % 2 == 0) ? glm::u8vec4(255) : glm::u8vec4(60, 80, 90, 255);
    scene.images.push_back(image);
    scene.materials[0].textures[TextureSlot::base_color] = {.image = 0};
    Mesh floor = make_quad(40.0, 60.0, material);
    for (glm::vec2& uv : floor.uv[0]) uv = {20.0f * uv.x + 7.0f * uv.y, 30.0f * uv.y};
    add_mesh(scene, floor, at, z_to_up);
    add_camera(scene, at + glm::dvec3(0.3, 1.6, 3.0), at + glm::dvec3(0.0, 1.3, 0.0), 0.6);
    scene.cameras[0].orthographic = orthographic;
    scene.cameras[0].half_height = 1.5;
    add_light(scene, Light::Kind::directional, glm::dvec3(pi), at,
              glm::angleAxis(-0.5 * pi, glm::dvec3(1.0, 0.0, 0.0)));
    return scene;
}

struct CheckeredFloor {
    explicit CheckeredFloor(const glm::dvec3& at = glm::dvec3(0.0), bool orthographic = false)
        : stage(make_checkered_floor(at, orthographic), 32, 24),
          centers(cast_centers(stage.rays, stage.view, nullptr)),
          estimate(stage.view.width, stage.view.height) {
        for (const auto [x, y] : all_pixels(estimate)) {
            if (centers.hits(x, y).instance != no_index)
                estimate(x, y) = make_pixel_surface(stage.shading, stage.view, centers, x, y).material.diffuse;
        }
    }

    TextureControl control() const { return {stage.shading, stage.view, centers, estimate, 1.0}; }

    SamplePlace place(int index) const {
        SamplePlace place;
        place.index = index;
        place.centered = false;
        place.spacing = 0.25f;
        place.filter = PixelFilter::blackman_harris;
        return place;
    }

    /// Albedo of a sample; nothing beside the floor.
    std::optional<Rgb> albedo(const SamplePlace& place, int x, int y) const {
        const CameraRay ray = make_sample_ray(stage.view, place, x, y);
        const glm::vec3 direction(ray.direction);
        const Hit hit = Tracer(stage.rays).intersect({glm::vec3(ray.origin - stage.rays.anchor()), direction});
        if (hit.instance == no_index) return std::nullopt;
        return make_pixel_surface(stage.shading, stage.view, place, hit, direction, {x, y}).material.diffuse;
    }

    Stage stage;
    SampleHits centers;
    Image<Rgb> estimate;
};

TEST(TextureControl, CorrectedSamplesDifferAsMeansOfFourTexelsDo) {
    struct Case {
        glm::dvec3 at;
        bool orthographic;
    };
    for (const auto& [at, orthographic] :
         {Case{glm::dvec3(0.0), false}, Case{{1e5, -1e5, 1e5}, false}, Case{glm::dvec3(0.0), true}}) {
        const CheckeredFloor floor(at, orthographic);
        const TextureControl control = floor.control();
        Mean difference;
        double corrected = 0.0, plain = 0.0;
        int pixels = 0;
        for (int y = 1; y < 23; ++y) {
            for (int x = 1; x < 31; ++x) {
                if (!control.corrects(x, y)) continue;
                const PixelTexture texture = control.find_texture(x, y);
                Mean of_samples, of_corrected;
                for (int i = 0; i < 32; ++i) {
                    const SamplePlace place = floor.place(i);
                    const std::optional<Rgb> albedo = floor.albedo(place, x, y);
                    if (!albedo) continue;
                    const Rgb correction = texture.correct(place);
                    of_samples.add(albedo->x);
                    of_corrected.add(albedo->x + correction.x);
                    difference.add(correction.x);
                }
                plain += std::pow(of_samples.error(), 2.0);
                corrected += std::pow(of_corrected.error(), 2.0);
                ++pixels;
            }
        }
        EXPECT_GT(pixels, 300) << at.x << orthographic;
        EXPECT_GT(32.0 * plain / pixels, 0.01);
        EXPECT_LT(corrected, 0.3 * plain) << at.x << orthographic;
        EXPECT_LT(std::abs(difference.mean()), 4.0 * difference.error());
    }
}

TEST(TextureControl, APictureHasTheSameMeanAndLessNoise) {
    const CheckeredFloor floor;
    RenderSettings settings = plain_settings(0.0, 1);
    settings.light.bounces = 0;
    settings.sampling.spp = 1024;
    const Image<Rgb> truth = shade(floor.stage, settings).color;
    settings.sampling.spp = 4;
    double squares[2]{};
    Mean mean[2];
    for (const int corrected : {0, 1}) {
        SampleOptions options;
        if (corrected) options.estimate = &floor.estimate;
        for (settings.seed = 1; settings.seed <= 8; ++settings.seed) {
            const Image<Rgb> few = shade(floor.stage, settings, options).color;
            for (std::size_t i = 0; i < truth.size(); ++i) {
                const double error = few.pixels[i].x - truth.pixels[i].x;
                squares[corrected] += error * error;
                mean[corrected].add(error);
            }
        }
    }
    EXPECT_LT(squares[1], 0.5 * squares[0]);
    // Textures of four samples are blurred by half a pixel with and without.
    EXPECT_NEAR(mean[1].mean(), mean[0].mean(), 4.0 * std::hypot(mean[0].error(), mean[1].error()));
}

TEST(TextureControl, APathTracerIsNotCorrected) {
    const CheckeredFloor floor;
    SampleOptions options;
    options.estimate = &floor.estimate;
    const RenderSettings settings = path_settings(0, 4);
    EXPECT_EQ(shade(floor.stage, settings, options).color.pixels, shade(floor.stage, settings).color.pixels);
}

TEST(TextureControl, NothingIsCorrectedByAnEstimateThatIsNotFinite) {
    CheckeredFloor floor;
    for (const float value : {std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN(), 3e38f}) {
        floor.estimate(16, 20) = Rgb(value);
        const TextureControl control = floor.control();
        ASSERT_TRUE(control.corrects(16, 20));
        EXPECT_EQ(control.find_texture(16, 20).correct(floor.place(0)), Rgb(0.0f)) << value;
    }
}

TEST(TextureControl, AHighlightInOnePixelMakesNoNoise) {
    CheckeredFloor floor;
    const auto largest = [&] {
        const PixelTexture texture = floor.control().find_texture(16, 20);
        float most = 0.0f;
        for (int i = 0; i < 32; ++i) most = std::max(most, std::abs(texture.correct(floor.place(i)).x));
        return most;
    };
    const float before = largest();
    ASSERT_GT(before, 0.0f);
    floor.estimate(16, 20) = Rgb(100.0f);
    EXPECT_LT(largest(), 2.0f * before);
}

TEST(TextureControl, PixelsBesideAnotherObjectAreLeftOut) {
    const CheckeredFloor floor;
    const TextureControl control = floor.control();
    int left_out = 0;
    for (int y = 1; y < 23; ++y) {
        for (int x = 0; x < 32; ++x) {
            const bool is_floor = floor.centers.hits(x, y).instance != no_index;
            const bool at_horizon = is_floor && floor.centers.hits(x, y - 1).instance == no_index;
            if (at_horizon) ++left_out;
            EXPECT_FALSE((at_horizon || !is_floor) && control.corrects(x, y)) << x << ' ' << y;
        }
    }
    EXPECT_GT(left_out, 20);
}

TEST(TextureControl, GoesOnWhereItMakesErrorsSmaller) {
    const CheckeredFloor floor;
    TextureControl control = floor.control();
    Image<PixelSamples> pixels(32, 24);
    const auto take = [&](int x, int y, float light, float correction) {
        SampleLight sample;
        sample[LightPart::direct] = Rgb(light + correction);
        sample.control = Rgb(correction);
        pixels(x, y).add(sample);
    };
    for (int y = 17; y < 20; ++y) {
        for (int x = 3; x < 6; ++x) {  // without the correction 0 and 1
            take(x, y, 0.0f, 0.5f);
            take(x, y, 1.0f, -0.4f);
        }
        for (int x = 13; x < 16; ++x) {  // the correction has nothing to do with it
            take(x, y, 0.0f, 0.1f);
            take(x, y, 1.0f, 0.1f);
        }
    }
    ASSERT_TRUE(control.corrects(4, 18) && control.corrects(14, 18));
    control.choose(std::vector<PixelRange>{{4, 18, 0, 2}, {14, 18, 0, 2}}, pixels);
    EXPECT_TRUE(control.corrects(4, 18) && control.corrects(14, 18));
    control.choose(std::vector<PixelRange>{{4, 18, 2, 4}, {14, 18, 2, 4}}, pixels);
    EXPECT_TRUE(control.corrects(4, 18));
    EXPECT_FALSE(control.corrects(14, 18));
}

}  // namespace
}  // namespace aleph
