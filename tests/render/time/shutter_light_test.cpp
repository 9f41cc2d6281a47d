// Indirect light of samples at their own times: where it is read from the frame's, and the picture of the cache against
// the one of paths.

#include "tests/render/time/plate.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/keyed_track.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

TEST(ShutterLight, RidesWithSurfacesThatMoveLessThanTheirRecordsReach) {
    Plate plate;
    plate.scene.nodes[1].transform.translation = move_between({-0.3, 0.0, 0.0}, glm::dvec3(0.0));
    const std::optional<Rgb> found = find_middle(plate.scene, 0.5f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, -0.3, 0.06) << "where the point was at the frame's own time";
    EXPECT_TRUE(find_middle(plate.scene, 0.5f, 0.31f).has_value());
    EXPECT_FALSE(find_middle(plate.scene, 0.5f, 0.29f).has_value());
}

TEST(ShutterLight, ACameraThatMovesChangesNothing) {
    Plate plate;
    plate.scene.nodes[3].transform.translation = move_between({700.0, 5.0, 0.0}, {0.0, 5.0, 0.0});
    const std::optional<Rgb> found = find_middle(plate.scene, 1e-3f, 1e-3f);
    ASSERT_TRUE(found.has_value());
    EXPECT_NEAR(found->x, 0.0, 0.06);
}

TEST(ShutterLight, NothingIsKnownOfSurfacesThatTurnOrAppear) {
    const auto turned = [](double degrees) {
        Plate plate;
        const glm::dquat turn = glm::angleAxis(glm::radians(degrees), glm::dvec3(0.0, 0.0, 1.0));
        plate.scene.nodes[1].transform.rotation.values = {z_to_up, turn * z_to_up};
        return find_middle(plate.scene, 0.2f);
    };
    EXPECT_TRUE(turned(10.0).has_value());
    EXPECT_FALSE(turned(25.0).has_value()) << "a record's normal may differ by 16 degrees";

    Plate plate;
    plate.scene.nodes[1].visible.values = {0.0, 1.0};
    plate.scene.nodes[1].visible.interpolation = Interpolation::step;
    EXPECT_FALSE(find_middle(plate.scene, 1.0f).has_value());
}

TEST(ShutterLight, NothingIsKnownBesideThingsThatMoveOrAppear) {
    const auto moved = [](const glm::dvec3& from, const glm::dvec3& to) {
        Plate plate;
        plate.scene.nodes[2].transform.translation = move_between(from, to);
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_FALSE(moved({0.2, 0.1, 0.0}, {2.0, 0.1, 0.0})) << "it leaves the point";
    EXPECT_FALSE(moved({2.0, 0.1, 0.0}, {0.3, 0.1, 0.0})) << "it arrives";
    EXPECT_TRUE(moved({2.0, 0.1, 0.0}, {3.0, 0.1, 0.0})) << "it is small at this distance";
    EXPECT_TRUE(moved({0.3, 0.1, 0.0}, {0.305, 0.1, 0.0})) << "it hardly moves";

    Plate plate;
    plate.scene.nodes[2].transform.translation = glm::dvec3(0.3, 0.1, 0.0);
    EXPECT_TRUE(find_middle(plate.scene, 0.15f).has_value());
    plate.scene.nodes[2].visible.values = {0.0, 1.0};
    plate.scene.nodes[2].visible.interpolation = Interpolation::step;
    EXPECT_FALSE(find_middle(plate.scene, 0.15f).has_value());
}

TEST(ShutterLight, NothingIsKnownWhereLightsMoveFar) {
    const auto is_known = [](Light::Kind kind, const glm::dvec3& to, double radians) {
        Plate plate;
        add_light(plate.scene, kind, glm::dvec3(5.0), {0.0, 4.0, 0.0}, z_to_up);
        plate.scene.nodes.back().transform.translation = move_between({0.0, 4.0, 0.0}, to);
        const glm::dquat turn = glm::angleAxis(radians, glm::dvec3(0.0, 0.0, 1.0));
        plate.scene.nodes.back().transform.rotation.values = {z_to_up, turn * z_to_up};
        return find_middle(plate.scene, 0.15f).has_value();
    };
    const glm::dvec3 here(0.0, 4.0, 0.0);
    EXPECT_TRUE(is_known(Light::Kind::point, {0.1, 4.0, 0.0}, 1.0)) << "it has no direction";
    EXPECT_FALSE(is_known(Light::Kind::point, {0.5, 4.0, 0.0}, 0.0));
    EXPECT_TRUE(is_known(Light::Kind::spot, here, 0.02));
    EXPECT_FALSE(is_known(Light::Kind::spot, here, 0.2));
    EXPECT_TRUE(is_known(Light::Kind::directional, {50.0, 4.0, 0.0}, 0.02)) << "it has no place";
    EXPECT_FALSE(is_known(Light::Kind::directional, here, 0.2));

    Plate plate;
    plate.scene.nodes[2].transform.translation = move_between({2.0, 0.1, 0.0}, {3.0, 0.1, 0.0});
    EXPECT_TRUE(find_middle(plate.scene, 0.15f).has_value());
    plate.scene.meshes[2].material = add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(5.0));
    EXPECT_FALSE(find_middle(plate.scene, 0.15f).has_value()) << "a lamp, not a box";
}

