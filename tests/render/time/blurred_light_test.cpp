// Indirect light while the shutter is open: the picture of the cache against the one of paths.

#include "tests/support/frame_bytes.h"
#include "tests/support/shot_scenes.h"
#include "tests/support/test.h"
#include "tests/support/trial.h"
#include "tests/support/with_threads.h"

namespace aleph {
namespace {

constexpr int columns = 16, rows = 12;
constexpr double half_second = 15.0;  // frames

RenderSettings blurred_settings(Integrator integrator, std::uint32_t seed) {
    RenderSettings settings = shot_settings(0);
    settings.picture.width = columns;
    settings.picture.height = rows;
    settings.sampling.spp = 16;
    settings.light.integrator = integrator;
    settings.seed = seed;
    return settings;
}

/// Luminance of frame 0.
std::vector<double> render_luminance(Scene scene, Integrator integrator, std::uint32_t seed) {
    scene.film.exposure = 1.0;
    scene.cameras[0].shutter = {0.0, half_second};
    const ShadedFrame shaded = Sequence(std::move(scene), blurred_settings(integrator, seed)).render(0).shaded;
    std::vector<double> values;
    for (const Rgb& color : shaded.color.pixels) values.push_back(luminance(color));
    return values;
}

/// Compares pictures of several seeds. Those of equal seed have the same times and places of samples, so their
/// difference has the noise of light alone.
/// @param gain  how many times the variance of the cache's pictures is below that of the paths'
void expect_same_light(const Scene& scene, double gain) {
    constexpr int size = columns * rows;
    EXPECT_TRUE(holds([&](Trial& trial) {
        const std::uint32_t runs = trial.times(12u);
        std::vector<Mean> cached(size), paths(size), differences(size);
        Mean of_all;
        double mean = 0.0;
        for (std::uint32_t seed = trial.seed; seed < trial.seed + runs; ++seed) {
            const std::vector<double> a = render_luminance(scene, Integrator::cache, seed),
                                      b = render_luminance(scene, Integrator::path, seed);
            double difference = 0.0;
            for (int i = 0; i < size; ++i) {
                cached[i].add(a[i]);
                paths[i].add(b[i]);
                differences[i].add(a[i] - b[i]);
                difference += (a[i] - b[i]) / size;
                mean += b[i] / (size * static_cast<double>(runs));
            }
            of_all.add(difference);
        }
        double cached_variance = 0.0, path_variance = 0.0, worst = 0.0;
        for (int i = 0; i < size; ++i) {
            cached_variance += std::pow(cached[i].error(), 2.0);
            path_variance += std::pow(paths[i].error(), 2.0);
            worst = std::max(worst, std::abs(differences[i].mean()) - 3.0 * differences[i].error());
        }
        EXPECT_LT(cached_variance * gain, path_variance);
        trial.near(of_all, 0.0, 0.01 * mean);
        EXPECT_LT(worst, 0.5 * mean) << "the noise of paths has long tails";
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

/// Light is linear: while a lamp goes from 0 to twice its power, its light is on average that of its power. Most of the
/// picture is under a plate, so that it shows indirect light alone.
TEST(MotionBlur, MC27_IndirectLightOfAFadeIsThatOfItsMean) {
    constexpr int size = columns * rows;
    Scene still = make_sliding_box();
    still.nodes.pop_back();  // the box
    Scene fading = still;
    fading.lights[0].intensity.values = {0.0, 4.0};  // over a second, of which the shutter sees half
    std::vector<Mean> found(size), expected(size);
    Mean found_sum, expected_sum;
    const auto add = [](const std::vector<double>& picture, std::vector<Mean>& pixels, Mean& all) {
        double sum = 0.0;
        for (int i = 0; i < size; ++i) {
            pixels[i].add(picture[i]);
            sum += picture[i];
        }
        all.add(sum);
    };
    for (std::uint32_t seed = 0; seed < 48; ++seed) {
        add(render_luminance(fading, Integrator::cache, seed), found, found_sum);
        add(render_luminance(still, Integrator::path, seed + 48), expected, expected_sum);
    }
    const auto deviation = [](const Mean& a, const Mean& b) {
        return std::abs(a.mean() - b.mean()) / std::hypot(a.error(), b.error());
    };
    int beyond = 0;
    for (int i = 0; i < size; ++i) beyond += deviation(found[i], expected[i]) > 3.0;
    EXPECT_LE(beyond, 4);  // of 192; by chance 0.6
    EXPECT_LT(deviation(found_sum, expected_sum), 3.0);
    EXPECT_LT(std::hypot(found_sum.error(), expected_sum.error()), 0.02 * expected_sum.mean());
}

}  // namespace
}  // namespace aleph
