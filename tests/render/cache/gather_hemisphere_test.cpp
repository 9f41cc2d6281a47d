// Gathers in rooms: at smooth-shaded facets, in edges, and their estimate of their own noise.

#include "tests/support/indirect_pictures.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

/// A sphere with vertex normals in the middle of a lit room, 6 m wide.
struct BallInRoom : Gathering {
    static constexpr double radius = 0.5;

    static Scene make_scene(int segments) {
        Scene scene;
        const int white = add_lambert(scene, glm::dvec3(0.6), glm::dvec3(0.0), true);
        Shape ball{.kind = Shape::Kind::sphere, .radius = radius, .segments = segments};
        add_mesh(scene, make_shape_mesh(ball, white));
        add_mesh(scene, make_box(glm::dvec3(6.0), white));
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 corner(i & 1 ? 1.5 : -1.5, i & 2 ? 1.5 : -1.5, i & 4 ? 1.5 : -1.5);
            add_light(scene, Light::Kind::point, glm::dvec3(10.0), corner);
        }
        return scene;
    }

    explicit BallInRoom(int segments) : Gathering(make_scene(segments)) {}

    /// The mean of gathers at the facet that is met from this direction, which is unit.
    IrradianceSample gather_from(const glm::vec3& from) {
        const Ray ray{from * 2.0f - glm::vec3(stage.shading.anchor), -from};
        const Hit hit = task.tracer.intersect(ray);
        SurfacePoint point = make_surface_point(stage.shading, hit, ray.direction);
        IrradianceSample mean;
        constexpr std::uint32_t count = 16;
        for (std::uint32_t seed = 0; seed < count; ++seed) {
            const IrradianceSample sample = gather(point, {choose_strata(512), {seed, 0, 0, 0}});
            mean.irradiance += sample.irradiance / static_cast<float>(count);
            mean.nearest_distance = std::min(mean.nearest_distance, sample.nearest_distance);
            mean.space.headroom = std::min(mean.space.headroom, sample.space.headroom);
            for (const float clear : sample.space.sectors)
                mean.space.sectors[0] = std::min(mean.space.sectors[0], clear);
            mean.gradients.translation[1] += sample.gradients.translation[1] / static_cast<float>(count);
        }
        return mean;
    }
};

TEST(GatherHemisphere, IC17_CoarseSmoothMeshesHaveTheRadiiOfFineOnes) {
    BallInRoom fine(512);
    for (const int segments : {12, 48}) {
        BallInRoom coarse(segments);
        for (int i = 0; i < 24; ++i) {
            const float y = 0.9f - 1.8f * (static_cast<float>(i) + 0.5f) / 24.0f, phi = 2.4f * static_cast<float>(i);
            const float across = std::sqrt(1.0f - y * y);
            const glm::vec3 from(across * std::cos(phi), y, across * std::sin(phi));
            const IrradianceSample expected = fine.gather_from(from), found = coarse.gather_from(from);
            SCOPED_TRACE(testing::Message() << segments << " segments, point " << i);
            EXPECT_NEAR(found.irradiance.y, expected.irradiance.y, 0.05f * expected.irradiance.y);
            EXPECT_NEAR(found.nearest_distance, expected.nearest_distance, 0.05f * expected.nearest_distance);
            EXPECT_NEAR(found.space.sectors[0], expected.space.sectors[0], 0.15f * expected.space.sectors[0]);
            EXPECT_EQ(std::isinf(found.space.headroom), std::isinf(expected.space.headroom));
            // The facet's own horizon is no edge that moves: the gradient stays that of the room.
            const float gradient = glm::length(found.gradients.translation[1] - expected.gradients.translation[1]);
            EXPECT_LT(gradient, 0.1f * expected.irradiance.y);
        }
    }
}

TEST(GatherHemisphere, IC17_NoRaysBelowTheTrueSurface) {
    Scene scene;
    add_mesh(scene, make_faceted_sphere(2.0, 32, add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true)));
    add_light(scene, Light::Kind::point, glm::dvec3(1.0), {0.5, 1.0, 0.2});
    Gathering ball(std::move(scene));
    SurfacePoint point = make_point(glm::vec3(0.0f), up);
    point.normal = glm::normalize(glm::vec3(1.0f, 1.0f, 0.0f));
    const IrradianceSample sample = ball.gather(point, {choose_strata(1024)});
    // At 45 degrees, (1 + cos) / 2 of the cosine-weighted hemisphere is above the surface.
    EXPECT_NEAR(static_cast<double>(ball.task.counts.gather), 1024 * 0.5 * (1.0 + std::sqrt(0.5)), 16.0);
    for (const Ray& ray : ball.scratch.rays) EXPECT_GT(ray.direction.y, 0.0f);
    EXPECT_NEAR(sample.nearest_distance, 2.0f, 0.02f);
}

