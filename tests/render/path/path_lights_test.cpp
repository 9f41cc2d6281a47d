// Lamps that touch a surface, lie in its plane or cast a penumbra, and very many lights, against closed forms.
// Blended surfaces: what the camera sees, their shadow, and lamps that are blended themselves.

#include "tests/support/path_estimates.h"
#include "tests/support/penumbra.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

ViewedSurface make_floor(const glm::vec3& position, float albedo = 1.0f) {
    return {make_point(position, up), make_lambert(albedo), up};
}

/// Light of a lamp of radiance 1 on a white floor below it: its form factor, within 1 %, and never above 1.
void expect_form_factor(Scene scene, double expected, int samples, const Estimator& estimator, double slack = 0.0) {
    const Stage stage(std::move(scene));
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean found = estimate(stage, make_floor(glm::vec3(0.0f)), trial.times(samples), estimator, trial.seed);
        EXPECT_NEAR(found.mean(), expected, 0.01 * expected);
        trial.at_most(found, 1.0 + slack);
    }));
}

TEST(PathLights, MC10_ADiscAtAnyDistanceHasItsFormFactor) {
    for (const double distance : {1.0, 0.1, 1e-3}) {
        SCOPED_TRACE(distance);
        Scene scene;
        const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
        add_mesh(scene, make_disc_facing_down(0.5f, 128, lamp), {0.0, distance, 0.0});
        expect_form_factor(std::move(scene), 0.25 / (0.25 + distance * distance), 4000, by_paths(1, 1), 1e-5);
    }
}

TEST(PathLights, MC10_ASquareNearbyIsSampledBySolidAngle) {
    // Two triangles: no ray has to find them by chance, so direct light alone has the form factor.
    for (const double distance : {1.0, 0.1, 1e-3}) {
        SCOPED_TRACE(distance);
        Scene scene;
        add_lamp(scene, 1.0, glm::dvec3(1.0), {0.0, distance, 0.0});
        expect_form_factor(std::move(scene), 4.0 * corner_factor(0.5, 0.5, distance), 40'000, by_paths(0, 1));
    }
}

TEST(PathLights, ALampBehindAPaneIsSeenByTheLastRayToo) {
    Scene scene;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    add_mesh(scene, make_disc_facing_down(0.5f, 128, lamp), {0.0, 0.2, 0.0});
    scene.materials.push_back(
        {.gloss = {.metallic = 0.0, .roughness = 0.0}, .glass = {.transmission = 1.0}, .double_sided = true});
    add_mesh(scene, make_quad(9.0, 9.0, lamp + 1), {0.0, 0.1, 0.0}, z_to_down);
    const Stage stage(std::move(scene));
    // The share that the pane passes, over directions to the disc.
    RayTask task(stage.rays);
    double expected = 0.0;
    constexpr int side = 200;
    for (int i = 0; i < side * side; ++i) {
        const glm::vec2 u((static_cast<float>(i % side) + 0.5f) / side, (static_cast<float>(i / side) + 0.5f) / side);
        const glm::vec3 direction = make_basis(up).to_world(sample_cosine_hemisphere(u));
        const float distance = 0.2f / direction.y;
        if (glm::length(glm::vec2(direction.x, direction.z)) * distance > 0.5f) continue;
        const Ray ray{glm::vec3(0.0f, 1e-6f, 0.0f), direction, 0.0f, 0.99f * distance};
        expected += find_transmittance(stage.lighting(), task, ray).x / (side * side);
    }
    EXPECT_TRUE(holds([&](Trial& trial) {
        const Mean found = estimate(stage, make_floor(glm::vec3(0.0f)), trial.times(20000), by_paths(0, 9), trial.seed);
        EXPECT_LT(found.error(), 0.01 * expected);
        trial.near(found, expected, 2e-3 * expected);
    }));
}

TEST(PathLights, MC10_MC11_ALampInThePlaneOfThePointIsDark) {
    // At distance 0 the point lies in the lamp: light leaves downwards, the surface sees upwards.
    for (const glm::dquat& turn : {z_to_down, no_turn}) {
        for (const glm::dvec3& at : {glm::dvec3(0.0), glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 0.0, 3.0)}) {
            Scene scene;
            add_lamp(scene, 1.0, glm::dvec3(1.0), at, turn);
            const Stage stage(std::move(scene));
            for (const int bounces : {0, 1}) {
                const Mean found = estimate(stage, make_floor(glm::vec3(0.0f)), 500, by_paths(bounces, 2));
                ASSERT_TRUE(std::isfinite(found.mean()));
                EXPECT_LE(found.mean(), 1.0);
                if (turn == z_to_down) {
                    EXPECT_LT(found.mean(), 1e-5) << at.x << " " << at.z;
                }
            }
        }
    }
}

