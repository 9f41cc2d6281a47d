// Rays that leave a surface start above it, by little: they neither meet it again nor start behind other surfaces.

#include "engine/base/sampling.h"
#include "tests/support/scenes/deforming_scenes.h"
#include "tests/support/scenes/render_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

class Directions {
  public:
    float number() { return std::uniform_real_distribution<float>(0.0f, 1.0f)(random_); }
    glm::dvec3 next() {
        const double z = 2.0 * number() - 1.0, angle = 2.0 * std::numbers::pi * number(), w = std::sqrt(1.0 - z * z);
        return {w * std::cos(angle), w * std::sin(angle), z};
    }
    /// About a normal, with density cos/pi.
    glm::vec3 leave(const glm::vec3& normal) {
        const float u = number(), v = number();
        return make_basis(normal).to_world(sample_cosine_hemisphere({u, v}));
    }

  private:
    std::mt19937 random_{17};
};

/// A ball of flat facets at a place, with a camera three radii before it.
struct Ball {
    Ball(double ball_radius, double distance, bool turned)
        : radius(ball_radius),
          center(distance * glm::normalize(glm::dvec3(1.0, 0.7, -0.4))),
          stage(make(ball_radius, center, turned), 8, 8) {}

    static Scene make(double radius, const glm::dvec3& center, bool turned) {
        Scene scene;
        const glm::dquat turn = glm::angleAxis(0.7, glm::normalize(glm::dvec3(1.0, 2.0, 3.0)));
        add_mesh(scene, make_faceted_sphere(radius, 48, add_lambert(scene, glm::dvec3(0.5))), center,
                 turned ? turn : no_turn);
        const glm::dvec3 eye = center + glm::dvec3(0.0, 0.0, 3.0 * radius);
        add_camera(scene, eye, eye - glm::dvec3(0.0, 0.0, 1.0));
        scene.cameras.back().near_plane = std::min(1e-4, 0.01 * radius);
        return scene;
    }
    glm::vec3 relative(const glm::dvec3& world) const { return glm::vec3(world - stage.shading.anchor); }

    double radius;
    glm::dvec3 center;
    Stage stage;
};

template <class Check>
void for_every_ball(const Check& check) {
    for (const double radius : {1e-5, 1e-3, 1.0, 1e3, 1e6}) {
        for (const double distance : {0.0, 1e2, 1e6}) {
            for (const bool turned : {false, true}) {
                SCOPED_TRACE(testing::Message() << "radius " << radius << " at " << distance << " turned " << turned);
                const Ball ball(radius, distance, turned);
                check(ball);
            }
        }
    }
}

TEST(SelfHits, RC04_SecondRaysDoNotMeetTheirOwnSurface) {
    for_every_ball([](const Ball& ball) {
        Directions random;
        Tracer tracer(ball.stage.rays);
        int outside = 0, outside_again = 0, inside = 0, lost = 0;
        for (int i = 0; i < 4000; ++i) {
            const glm::dvec3 from = ball.center + 3.0 * ball.radius * random.next();
            const glm::dvec3 target = ball.center + 0.7 * ball.radius * random.next();
            const Ray rays[] = {
                {ball.relative(from), glm::vec3(glm::normalize(target - from))},
                {ball.relative(ball.center + 0.5 * ball.radius * random.next()), glm::vec3(random.next())}};
            for (const Ray& ray : rays) {
                const Hit hit = tracer.intersect(ray);
                if (hit.instance == no_index) continue;
                const SurfacePoint point = make_surface_point(ball.stage.shading, hit, ray.direction);
                const Hit next = tracer.intersect({point.ray_origin(), random.leave(point.geometric)});
                if (&ray == &rays[0]) {  // from outside a convex body nothing of it can be met
                    ++outside;
                    outside_again += next.instance != no_index;
                } else {  // from inside another facet must be
                    ++inside;
                    lost += next.instance == no_index || next.primitive == hit.primitive;
                }
            }
        }
        EXPECT_GT(outside, 2000);
        EXPECT_EQ(inside, 4000);
        EXPECT_LT(outside_again, 0.005 * outside);
        EXPECT_LT(lost, 0.005 * inside);
    });
}

