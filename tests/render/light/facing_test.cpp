// Lamps of many triangles, most of which face away: what samples and the quick estimate find of them.

#include <random>

#include "render/estimate/estimate.h"
#include "render/light/light_choice.h"
#include "tests/support/all_pixels.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"

namespace aleph {
namespace {

/// A ball of radius and radiance 1 at the origin.
Scene make_bulb() {
    Scene scene;
    const int shining = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    add_mesh(scene, make_shape_mesh({.kind = Shape::Kind::sphere, .radius = 1.0, .segments = 96}, shining));
    return scene;
}

glm::vec3 random_direction(std::mt19937& random) {
    std::normal_distribution<float> normal;
    return glm::normalize(glm::vec3(normal(random), normal(random), normal(random)));
}

TEST(FacingSides, SamplesOfABulbFindItsLight) {
    const Stage stage(make_bulb());
    const glm::vec3 center(-stage.shading.anchor);
    struct {
        float distance;  // m
        double found;    // least share of the samples that find light; by the whole area .08, .25, .49
    } const cases[] = {{1.2f, 0.25}, {2.0f, 0.4}, {40.0f, 0.6}};
    for (const auto& [distance, least] : cases) {
        SCOPED_TRACE(distance);
        const double expected = pi / (distance * distance);
        EXPECT_TRUE(holds([&](Trial& trial) {
            std::mt19937 random(trial.seed);
            std::uniform_real_distribution<float> unit;
            Mean mean, found;
            for (int i = 0; i < trial.times(20'000); ++i) {
                const glm::vec3 away = random_direction(random);
                const Receiver receiver{center + distance * away, -away};
                const glm::vec2 u(unit(random), unit(random));
                const LightSample sample = sample_light(stage.shading, stage.lights, 0, receiver, u);
                const float cosine = glm::dot(sample.direction, receiver.normal);
                mean.add(sample.incoming.x * std::max(cosine, 0.0f));
                found.add(sample.incoming.x > 0.0f ? 1.0 : 0.0);
                if (!(sample.incoming.x > 0.0f)) continue;
                const glm::vec3 normal = receiver.position + sample.direction * sample.distance - center;
                const float facing = -glm::dot(normal, sample.direction);
                if (facing < 0.4f) continue;  // the ball has facets
                const float pdf = pdf_emitter(stage.lights.emitters[0], receiver.position, {}, facing, sample.distance);
                EXPECT_NEAR(sample.pdf / pdf, 1.0, 0.2);
            }
            trial.near(mean, expected, 0.003 * expected);
            EXPECT_GT(found.mean(), least);
        }));
    }
}

TEST(FacingSides, TheEstimateFindsTheLightOfABulb) {
    constexpr int side = 9;
    for (const double height : {1.2, 2.0, 5.0}) {
        SCOPED_TRACE(height);
        Scene scene = make_bulb();
        const int floor = add_lambert(scene, glm::dvec3(1.0));
        add_mesh(scene, make_quad(20.0, 20.0, floor), {0.0, -height, 0.0}, z_to_up);
        add_camera(scene, {0.0, 0.1 - height, 0.0}, {0.0, -height, 0.0});
        scene.cameras[0].orthographic = true;
        scene.cameras[0].half_height = 0.2;
        const Stage stage(std::move(scene), side, side);
        RayCounts counts;
        const SampleHits centers = cast_centers(stage.rays, stage.view, nullptr);
        const Image<Rgb> seen = compute_estimate(stage.lighting(), stage.view, centers, {}, counts);
        double mean = 0.0;
        for (const Rgb& pixel : seen.pixels) {
            EXPECT_GT(pixel.x, 0.0f);
            mean += pixel.x * height * height / (side * side);
        }
        EXPECT_NEAR(mean, 1.0, 0.3);
    }
}

}  // namespace
}  // namespace aleph