TEST(PathLights, MC11_TrianglesWithoutAreaGiveNoLightAndTakeNone) {
    Scene scene;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1.0));
    Mesh mesh = make_quad(1.0, 1.0, lamp);
    const auto base = static_cast<unsigned>(mesh.positions.size());
    for (const float x : {0.0f, 0.2f, 0.4f}) {
        mesh.positions.emplace_back(x, 0.0f, 0.0f);
        if (!mesh.normals.empty()) mesh.normals.push_back(mesh.normals[0]);
        if (!mesh.uv[0].empty()) mesh.uv[0].push_back(mesh.uv[0][0]);
    }
    mesh.triangles.emplace_back(base, base + 1, base + 2);
    mesh.triangles.emplace_back(base, base, base);
    add_mesh(scene, mesh, {0.0, 1.0, 0.0}, z_to_down);
    Mesh nothing = make_quad(1.0, 1.0, lamp);
    for (glm::vec3& p : nothing.positions) p.x = 0.0f;
    add_mesh(scene, nothing, {0.0, 1.0, 0.0}, z_to_down);
    const Stage stage(std::move(scene));
    EXPECT_EQ(stage.lights.count(), 1);
    const double expected = 4.0 * corner_factor(0.5, 0.5, 1.0);
    EXPECT_TRUE(holds([&](Trial& trial) {
        trial.near(estimate(stage, make_floor(glm::vec3(0.0f)), trial.times(4000), by_paths(0, 1), trial.seed),
                   expected, 1e-5);
    }));
}

TEST(PathLights, MC22_ThePenumbraOfASquareLampHasItsClosedForm) {
    const Stage stage(Penumbra::make_scene());
    constexpr int points = 49;
    for (int i = 0; i < points; ++i) {
        const double x = -0.6 + 1.2 * i / (points - 1);
        const double expected = Penumbra::at(x, 0.0);
        for (const auto& [estimator, samples] :
             {std::pair(by_paths(0, 1), 1500), std::pair(by_direct_samples(8), 150)}) {
            EXPECT_TRUE(holds([&](Trial& trial) {
                trial.near(estimate(stage, make_floor({static_cast<float>(x), 0.0f, 0.0f}, 0.6f), trial.times(samples),
                                    estimator, static_cast<std::uint32_t>(i) + trial.seed),
                           expected, 1e-5);
            })) << x;
        }
    }
}

TEST(PathLights, UnlitSurfacesAreSeenInMirrorsAndLightNothing) {
    Scene scene;
    scene.materials[add_lambert(scene, {0.3, 0.6, 0.9})].unlit = true;
    add_mesh(scene, make_quad(9.0, 9.0, 0), {0.0, 1.0, 0.0}, z_to_down);
    const Stage stage(std::move(scene));
    const ViewedSurface mirror{make_point(glm::vec3(0.0f), up), make_metal(0.0f), up};
    RayTask task(stage.rays);
    RandomStream random({3, 0, 0, 0});
    EXPECT_NEAR(by_paths(1, 2)(stage, task, mirror, random).y, 0.6f, 1e-6f);
    EXPECT_EQ(by_paths(1, 2)(stage, task, make_floor(glm::vec3(0.0f)), random), Rgb(0.0f));
}

enum class Crowd { equal, one_bright, one_visible, coincident, far_and_near };

