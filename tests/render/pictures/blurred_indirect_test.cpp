// Indirect light while the shutter is open: pictures of the cache against those of paths.

#include "render/frame/sequence.h"
#include "tests/support/frame_bytes.h"
#include "tests/support/scenes/shot_scenes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int columns = 16, rows = 12;
constexpr double half_second = 15.0;  // frames

/// Frame 0.
FrameOutput render_open(Scene scene, Integrator integrator, std::uint32_t seed, int spp = 16, double accuracy = 0.2) {
    scene.film.exposure = 1.0;
    scene.cameras[0].shutter = {0.0, half_second};
    RenderSettings settings = shot_settings(0);
    settings.picture = {.width = columns, .height = rows};
    settings.sampling.spp = spp;
    settings.cache.accuracy = accuracy;
    settings.light.integrator = integrator;
    settings.seed = seed;
    return Sequence(std::move(scene), settings).render(0);
}

Image<Rgb> render_blurred(Scene scene, Integrator integrator, std::uint32_t seed, int spp = 16, double accuracy = 0.2) {
    return render_open(std::move(scene), integrator, seed, spp, accuracy).shaded.color;
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
    scene.lights[0].intensity = Track<double>({0.0, 0.25, 0.5}, {2.0, 1.55, 2.0});
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

/// Paths of samples for each sample, of a lamp's light that is known at times of the shutter.
double count_paths(const Scene& scene) {
    const FrameCounts counts = render_open(scene, Integrator::cache, 0, 64).statistics.counts;
    return static_cast<double>(counts.rays.path) / static_cast<double>(counts.samples);
}

TEST(MotionBlur, MC27_IndirectLightOfALampThatCrossesTheRoom) {
    Scene scene = make_shot();
    scene.nodes[3].transform.translation = move_between({-2.0, 2.5, -1.0}, {2.0, 2.5, 1.0});
    expect_same_light(scene, 1.0);
    EXPECT_LT(count_paths(scene), 1.0);
}

TEST(MotionBlur, MC27_IndirectLightOfALampThatIsSwitchedOn) {
    Scene scene = make_shot();
    scene.lights[0].intensity = Track<double>({0.0, 0.2}, {0.5, 2.0}, Interpolation::step);
    expect_same_light(scene, 1.0);
    EXPECT_LT(count_paths(scene), 0.5);
}

TEST(MotionBlur, FX15_IndirectLightOfALampWhoseLidSlidesAway) {
    // The lid is small and far from what is seen, and at the shutter's centre it is away.
    Scene scene = make_shot();
    const int lid = add_mesh(scene, make_box({0.3, 0.02, 0.3}, add_lambert(scene, glm::dvec3(0.05))));
    scene.nodes[lid].transform.translation = Track<glm::dvec3>({0.15, 0.2}, {{-1.0, 2.45, -1.0}, {-0.6, 2.45, -1.0}});
    expect_same_light(scene, 0.5);
}

TEST(MotionBlur, MC27_IndirectLightOfAWallThatIsDarkForAMoment) {
    Scene scene = make_shot();
    const glm::dvec3 bright(0.7), dark(0.05);
    scene.materials[1].base_color = Track<glm::dvec3>({0.2, 0.25, 0.3}, {bright, dark, bright});
    expect_same_light(scene, 0.5);
}

/// Light is linear: while a lamp goes from 0 to twice its power, its light is on average that of its power. Most of the
/// picture is under a plate, so that it shows indirect light alone.
TEST(MotionBlur, MC27_IndirectLightOfAFadeIsThatOfItsMean) {
    Scene still = make_sliding_box();
    still.nodes.pop_back();  // the box
    Scene fading = still;
    fading.lights[0].intensity.values = {0.0, 4.0};  // over a second, of which the shutter sees half
    constexpr double accuracy = 0.05;  // coarser records are too bright beside the plate, without a shutter too
    PictureMeans found, expected;
    for (std::uint32_t seed = 0; seed < 48; ++seed) {
        found.add(render_blurred(fading, Integrator::cache, seed, 16, accuracy));
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

TEST(MotionBlur, MC27_OutlinesOfLampsAtRestTakeAsManySamplesWhateverMovesElsewhere) {
    const auto count_samples = [](double way) {
        Scene scene = make_shot();
        add_mesh(scene, make_quad(1.5, 1.0, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(20.0))), {0.8, 1.8, -2.9});
        const int box = add_mesh(scene, make_box(glm::dvec3(0.2), 0));
        scene.nodes[box].transform.translation = move_between({-2.0, 0.1, 0.0}, {-2.0 + way, 0.1, 0.0});
        scene.film.exposure = 1.0;
        scene.cameras[0].shutter = {0.0, half_second};
        RenderSettings settings = shot_settings(0);
        settings.light.bounces = 0;
        follow_error(settings, 1.0);
        settings.light.bounces = 0;
        return static_cast<double>(Sequence(std::move(scene), settings).render(0).statistics.counts.samples);
    };
    EXPECT_LT(count_samples(0.5), 1.3 * count_samples(0.0));
}

TEST(MotionBlur, MC27_OutlinesOfLampsThatMoveAreNoCoarserAtTheShuttersCentre) {
    // The lamp is white at each time, and its streak is grey.
    Scene scene = make_shot();
    const int lamp = add_mesh(scene, make_quad(0.4, 0.4, add_lambert(scene, glm::dvec3(0.0), glm::dvec3(3.0))));
    scene.nodes[lamp].transform.translation = move_between({-2.4, 1.5, -2.0}, {2.4, 1.5, -2.0});
    scene.film.exposure = 1.0;
    scene.nodes[4].transform.translation = glm::dvec3(0.0, 1.5, 3.0);
    scene.nodes[4].transform.rotation = glm::dquat(1.0, 0.0, 0.0, 0.0);
    scene.cameras[0].shutter = {0.0, 2.0 * half_second};
    scene.cameras[0].fov = 0.3;
    RenderSettings settings = shot_settings(0);
    settings.picture = {.width = 40, .height = 16};
    follow_error(settings, 1.0);
    settings.light.bounces = 0;
    settings.sampling.spp = 512;
    PictureMeans means;
    for (settings.seed = 0; settings.seed < 4; ++settings.seed)
        means.add(Sequence(scene, settings).render(0).shaded.color);
    double at_centre = 0.0, beside = 0.0;
    for (int y = 0; y < 16; ++y) {
        for (int x = 0; x < 40; ++x) {
            const double error = means.pixels[y * 40 + x].error();
            (x >= 14 && x < 26 ? at_centre : beside) += error * error;
        }
    }
    EXPECT_LT(at_centre / 12.0, 4.0 * beside / 28.0);
}

}  // namespace
}  // namespace aleph
