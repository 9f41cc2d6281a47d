// Openings towards the sky tell which lights are chosen, and where their rays go.

#include <glm/gtc/quaternion.hpp>

#include "render/light/light_rays.h"
#include "tests/support/scenes/window_room.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// Light of one choice among all lights, at a white place.
Mean light_of_choices(const LightingContext& lighting, const SurfacePlace& place) {
    Mean light;
    RayTask task(lighting.rays);
    RandomStream random({6, 0, 0, 0});
    for (int i = 0; i < 50'000; ++i) {
        const ScatteredLight way = choose_lambert_light(lighting, place, {random.next(), random.next_2d()});
        const bool arrives = way.radiance != Rgb(0.0f) && !task.tracer.occluded(way.shadow_ray);
        light.add(arrives ? way.radiance.x : 0.0f);
    }
    return light;
}

TEST(OpeningLight, ASunTakesSamplesOnlyWhereItShines) {
    Scene scene = make_room_with_window();
    const Stage cloudy(scene);
    add_light(scene, Light::Kind::directional, glm::dvec3(50.0), glm::dvec3(0.0),
              glm::quatLookAt(glm::normalize(glm::dvec3(-1.0, -0.6, 0.0)), glm::dvec3(0.0, 1.0, 0.0)));
    const Stage sunny(std::move(scene));
    const SkyOpenings openings = find_openings(sunny).value();
    const auto light_at = [&](const Stage& stage, float z, bool with_openings) {
        LightingContext lighting = stage.lighting();
        if (with_openings) lighting.openings = &openings;
        return light_of_choices(lighting, make_point(glm::vec3(-0.5f, 0.0f, z) - glm::vec3(stage.shading.anchor), up));
    };
    for (const float z : {0.0f, 1.5f}) {
        const Mean plain = light_at(sunny, z, false), aimed = light_at(sunny, z, true);
        EXPECT_NEAR(aimed.mean(), plain.mean(), 4.0 * std::hypot(plain.error(), aimed.error()));
        EXPECT_LT(2.0 * aimed.error(), plain.error());
    }
    EXPECT_GT(light_at(sunny, 0.0f, true).mean(), 50.0 * 0.5 / std::numbers::pi) << "it shines here";
    EXPECT_LT(light_at(sunny, 1.5f, true).error(), 3.0 * light_at(cloudy, 1.5f, true).error());
}

/// Light rays that reach the floor of the room, and their light.
struct FloorLight {
    double reflected = 0.0;  ///< lm
    double rays = 0.0;
};

FloorLight light_floor(const Stage& stage, const SkyOpenings* openings) {
    LightingContext lighting = stage.lighting();
    lighting.openings = openings;
    const BoundingSphere target{glm::vec3(0.0f, 1.5f, 0.0f) - glm::vec3(stage.shading.anchor), 4.0f};
    RayCounts counts;
    FloorLight light;
    for (const LitPlace& place : cast_light_rays(lighting, target, 1 << 17, counts)) {
        if (place.instance != 0 || place.behind) continue;
        if (place_triangle(stage.shading.instances[0], place.primitive).normal.y < 0.9f) continue;
        light.reflected += place.reflected;
        light.rays += 1.0;
    }
    return light;
}

TEST(OpeningLight, LightRaysComeThroughThem) {
    for (const bool sun : {false, true}) {
        Scene scene = make_room_with_window();
        const glm::dvec3 down = glm::normalize(glm::dvec3(-1.0, -0.6, 0.0));
        if (sun) {
            add_light(scene, Light::Kind::directional, glm::dvec3(5e4), glm::dvec3(0.0),
                      glm::quatLookAt(down, glm::dvec3(0.0, 1.0, 0.0)));
        }
        const Stage stage(std::move(scene));
        const SkyOpenings openings = find_openings(stage).value();
        const FloorLight anywhere = light_floor(stage, nullptr), through = light_floor(stage, &openings);
        EXPECT_NEAR(through.reflected, anywhere.reflected, 0.1 * anywhere.reflected);
        EXPECT_GT(through.rays, 10.0 * anywhere.rays);
        // The sill, as thick as the wall, is in the way.
        const double lit = 0.5 * 5e4 * -down.x * (1.0 - 0.6 * wall);
        if (sun) {
            EXPECT_NEAR(through.reflected, lit, 0.02 * lit);
        }
    }
}

}  // namespace
}  // namespace aleph