/// A floor under many point lights of the same total, and the sum of what those bring.
std::pair<Scene, double> make_crowd(int count, Crowd crowd) {
    Scene scene;
    const int side = static_cast<int>(std::ceil(std::sqrt(count)));
    double expected = 0.0;
    for (int i = 0; i < count; ++i) {
        glm::dvec3 at(4.0 * (i % side + 0.5) / side - 2.0, 2.0 + 0.3 * std::sin(1.7 * i),
                      4.0 * (i / side + 0.5) / side - 2.0);
        double intensity = 100.0 / count;
        if (crowd == Crowd::coincident) at = {0.5, 2.0, 0.5};
        if (crowd == Crowd::one_bright && i == count * 6 / 10) intensity *= 1e6;
        if (crowd == Crowd::far_and_near) {  // the far ones bring as much as the near one
            at = i == 0 ? glm::dvec3(0.2, 1.0, 0.0) : glm::dvec3(30.0 * at.x, 50.0, 30.0 * at.z);
            intensity = i == 0 ? 2.0 : 5.0;
        }
        const bool is_seen = crowd != Crowd::one_visible || i == count / 3;
        if (crowd == Crowd::one_visible && is_seen) at = {0.3, 1.0, 0.2};
        add_light(scene, Light::Kind::point, glm::dvec3(intensity), at);
        const double d2 = glm::dot(at, at);
        if (is_seen) expected += 0.6 / pi * intensity * at.y / (d2 * std::sqrt(d2));
    }
    if (crowd == Crowd::one_visible) {
        add_mesh(scene, make_quad(20.0, 20.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(0.0), true)),
                 {0.0, 1.4, 0.0}, z_to_up);
    }
    return {std::move(scene), expected};
}

TEST(PathLights, FX14_MC23_AThousandLightsGiveTheirSum) {
    for (const auto& [crowd, samples] :
         {std::pair(Crowd::equal, 4000), std::pair(Crowd::one_bright, 4000), std::pair(Crowd::one_visible, 30'000),
          std::pair(Crowd::coincident, 4000), std::pair(Crowd::far_and_near, 4000)}) {
        SCOPED_TRACE(static_cast<int>(crowd));
        auto [scene, sum] = make_crowd(1000, crowd);
        const Stage stage(std::move(scene));
        const double expected = sum;
        for (const Estimator& estimator : {by_paths(0, 1), by_direct_samples(1)}) {
            EXPECT_TRUE(holds([&, samples = samples](Trial& trial) {
                const Mean found =
                    estimate(stage, make_floor(glm::vec3(0.0f), 0.6f), trial.times(samples), estimator, trial.seed);
                trial.near(found, expected, 1e-5 * expected);
                EXPECT_LT(found.error(), 0.2 * expected);
            }));
        }
    }
}

TEST(PathLights, MC23_AThousandEqualLightsAreAtMostFourTimesAsNoisyAsTen) {
    // Per sample, relative to the mean. Ten lights are compared with one another, so that without shadows they have no
    // noise at all. With a random shadow they have: a sheet of rough glass, whose alpha of one half is left to chance.
    const auto variance_of = [](int count, const Estimator& estimator) {
        Scene scene = make_crowd(count, Crowd::equal).first;
        scene.materials.push_back({.opacity = {.alpha = 0.5, .mode = Opacity::Mode::blend},
                                   .glass = {.transmission = 1.0},
                                   .double_sided = true});
        add_mesh(scene, make_quad(20.0, 20.0, 0), {0.0, 1.0, 0.0}, z_to_up);
        const Mean found = estimate(Stage(std::move(scene)), make_floor(glm::vec3(0.0f), 0.6f), 6000, estimator);
        const double relative = found.error() / found.mean();
        return relative * relative * 6000.0;
    };
    // Each sample is one shadow ray, and visits as many nodes as the tree is deep (LightTree tests).
    for (const auto& [name, estimator] :
         {std::pair("paths", by_paths(0, 1)), std::pair("shared", by_direct_samples(1))}) {
        const double ten = variance_of(10, estimator), thousand = variance_of(1000, estimator);
        EXPECT_GT(ten, 0.5);
        EXPECT_LT(thousand, 4.0 * ten);
        RecordProperty(std::string(name) + "_relative_variance_of_ten_lights", std::to_string(ten));
        RecordProperty(std::string(name) + "_relative_variance_of_1000_lights", std::to_string(thousand));
    }
}

TEST(PathLights, GlossChoosesTheLampsThatItShows) {
    // A grid of lamps overhead, looked at one by one and by the tree. A narrow lobe shows one or two of them.
    for (const int side : {4, 6}) {
        Scene scene;
        for (int i = 0; i < side * side; ++i)
            add_lamp(scene, 0.2, glm::dvec3(5.0), {i % side - 0.5 * side, 2.0, i / side - 0.5 * side});
        const Stage stage(std::move(scene));
        const glm::vec3 view = glm::normalize(glm::vec3(-0.3f, 0.9f, 0.1f));
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up), make_metal(0.1f), view};
        const double expected = estimate(stage, surface, 200'000, by_lobes(1)).mean();
        for (const Estimator& estimator : {by_paths(0, 1), by_direct_samples(1)}) {
            EXPECT_TRUE(holds([&](Trial& trial) {
                const int count = trial.times(4000);
                const Mean found = estimate(stage, surface, count, estimator, trial.seed);
                EXPECT_NEAR(found.mean(), expected, 0.05 * expected);
                const double relative = found.error() / found.mean();
                EXPECT_LT(relative * relative * count, 1.0) << side;
            }));
        }
    }
}

