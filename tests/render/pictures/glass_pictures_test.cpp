// Glass with a known appearance: slabs, balls and sheets, from outside and inside, one in the other.
// Small pictures of authored scenes with every kind of surface, for the sanitizer too.

#include "engine/load/load_scene.h"
#include "render/frame/sequence.h"
#include "render/path/path.h"
#include "tests/support/lobes.h"
#include "tests/support/paths.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

double reflectance(double cosine, double ratio) {
    const double t = std::sqrt(1.0 - (1.0 - cosine * cosine) / (ratio * ratio));
    const double s = (cosine - ratio * t) / (cosine + ratio * t), p = (ratio * cosine - t) / (ratio * cosine + t);
    return 0.5 * (s * s + p * p);
}

/// A lamp of radiance 1 that covers what lies behind z = -3.
void add_lamp_behind(Scene& scene) {
    add_mesh(scene, make_quad(200.0, 200.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))), {0.0, 0.0, -3.0});
}

/// Radiance that arrives from a direction at the camera, by paths.
Mean look(const Stage& stage, const glm::dvec3& eye, const glm::dvec3& direction, int count, int depth = 64,
          std::uint32_t seed = 0) {
    const glm::vec3 towards(glm::normalize(direction)), origin(eye - stage.shading.anchor);
    RayTask task(stage.rays);
    PathState state;
    state.left = {0, depth};
    Mean mean;
    const Hit hit = task.tracer.intersect({origin, towards});
    if (hit.instance == no_index) {
        ADD_FAILURE() << "the ray hits nothing";
        return mean;
    }
    const ViewedSurface surface =
        view_surface(stage.shading, make_surface_point(stage.shading, hit, towards), -towards, {});
    const Rgb loss = Media().attenuation(surface.point, surface.material);
    for (int i = 0; i < count; ++i) {
        RandomStream random({1 + seed, 0, 0, static_cast<std::uint32_t>(i)});
        const Rgb light = scatter_light(stage.lighting(), task, surface, state, random);
        mean.add(light.x * std::exp(-loss.x * hit.distance));
    }
    return mean;
}

void expect_light(const Stage& stage, const glm::dvec3& eye, const glm::dvec3& direction, double expected) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean found = look(stage, eye, direction, trial.times(30'000), 64, trial.seed);
        trial.near(found, expected, 1e-4);
        EXPECT_NEAR(found.mean(), expected, 0.01 * expected);
    }));
}

/// In a furnace: 1. The facets of a ball and the offsets of rays leave a little.
void expect_nothing(const Stage& stage, const glm::dvec3& eye, const glm::dvec3& direction) {
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean seen = look(stage, eye, direction, trial.times(2000), 1000, trial.seed);
        trial.near(seen, 1.0, 2e-3);
        EXPECT_NEAR(seen.mean(), 1.0, 0.01);
    }));
}

TEST(GlassPictures, MC25_SlabBeforeALamp) {
    constexpr double thick = 0.5;
    for (const bool colored : {false, true}) {
        Scene scene;
        add_mesh(scene, make_box({60.0, 60.0, thick}, add_glass(scene, 1.5, thick, colored ? 0.8 : 0.0)));
        add_lamp_behind(scene);
        const Stage stage(std::move(scene));
        for (const double cosine : {1.0, 0.8, 0.5}) {
            const double r = reflectance(cosine, 1.5), inside = std::sqrt(1.0 - (1.0 - cosine * cosine) / 2.25);
            const double a = colored ? std::pow(0.5, thick / inside / 0.8) : 1.0;
            // All reflections inside: the sum of (1 - r)^2 a (r a)^(2 k).
            const double expected = (1.0 - r) * (1.0 - r) * a / (1.0 - r * r * a * a);
            if (!colored) {
                EXPECT_NEAR(expected, (1.0 - r) / (1.0 + r), 1e-12);
            }
            const double sine = std::sqrt(1.0 - cosine * cosine);
            expect_light(stage, {0.0, 0.0, 2.0}, {sine, 0.0, -cosine}, expected);
        }
    }
}