TEST(ShutterLight, NothingIsKnownWhereLightsBrightenOrDim) {
    const auto is_known = [](Track<double> Light::*value, double from, double to) {
        Plate plate;
        add_light(plate.scene, Light::Kind::spot, glm::dvec3(5.0), {0.0, 4.0, 0.0}, z_to_down);
        (plate.scene.lights.back().*value).values = {from, to};
        return find_middle(plate.scene, 0.15f).has_value();
    };
    EXPECT_TRUE(is_known(&Light::intensity, 1.0, 0.9));
    EXPECT_FALSE(is_known(&Light::intensity, 1.0, 0.8));
    EXPECT_FALSE(is_known(&Light::intensity, 0.8, 1.0));
    EXPECT_TRUE(is_known(&Light::outer_cone, 0.5, 0.52));
    EXPECT_FALSE(is_known(&Light::outer_cone, 0.5, 0.6));
    EXPECT_FALSE(is_known(&Light::inner_cone, 0.3, 0.1));
    EXPECT_TRUE(is_known(&Light::range, 10.0, 10.2));
    EXPECT_FALSE(is_known(&Light::range, 10.0, 11.0));
    EXPECT_FALSE(is_known(&Light::range, 10.0, 0.0)) << "0 is without end";

    const auto shines = [](double to, bool around) {
        Plate plate;
        const Track<glm::dvec3> light = move_between(glm::dvec3(0.5), glm::dvec3(to));
        plate.scene.meshes[2].material = add_lambert(plate.scene, glm::dvec3(0.0), glm::dvec3(0.5));
        if (around)
            plate.scene.environment.radiance = light;
        else
            plate.scene.materials.back().glow.color = light;
        return find_middle(plate.scene, 0.15f).has_value();
    };
    for (const bool around : {false, true}) {
        EXPECT_TRUE(shines(0.55, around));
        EXPECT_FALSE(shines(0.65, around));
    }
}

TEST(ShutterLight, TheBoundHoldsForSpheres) {
    // A sphere that lies wholly above the horizon hides cos / d^2 of the irradiance, by r^2 (closed form).
    std::mt19937 random(5);
    std::uniform_real_distribution<float> at(-3.0f, 3.0f), height(0.0f, 3.0f), small(0.0f, 1.0f);
    int near = 0;
    for (int i = 0; i < 20000; ++i) {
        const float radius = small(random);
        const glm::vec3 before(at(random), radius + height(random), at(random));
        glm::vec3 after = before + 0.5f * small(random) * glm::vec3(at(random), at(random), at(random));
        after.y = std::max(after.y, radius);
        const glm::vec3 moved(0.2f * at(random), 0.0f, 0.2f * at(random));
        const auto hidden = [&](const glm::vec3& center) {
            const float d = glm::length(center);
            return radius * radius * center.y / (d * d * d);
        };
        const float change = std::abs(hidden(after - moved) - hidden(before));
        const std::vector<ShutterMover> movers{{0, {before, after}, radius, glm::length(after - before)}};
        const float bound = find_hidden_change(movers, glm::vec3(0.0f), moved, 1, HUGE_VALF);
        EXPECT_LE(change, bound + 1e-6f) << i;
        if (change > 0.2f * bound) ++near;
        EXPECT_EQ(find_hidden_change(movers, glm::vec3(0.0f), moved, 0, HUGE_VALF), 0.0f) << "it moves along";
    }
    EXPECT_GT(near, 1000) << "and not by far too much";
}

constexpr int columns = 16, rows = 12;
constexpr double half_second = 15.0;  // frames

/// Frame 0.
Image<Rgb> render_blurred(Scene scene, Integrator integrator, std::uint32_t seed, int spp = 16, double accuracy = 0.2) {
    scene.film.exposure = 1.0;
    scene.cameras[0].shutter = {0.0, half_second};
    RenderSettings settings = shot_settings(0);
    settings.picture = {.width = columns, .height = rows};
    settings.sampling.spp = spp;
    settings.cache.accuracy = accuracy;
    settings.light.integrator = integrator;
    settings.seed = seed;
    return Sequence(std::move(scene), settings).render(0).shaded.color;
}