constexpr double alpha = 0.3;

int add_blended(Scene& scene, double albedo, double emission = 0.0) {
    const int material = add_lambert(scene, glm::dvec3(albedo), glm::dvec3(emission), true);
    scene.materials[material].opacity.alpha = alpha;
    scene.materials[material].opacity.mode = Opacity::Mode::blend;
    return material;
}

TEST(BlendRender, AVeilBeforeTheSkyShowsItsShare) {
    Scene scene;
    scene.environment.radiance = Track<glm::dvec3>(glm::dvec3(2.0));
    add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.6)), {0.0, 0.0, -2.0});
    const Stage stage(std::move(scene), 16, 12);
    SampleOptions options;
    options.blended = true;
    EXPECT_TRUE(holds([&](Trial& trial) {
        const ShadedFrame out = shade(stage, path_settings(1, trial.times(64), trial.seed), options);
        Mean coverage, red;
        for (std::size_t i = 0; i < out.color.size(); ++i) {
            coverage.add(out.coverage.pixels[i]);
            red.add(out.color.pixels[i].x);
        }
        trial.near(coverage, alpha);
        trial.near(red, alpha * 0.6 * 2.0 + (1.0 - alpha) * 2.0);
        EXPECT_LT(coverage.error(), 0.01);
    }));
}

TEST(BlendRender, AVeilCastsItsShareOfShadow) {
    Scene scene;
    add_mesh(scene, make_quad(20.0, 20.0, add_blended(scene, 0.0)), {0.0, 1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::directional, glm::dvec3(std::numbers::pi), {0.0, 3.0, 0.0}, z_to_up);
    const Stage stage(std::move(scene));
    RayTask task(stage.rays);
    for (int i = 0; i < 10'000; ++i) {
        const glm::vec3 position(static_cast<float>(i % 100) * 0.01f, 0.0f, static_cast<float>(i / 100) * 0.01f);
        RandomStream random({1, 2, 3, static_cast<std::uint32_t>(i)});
        const ViewedSurface surface{make_point(position, up), make_lambert(1.0f), up};
        ASSERT_NEAR(by_paths(0, 1)(stage, task, surface, random).x, 1.0 - alpha, 1e-6);
    }
}

TEST(BlendRender, LampsWithHolesGiveTheirShareOfLight) {
    // Blended, and masked by a picture of which a quarter is there.
    for (const bool masked : {false, true}) {
        Scene scene;
        add_mesh(scene, make_quad(2.0, 2.0, add_blended(scene, 0.0, 4.0)), {0.0, 1.0, 0.0}, z_to_down);
        if (masked) {
            SceneImage image{.floats = Image<glm::vec4>(2, 2, glm::vec4(1.0f, 1.0f, 1.0f, 0.0f))};
            image.floats(0, 0).w = 1.0f;
            scene.images.push_back(image);
            scene.materials[0].opacity.mode = Opacity::Mode::mask;
            scene.materials[0].opacity.alpha = 1.0;
            scene.materials[0].textures[TextureSlot::base_color] = {
                .image = 0, .wrap_u = Wrap::clamp, .wrap_v = Wrap::clamp, .nearest = true};
        }
        const Stage stage(std::move(scene));
        const ViewedSurface surface{make_point(glm::vec3(0.0f), up), make_lambert(0.7f), up};
        EXPECT_TRUE(holds([&](Trial& trial) {
            const Mean lobes = estimate(stage, surface, trial.times(20'000), by_lobes(1), 1 + trial.seed);
            for (const int bounces : {0, 1}) {
                trial.near(estimate(stage, surface, trial.times(10'000), by_paths(bounces, 1), 2 + trial.seed), lobes);
            }
        }));
    }
}

}  // namespace
}  // namespace aleph