TEST(GlassPictures, MC25_SheetBeforeALamp) {
    Scene scene;
    add_mesh(scene, make_quad(60.0, 60.0, add_glass(scene, 1.5, 0.0)));
    add_lamp_behind(scene);
    const Stage stage(std::move(scene));
    for (const double cosine : {1.0, 0.6, 0.3}) {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        expect_light(stage, {0.0, 0.0, 2.0}, {sine, 0.0, -cosine}, 1.0 - reflectance(cosine, 1.5));
    }
}

/// A lamp that only a straight line through the sheet meets: a turned ray would miss it.
TEST(GlassPictures, MC25_SheetIsSeenThroughStraight) {
    Scene scene;
    add_mesh(scene, make_quad(60.0, 60.0, add_glass(scene, 1.5, 0.0)));
    const glm::dvec3 direction = glm::normalize(glm::dvec3(1.0, 0.3, -0.6));
    const glm::dvec3 eye(0.0, 0.0, 1.0);
    add_mesh(scene, make_quad(0.02, 0.02, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0))), eye + direction * 9.0);
    const Stage stage(std::move(scene));
    expect_light(stage, eye, direction, 1.0 - reflectance(-direction.z, 1.5));
}

/// An environment of radiance 1 all around: clear glass of any shape is invisible.
struct Furnace {
    Scene scene;
    Furnace() { scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(1.0)); }
};

TEST(GlassPictures, MC25_BallInAFurnaceIsInvisible) {
    for (const double ior : {1.5, 0.7, 1.0}) {
        SCOPED_TRACE(ior);
        Furnace furnace;
        add_mesh(furnace.scene, make_faceted_sphere(1.0, 48, add_glass(furnace.scene, ior, 1.0)));
        const Stage stage(std::move(furnace.scene));
        for (const double x : {0.0, 0.31, 0.62, 0.93}) {
            SCOPED_TRACE(x);
            expect_nothing(stage, {x, 0.07, 3.0}, {0.0, 0.0, -1.0});
        }
        expect_nothing(stage, {0.2, 0.1, 0.3}, {0.3, 0.5, -1.0});  // the camera is in the ball
    }
}

/// Interpolated normals refract some light into directions that the facets do not allow: a little is lost, none added.
TEST(GlassPictures, MC25_BallWithInterpolatedNormals) {
    Furnace furnace;
    Mesh ball = make_faceted_sphere(1.0, 64, add_glass(furnace.scene, 1.5, 1.0));
    ball.normals = ball.positions;
    add_mesh(furnace.scene, std::move(ball));
    const Stage stage(std::move(furnace.scene));
    for (const double x : {0.0, 0.31, 0.62, 0.93, 0.985}) {
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean seen = look(stage, {x, 0.07, 3.0}, {0.0, 0.0, -1.0}, trial.times(2000), 1000, trial.seed);
            trial.at_most(seen, 1.001);
            EXPECT_GE(seen.mean(), 0.95);
        })) << x;
    }
}

TEST(GlassPictures, MC25_CameraInsideGlass) {
    // Half a metre below the surface of a thick block, looking out at the lamp.
    Scene scene;
    add_mesh(scene, make_box({60.0, 60.0, 2.0}, add_glass(scene, 1.5, 2.0, 0.8)));
    add_lamp_behind(scene);
    const Stage stage(std::move(scene));
    const double sine = 0.4, cosine = std::sqrt(1.0 - sine * sine), r = reflectance(cosine, 1.0 / 1.5);
    const double to_wall = std::pow(0.5, 0.5 / cosine / 0.8), across = std::pow(0.5, 2.0 / cosine / 0.8);
    const double expected = to_wall * (1.0 - r) / (1.0 - r * r * across * across);
    expect_light(stage, {0.0, 0.0, -0.5}, {sine, 0.0, -cosine}, expected);
    // Beyond the critical angle the walls reflect all; the block is 60 m wide and its loss eats the rest.
    EXPECT_LT(look(stage, {0.0, 0.0, -0.5}, {0.9, 0.0, -0.3}, 1000).mean(), 1e-3);
}