TEST(SelfHits, RC04_FarFromTheOriginOfTheFlatTreeTooSecondRaysDoNotMeetTheirOwnSurface) {
    // The camera and the anchor are beside the ball, the origin of the flat tree is 40 m away.
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5));
    const glm::dvec3 others(24.3, -22.9, 25.1), turn(1.0, 2.0, 3.0);
    add_mesh(scene, make_faceted_sphere(0.1, 48, white), {0.0, 0.0, 0.0}, glm::angleAxis(0.7, glm::normalize(turn)));
    for (const double y : {0.0, 1.0}) add_mesh(scene, make_quad(1.0, 1.0, white), others + glm::dvec3(0.0, y, 0.0));
    add_camera(scene, {0.0, 0.0, 0.3}, {0.0, 0.0, 0.0});
    const Stage stage(std::move(scene), 8, 8);
    ASSERT_TRUE(stage.rays.is_flat(0));
    ASSERT_GT(glm::length(stage.rays.flat_origin() - stage.rays.anchor()), 30.0);
    Directions random;
    Tracer tracer(stage.rays);
    int again = 0;
    for (int i = 0; i < 4000; ++i) {
        const glm::vec3 from(0.3 * random.next()), target(0.07 * random.next());
        const Ray ray{from - glm::vec3(stage.shading.anchor), target - from};
        const Hit hit = tracer.intersect(ray);
        ASSERT_EQ(hit.instance, 0);
        const SurfacePoint point = make_surface_point(stage.shading, hit, ray.direction);
        const Hit next = tracer.intersect({point.ray_origin(), random.leave(point.geometric)});
        again += next.instance == 0;
        EXPECT_LT(point.offset, 1e-4f);
    }
    EXPECT_LT(again, 20);
}

TEST(SelfHits, RC04_TheFurnaceHoldsAtEverySize) {
    // Inside a closed body of radiance 1 and albedo .5 the light of all orders adds up to 2.
    for_every_ball([](const Ball& ball) {
        constexpr int paths = 2000, orders = 20;
        Directions random;
        Tracer tracer(ball.stage.rays);
        double sum = 0.0;
        for (int path = 0; path < paths; ++path) {
            Ray ray{ball.relative(ball.center + 0.5 * ball.radius * random.next()), glm::vec3(random.next())};
            double weight = 1.0;
            for (int order = 0; order < orders; ++order, weight *= 0.5) {
                const Hit hit = tracer.intersect(ray);
                if (hit.instance == no_index) break;
                sum += weight;
                const SurfacePoint point = make_surface_point(ball.stage.shading, hit, ray.direction);
                ray = {point.ray_origin(), random.leave(point.geometric)};
            }
        }
        EXPECT_NEAR(sum / paths, 2.0, 0.02);
    });
}

TEST(SelfHits, RC05_OffsetsAreSmallForSmallObjects) {
    // A millimetre ball and a floor of a few, seen from nearby.
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    add_mesh(scene, make_faceted_sphere(1e-3, 48, white), {0.0, 1e-3, 0.0});
    add_mesh(scene, make_quad(12e-3, 12e-3, white), {0.0, 0.0, 0.0}, z_to_up);
    add_camera(scene, {0.0, 2e-3, 6e-3}, {0.0, 1e-3, 0.0});
    const Stage stage(std::move(scene), 64, 48);
    const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
    float largest = 0.0f;
    int met[2] = {};
    for (const auto [x, y] : all_pixels(64, 48)) {
        if (hits.hits(x, y).instance == no_index) continue;
        ++met[hits.hits(x, y).instance];
        largest = std::max(largest, make_pixel_surface(stage.shading, stage.view, hits, x, y).point.offset);
    }
    EXPECT_GT(met[0], 100);
    EXPECT_GT(met[1], 100);
    EXPECT_LT(largest, 1e-6f);
    EXPECT_GT(largest, 0.0f);
}

/// A floor of a kilometre, and 1 mm above it a box with walls of 0.1 mm around a lamp.
Scene make_sealed_lamp(const glm::dvec3& eye, double fov) {
    Scene scene;
    const int white = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int black = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true);
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1e6));
    constexpr double half = 0.5, bottom = 1e-3, wall = 1e-4;
    add_mesh(scene, make_quad(1000.0, 1000.0, white), {0.0, 0.0, 0.0}, z_to_up);
    const glm::dvec3 middle(0.0, bottom + half, 0.0);
    for (int axis = 0; axis < 3; ++axis) {
        for (const double side : {-1.0, 1.0}) {
            glm::dvec3 size(2.0 * half), place = middle;
            size[axis] = wall;
            place[axis] += side * (half - 0.5 * wall);
            add_mesh(scene, make_box(size, black), place);
        }
    }
    add_mesh(scene, make_box({0.8, 0.8, 0.8}, lamp), middle);
    add_camera(scene, eye, middle, fov);
    return scene;
}

