// Direct light of 8 to 1,000 lights: time and shadow rays to equal error. Lamps of the same power in all hang in rows
// over a hall; posts and panels throw shadows. One thread; the error is the standard deviation over seeds, relative to
// the mean of all points. Cost is what an error of 5 % takes at a point of the floor.
//   bench_lights [SAMPLES]

#include <fmt/format.h>

#include <cstdlib>
#include <ctime>
#include <functional>

#include "render/path/direct_light.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

constexpr double side = 20.0, height = 4.0;  // m, of the hall
constexpr int across = 24;                   // points along a side

Scene make_hall(int lights, bool lamps) {
    Scene scene;
    const int grey = add_lambert(scene, glm::dvec3(0.5), glm::dvec3(0.0), true);
    const int columns = static_cast<int>(std::ceil(std::sqrt(lights)));
    const double step = side / columns, size = 0.25 * step;
    const int lamp = add_lambert(scene, glm::dvec3(0.0), glm::dvec3(1000.0 / (lights * size * size)));
    for (int i = 0; i < lights; ++i) {
        const glm::dvec3 at(step * (i % columns + 0.5) - side / 2, height + 0.2 * std::sin(2.3 * i),
                            step * (i / columns + 0.5) - side / 2);
        if (lamps) {
            add_mesh(scene, make_quad(size, size, lamp), at, z_to_down);
        } else {
            add_light(scene, Light::Kind::point, glm::dvec3(1000.0 / lights), at);
        }
    }
    for (int i = 0; i < 49; ++i) {
        const glm::dvec3 at(side * (i % 7 + 0.4) / 7.0 - side / 2, 0.0, side * (i / 7 + 0.6) / 7.0 - side / 2);
        add_mesh(scene, make_box({0.4, 2.5, 0.4}, grey), at + glm::dvec3(0.0, 1.25, 0.0));
        add_mesh(scene, make_quad(1.2, 0.8, grey), at + glm::dvec3(0.8, 2.0, 0.5), z_to_up);
    }
    return scene;
}

struct Cost {
    double seconds = 0.0, rays = 0.0, variance = 0.0;  ///< of one call; the variance relative to the squared mean
};

using Method = std::function<Rgb(const Stage&, RayTask&, const ViewedSurface&, std::uint32_t seed)>;

Cost measure(const Stage& stage, const Method& method, std::uint32_t seeds) {
    RayTask task(stage.rays);
    double sum = 0.0, squares = 0.0, start = seconds_now();
    for (int p = 0; p < across * across; ++p) {
        const glm::vec3 at(side * (p % across + 0.5) / across - side / 2, 0.0,
                           side * (p / across + 0.5) / across - side / 2);
        const ViewedSurface surface{make_point(at, {0.0f, 1.0f, 0.0f}, 1e-4f), make_lambert(0.6f), {0.0f, 1.0f, 0.0f}};
        Mean mean;
        for (std::uint32_t seed = 0; seed < seeds; ++seed) mean.add(luminance(method(stage, task, surface, seed)));
        sum += mean.mean();
        squares += mean.error() * mean.error() * seeds;
    }
    const double points = across * across, calls = points * seeds;
    return {(seconds_now() - start) / calls, static_cast<double>(task.counts.shadow) / calls,
            squares / points / std::pow(sum / points, 2.0)};
}

int run(int argc, char** argv) {
    const int samples = argc > 1 ? std::atoi(argv[1]) : 4;
    const Method shared = [&](const Stage& stage, RayTask& task, const ViewedSurface& surface, std::uint32_t seed) {
        const LobeShares shares{};
        return sample_direct_light(stage.lighting(), task, LitSurface(surface), shares, PixelSequence(seed, 0, 0, 0),
                                   {0, samples});
    };
    const Method one = [](const Stage& stage, RayTask& task, const ViewedSurface& surface, std::uint32_t seed) {
        RandomStream random({seed, 0, 0, 0});
        const LightNumbers numbers{random.next(), random.next_2d()};
        const ScatteredLight light = choose_light(stage.lighting(), LitSurface(surface), {}, numbers);
        return light.radiance == Rgb(0.0f)
                   ? light.radiance
                   : light.radiance * find_transmittance(stage.lighting(), task, light.shadow_ray);
    };
    constexpr double error = 0.05;
    for (const bool lamps : {true, false}) {
        fmt::print("{}: per call, and to an error of {}\n", lamps ? "square lamps" : "point lights", error);
        fmt::print("  {:>6} {:<16} {:>9} {:>6} {:>9} {:>9} {:>7}\n", "lights", "method", "us", "rays", "variance",
                   "us to", "rays to");
        for (const int lights : {8, 32, 125, 1000}) {
            const Stage stage(make_hall(lights, lamps));
            for (const auto& [name, method] : {std::pair("shared samples", shared), std::pair("one light", one)}) {
                const Cost cost = measure(stage, method, 40);
                const double calls = cost.variance / (error * error);
                fmt::print("  {:>6} {:<16} {:9.3f} {:6.2f} {:9.5f} {:9.3f} {:7.2f}\n", lights, name, 1e6 * cost.seconds,
                           cost.rays, cost.variance, 1e6 * cost.seconds * calls, cost.rays * calls);
            }
        }
    }
    return 0;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    return aleph::run(argc, argv);
}