TEST(GlassPictures, MC25_SlabInABlock) {
    // A layer of ior 1.5 in water of ior 1.33, in front of the lamp, all with parallel faces.
    Scene scene;
    add_mesh(scene, make_box({80.0, 80.0, 2.0}, add_glass(scene, 1.33, 2.0)));
    add_mesh(scene, make_box({60.0, 60.0, 0.5}, add_glass(scene, 1.5, 0.5)));
    add_lamp_behind(scene);
    const Stage stage(std::move(scene));
    for (const double cosine : {1.0, 0.6}) {
        const double sine = std::sqrt(1.0 - cosine * cosine);
        const double in_water = std::sqrt(1.0 - sine * sine / (1.33 * 1.33));
        const double outer = reflectance(cosine, 1.33), inner = reflectance(in_water, 1.5 / 1.33);
        // Plates without loss in a row: the sums of r / (1 - r) add up.
        const double sum = 2.0 * outer / (1.0 - outer) + 2.0 * inner / (1.0 - inner);
        expect_light(stage, {0.0, 0.0, 2.0}, {sine, 0.0, -cosine}, 1.0 / (1.0 + sum));
    }
}

TEST(GlassPictures, MC25_BallInABlockInAFurnace) {
    Furnace furnace;
    add_mesh(furnace.scene, make_box(glm::dvec3(3.0), add_glass(furnace.scene, 1.33, 3.0)));
    add_mesh(furnace.scene, make_faceted_sphere(1.0, 48, add_glass(furnace.scene, 1.5, 1.0)));
    const Stage stage(std::move(furnace.scene));
    for (const glm::dvec3& direction : {glm::dvec3(0.03, 0.02, -1.0), glm::dvec3(0.15, 0.1, -1.0)}) {
        expect_nothing(stage, {0.1, 0.2, 4.0}, direction);
    }
}

TEST(GlassPictures, MC25_FrameOfASlab) {
    Scene scene;
    add_mesh(scene, make_box({60.0, 60.0, 0.5}, add_glass(scene, 1.5, 0.5, 0.8)));
    add_lamp_behind(scene);
    add_camera(scene, {0.0, 0.0, 2.0}, {0.0, 0.0, 0.0}, 0.1);
    const Stage stage(std::move(scene), 24, 24);
    const double r = 0.04, a = std::pow(0.5, 0.5 / 0.8), expected = (1.0 - r) * (1.0 - r) * a / (1.0 - r * r * a * a);
    for (const Integrator integrator : {Integrator::path, Integrator::cache}) {
        RenderSettings settings = plain_settings(0.3, 64);
        settings.light.integrator = integrator;
        EXPECT_TRUE(holds([&](Trial& trial) {
            Mean mean;
            for (std::uint32_t run = 0; run < trial.times(16u); ++run) {
                settings.seed = run + trial.seed;
                for (const Rgb& pixel : shade(stage, settings).color.pixels) mean.add(pixel.x);
            }
            trial.near(mean, expected, 1e-4);
            EXPECT_NEAR(mean.mean(), expected, 0.01 * expected);
        })) << (integrator == Integrator::path ? "path" : "cache");
    }
}

/// Renders a frame with its maps; every pixel is finite, and there is light.
void expect_picture(const std::string& name, std::int64_t frame, const RenderSettings& settings) {
    const Scene scene = load_scene(source_folder() / "scenes" / name);
    Sequence sequence(scene, settings);
    const FrameOutput output = sequence.render(frame, {.maps = true, .progress = {}});
    float brightest = 0.0f;
    for (const Rgb& pixel : output.shaded.color.pixels) {
        ASSERT_TRUE(std::isfinite(luminance(pixel))) << name;
        brightest = std::max(brightest, luminance(pixel));
    }
    EXPECT_GT(brightest, 0.0f) << name;
}

TEST(SmallPictures, WithTheCache) {
    RenderSettings settings = quick_settings(40, 30);
    settings.sampling.spp = 2;
    settings.cache.gather = 16;
    expect_picture("pool/scene.json", 12, settings);
    apply_settings(settings, {{"vision", "castle"}}, "test");
    expect_picture("cornell/scene.json", 10, settings);
}

TEST(SmallPictures, OfPathsWithEveryMaterial) {
    RenderSettings settings = quick_settings(24, 16);
    settings.light.integrator = Integrator::path;
    settings.sampling.spp = 4;
    settings.light.bounces = 2;
    for (const char* name : {"metal_ball", "mirror", "glass_ball", "brick_wall", "curtain", "layers"})
        expect_picture(std::string("materials/") + name + ".json", 20, settings);
}

}  // namespace
}  // namespace aleph