/// A box of single walls, open in front.
Scene make_open_box() {
    Scene scene;
    const Mesh wall = make_quad(5.5, 5.5, add_lambert(scene, glm::dvec3(0.7), glm::dvec3(0.0), true));
    add_mesh(scene, wall, {0.0, 0.0, -2.75});
    add_mesh(scene, wall, {0.0, 2.75, 0.0}, z_to_down);
    add_mesh(scene, wall, {0.0, -2.75, 0.0}, z_to_up);
    add_mesh(scene, wall, {-2.75, 0.0, 0.0}, turn_about_y(pi / 2));
    add_mesh(scene, wall, {2.75, 0.0, 0.0}, turn_about_y(-pi / 2));
    add_light(scene, Light::Kind::point, glm::dvec3(10.0), {0.0, 0.0, 0.0});
    return scene;
}

TEST(Gather, MC29_PointsOnTheEdgeWhereTwoWallsMeet) {
    Gathering box(make_open_box());
    const auto gather = [&](int wall, int triangle, float u, float v) {
        const SurfacePoint point = make_surface_point(box.stage.shading, Hit{wall, triangle, u, v, 1.0f}, true);
        return luminance(box.gather(point, {choose_strata(256), {1, 2, 3, 4}}).irradiance);
    };
    for (int wall = 0; wall < 5; ++wall) {
        for (int triangle = 0; triangle < 2; ++triangle) {
            for (const float along : {0.2f, 0.335f, 0.6f}) {
                const float rest = 1.0f - along, inside = 0.003f;
                EXPECT_GT(gather(wall, triangle, 0.0f, along), 0.8f * gather(wall, triangle, inside, along));
                EXPECT_GT(gather(wall, triangle, along, 0.0f), 0.8f * gather(wall, triangle, along, inside));
                EXPECT_GT(gather(wall, triangle, along, rest), 0.8f * gather(wall, triangle, along, rest - inside));
            }
        }
    }
}

/// The mean over points. At single points, where light varies smoothly, the estimate is up to twice the spread.
TEST(GatherNoise, TheEstimateIsTheSpreadOverSeeds) {
    Gathering room(make_cluttered_room());
    const SurfacePoint points[] = {make_point({-0.2f, -1.499f, -0.2f}, up), make_point({0.3f, -1.499f, 1.2f}, up),
                                   make_point({1.999f, 0.3f, 0.8f}, {-1.0f, 0.0f, 0.0f}),
                                   make_point({-1.999f, -0.6f, -0.6f}, {1.0f, 0.0f, 0.0f}),
                                   make_point({0.4f, 1.499f, 1.5f}, {0.0f, -1.0f, 0.0f})};
    for (const int samples : {16, 61, 256, 1024}) {
        double ratio = 0.0;
        for (const SurfacePoint& point : points) {
            Mean light, variance;
            for (std::uint32_t seed = 0; seed < 64; ++seed) {
                const IrradianceSample sample = room.gather(point, {choose_strata(samples), {seed, 7, 0, 0}});
                light.add(luminance(sample.irradiance));
                variance.add(static_cast<double>(sample.relative_error) * sample.relative_error);
            }
            const double spread = light.error() * 8.0 / light.mean();
            ratio += std::sqrt(variance.mean()) / spread / 5.0;
        }
        EXPECT_NEAR(ratio, 1.0, 0.3) << samples;
    }
}

TEST(GatherNoise, EdgesOfTheEstimate) {
    Gathering room(make_cluttered_room());
    const auto error_of = [&](int samples) { return room.at({-0.2f, -1.499f, -0.2f}, up, samples).relative_error; };
    EXPECT_TRUE(std::isinf(error_of(1)));
    EXPECT_TRUE(std::isinf(error_of(2)));
    for (int samples = 16; samples < 64; ++samples) {
        EXPECT_TRUE(std::isfinite(error_of(samples))) << samples;
        EXPECT_GE(choose_strata(samples).rows, 2) << samples;
    }
    Scene dark;
    add_mesh(dark, make_faceted_sphere(2.0, 16, add_lambert(dark, glm::dvec3(0.5))));
    EXPECT_EQ(Gathering(std::move(dark)).at(glm::vec3(0.0f), up, 64).relative_error, 0.0f);
}

}  // namespace
}  // namespace aleph