TEST(SelfHits, RC06_NoLightComesThroughThinWalls) {
    for (const double distance : {2.0, 60.0, 400.0}) {
        SCOPED_TRACE(distance);
        const glm::dvec3 eye = distance * glm::normalize(glm::dvec3(0.4, 0.3, 1.0));
        const Stage stage(make_sealed_lamp(eye, 2.0 / distance), 48, 36);
        const ShadedFrame out = shade(stage, plain_settings(0.2, 64));
        const SampleHits hits = cast_centers(stage.rays, stage.view, nullptr);
        int box = 0, floor = 0;
        for (std::size_t i = 0; i < out.color.size(); ++i) {
            ASSERT_EQ(out.color.pixels[i], Rgb(0.0f)) << i;
            const int instance = hits.hits.pixels[i].instance;
            floor += instance == 0;
            box += instance >= 1 && instance <= 6;
        }
        EXPECT_GT(floor, 200);
        EXPECT_GT(box, 200);
    }
}

TEST(SelfHits, RC06_RaysFromTheFloorUnderTheBoxDoNotEnterIt) {
    const Stage stage(make_sealed_lamp({1.0, 1.0, 3.0}, 0.6), 8, 8);
    Directions random;
    Tracer tracer(stage.rays);
    for (int i = 0; i < 20000; ++i) {
        Ray ray{glm::vec3(random.number() - 0.5f, 0.5e-3f, random.number() - 0.5f), glm::vec3(0.0f, -1.0f, 0.0f)};
        ray.origin -= glm::vec3(stage.shading.anchor);
        const Hit hit = tracer.intersect(ray);
        ASSERT_EQ(hit.instance, 0);
        const SurfacePoint point = make_surface_point(stage.shading, hit, ray.direction);
        const Hit next = tracer.intersect({point.ray_origin(), random.leave(point.geometric)});
        ASSERT_NE(next.instance, 7) << "the lamp";
    }
}

TEST(SelfHits, RC12_APointOfATriangleWithoutAreaHasNormals) {
    Scene scene;
    Mesh mesh = make_quad(2.0, 2.0, no_index);
    mesh.normals.assign(4, glm::vec3(0.0f));
    mesh.triangles.emplace_back(0, 0, 0);
    mesh.triangles.emplace_back(0, 0, 1);
    mesh.positions.insert(mesh.positions.end(), {{0.0f, 0.0f, 1.0f}, {3e-13f, 0.0f, 1.0f}, {0.0f, 3e-13f, 1.0f}});
    mesh.normals.resize(7, glm::vec3(0.0f));
    mesh.uv[0].resize(7);
    mesh.triangles.emplace_back(4, 5, 6);  // 5e-26 m2
    add_mesh(scene, mesh);
    const Stage stage(std::move(scene), 8, 8);
    const glm::vec3 direction(0.6f, 0.0f, -0.8f);
    for (int primitive = 0; primitive < 5; ++primitive) {
        Hit hit;
        hit.instance = 0;
        hit.primitive = primitive;
        hit.u = hit.v = 0.25f;
        const SurfacePoint point = make_surface_point(stage.shading, hit, direction);
        EXPECT_NEAR(glm::length(point.geometric), 1.0f, 1e-6f) << primitive;
        EXPECT_LT(glm::dot(point.geometric, direction), 0.0f);
        EXPECT_EQ(point.normal, point.geometric);
        EXPECT_GT(point.offset, 0.0f);
        EXPECT_LT(point.offset, 1e-5f);
    }
}

TEST(SelfHits, RC08_BoundsOfPointsThatAreNotFiniteAreFinite) {
    const float bad_values[] = {float_nan, float_infinity, -1e30f};
    for (const float bad : bad_values) {
        Scene scene;
        add_mesh(scene, make_quad(2.0, 2.0, no_index));
        add_mesh(scene, make_quad(1.0, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))), {0.0, 0.0, 1.0});
        add_cache(scene, 1, {0.0, 1.0}, [&](const glm::vec3& p, std::size_t sample) {
            return sample == 1 && p.x > 0.0f ? glm::vec3(p.x, bad, p.z) : p;
        });
        const Stage stage(std::move(scene), 8, 8, 1.0);
        EXPECT_EQ(stage.lights.count(), 0) << bad;  // no ray can meet it
        EXPECT_NEAR(scene_radius(stage.shading), std::sqrt(2.0f), 1e-5f) << bad;
    }
}

}  // namespace
}  // namespace aleph