/// Compares pictures of several seeds. Those of equal seed have the same times and places of samples, so their
/// difference has the noise of light alone.
/// @param gain  how many times the variance of the cache's pictures is below that of the paths'
void expect_same_light(const Scene& scene, double gain) {
    constexpr int size = columns * rows;
    EXPECT_TRUE(holds([&](Trial& trial) {
        PictureMeans cached, paths, differences;
        for (std::uint32_t seed = trial.seed; seed < trial.seed + trial.times(12u); ++seed) {
            Image<Rgb> picture = render_blurred(scene, Integrator::cache, seed);
            const Image<Rgb> traced = render_blurred(scene, Integrator::path, seed);
            cached.add(picture);
            paths.add(traced);
            for (std::size_t i = 0; i < picture.size(); ++i) picture.pixels[i] -= traced.pixels[i];
            differences.add(picture);
        }
        double cached_variance = 0.0, path_variance = 0.0, worst = 0.0;
        for (int i = 0; i < size; ++i) {
            cached_variance += std::pow(cached.pixels[i].error(), 2.0);
            path_variance += std::pow(paths.pixels[i].error(), 2.0);
            worst = std::max(worst, std::abs(differences.pixels[i].mean()) - 3.0 * differences.pixels[i].error());
        }
        EXPECT_LT(cached_variance * gain, path_variance);
        trial.near(differences.all, 0.0, 0.01 * paths.all.mean());
        EXPECT_LT(worst, 0.5 * paths.all.mean() / size) << "the noise of paths has long tails";
    }));
}

/// A dark box slides over the floor, farther than it is wide, seen from near above. A plate under the lamp keeps its
/// light from the floor, so that all light there comes from the walls.
Scene make_sliding_box() {
    Scene scene = make_shot();
    add_mesh(scene, make_quad(1.2, 1.2, 0), {-1.0, 2.2, -1.0}, z_to_down);
    scene.nodes[4].transform.translation = glm::dvec3(-0.6, 2.0, 0.6);
    scene.nodes[4].transform.rotation =
        glm::quatLookAt(glm::normalize(glm::dvec3(0.0, -2.0, -1.4)), glm::dvec3(0.0, 1.0, 0.0));
    scene.cameras[0].fov = 0.7;
    const int node = add_mesh(scene, make_box({0.8, 0.8, 0.8}, add_lambert(scene, glm::dvec3(0.05))));
    scene.nodes[node].transform.translation = move_between({-1.2, 0.4, -1.0}, {0.6, 0.4, -1.0});
    return scene;
}

TEST(MotionBlur, MC27_IndirectLightWhereTheCameraMoves) {
    expect_same_light(make_shot_with_moving_camera(), 4.0);
}

TEST(MotionBlur, MC27_IndirectLightUnderABoxThatSlidesAway) {
    // The floor under the box is dark at the frame's own time.
    expect_same_light(make_sliding_box(), 1.0);
}

TEST(MotionBlur, MC27_IndirectLightOfALampThatFadesIn) {
    Scene scene = make_shot();
    scene.lights[0].intensity.values = {0.0, 2.0};
    expect_same_light(scene, 0.5);
}

TEST(MotionBlur, MC27_IndirectLightOfALampThatDims) {
    // By less than a quarter, and most at the shutter's centre. What samples read there does not hold at other times,
    // not for later samples of the same pixel either.
    Scene scene = make_shot();
    scene.lights[0].intensity = keyed<double>({0.0, 0.25, 0.5}, {2.0, 1.55, 2.0});
    PictureMeans paths, differences;
    for (std::uint32_t seed = 0; seed < 8; ++seed) {
        Image<Rgb> picture = render_blurred(scene, Integrator::cache, seed, 64, 0.03);
        const Image<Rgb> traced = render_blurred(scene, Integrator::path, seed, 64);
        paths.add(traced);
        for (std::size_t i = 0; i < picture.size(); ++i) picture.pixels[i] -= traced.pixels[i];
        differences.add(picture);
    }
    EXPECT_NEAR(differences.all.mean(), 0.0, 0.01 * paths.all.mean());
    EXPECT_LT(differences.all.error(), 0.003 * paths.all.mean());
}

/// Light is linear: while a lamp goes from 0 to twice its power, its light is on average that of its power. Most of the
/// picture is under a plate, so that it shows indirect light alone.
TEST(MotionBlur, MC27_IndirectLightOfAFadeIsThatOfItsMean) {
    Scene still = make_sliding_box();
    still.nodes.pop_back();  // the box
    Scene fading = still;
    fading.lights[0].intensity.values = {0.0, 4.0};  // over a second, of which the shutter sees half
    PictureMeans found, expected;
    for (std::uint32_t seed = 0; seed < 48; ++seed) {
        found.add(render_blurred(fading, Integrator::cache, seed));
        expected.add(render_blurred(still, Integrator::path, seed + 48));
    }
    const auto deviation = [](const Mean& a, const Mean& b) {
        return std::abs(a.mean() - b.mean()) / std::hypot(a.error(), b.error());
    };
    int beyond = 0;
    for (int i = 0; i < columns * rows; ++i) beyond += deviation(found.pixels[i], expected.pixels[i]) > 3.0;
    EXPECT_LE(beyond, 4);  // of 192; by chance 0.6
    EXPECT_LT(deviation(found.all, expected.all), 3.0);
    EXPECT_LT(std::hypot(found.all.error(), expected.all.error()), 0.02 * expected.all.mean());
}

}  // namespace
}  // namespace aleph
