// Cost of posing a scene for the samples of an open shutter, beside shading them: on one thread, at 640x480.
// Every sample of a pixel takes time_classes poses. `bench_shutter SCENE FRAME...` measures scenes from files too.

#include <fmt/format.h>

#include <cstdlib>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/frame/frame_scene.h"
#include "render/time/shutter.h"
#include "tests/benchmarks/thread_seconds.h"
#include "tests/support/deforming_scenes.h"
#include "tests/support/first_hits.h"
#include "tests/support/render_scenes.h"

namespace aleph {
namespace {

constexpr int width = 640, height = 480, poses = 32;
constexpr double half_a_frame = 0.5;

Scene make_ground() {
    Scene scene;
    add_mesh(scene, make_quad(100.0, 100.0, add_lambert(scene, glm::dvec3(0.5))), {0.0, -1.0, 0.0}, z_to_up);
    add_light(scene, Light::Kind::point, glm::dvec3(500.0), {0.0, 15.0, 5.0});
    add_camera(scene, {0.0, 12.0, 25.0}, glm::dvec3(0.0));
    return scene;
}

/// A thousand boxes that all move.
Scene make_boxes() {
    Scene scene = make_ground();
    scene.meshes.push_back(make_box(glm::dvec3(0.4), 0));
    for (int i = 0; i < 1000; ++i) {
        const glm::dvec3 at(0.6 * (i % 32) - 9.6, 0.0, 0.6 * (i / 32) - 9.6);
        add_node(scene, at, no_turn);
        scene.nodes.back().meshes = {1};
        scene.nodes.back().transform.translation = keyed<glm::dvec3>({0.0, 1.0}, {at, at + glm::dvec3(0.0, 0.5, 0.0)});
    }
    return scene;
}

/// A sheet of 80,000 triangles that bends.
Scene make_bending_sheet() {
    Scene scene = make_ground();
    const int node = add_mesh(scene, make_sheet(200), {0.0, 1.0, 0.0}, z_to_up);
    scene.nodes[node].transform.scale = glm::dvec3(8.0);
    scene.meshes.back().material = 0;
    add_cache(scene, scene.meshes.size() - 1, {0.0, 1.0}, [](const glm::vec3& p, std::size_t sample) {
        return p + glm::vec3(0.0f, 0.0f, 0.2f * static_cast<float>(sample) * p.x * p.x);
    });
    return scene;
}

void measure(const std::string& name, Scene scene, std::int64_t frame) {
    const Shot shot(std::move(scene), {}, {{.first = 0, .camera = 0}});
    FrameScene here(shot, shot.pose_plan), shutter(shot, here);
    here.pose(shot.scene.film.frame_rate.seconds_of(frame), 0, width, height);
    here.prepare();
    const ShutterInterval interval{static_cast<double>(frame), static_cast<double>(frame) + half_a_frame};
    const auto move_to = [&](int i) {
        const double at = place_in_shutter(interval, i, 0, 0.3) / shot.scene.film.frame_rate.per_second();
        shutter.pose(at, 0, width, height);
        shutter.prepare();
        return shutter.sample_scene();
    };
    move_to(0);
    double moving = 0.0, finding = 0.0, casting = 0.0;
    std::size_t movers = 0;
    constexpr double milliseconds = 1000.0 / poses;
    for (int i = 1; i <= poses; ++i) {
        const double before = seconds_now(CLOCK_MONOTONIC);
        const SampleScene at = move_to(i);
        moving += milliseconds * (seconds_now(CLOCK_MONOTONIC) - before);
        finding += milliseconds * seconds_of([&] { movers = find_movers(here.shading(), at.lighting.shading).size(); },
                                             CLOCK_MONOTONIC);
        casting += milliseconds * seconds_of([&] { cast_first_hits(at.lighting.rays, at.view); }, CLOCK_MONOTONIC);
    }
    fmt::print("{:<24}{:>8}{:>12.3f}{:>12.3f}{:>12.1f}{:>12.3f}\n", name, movers, moving, finding, casting,
               time_classes * (moving + finding) / casting);
}

}  // namespace
}  // namespace aleph

int main(int count, char** arguments) {
    using namespace aleph;
    const ThreadLimit one(1);
    fmt::print("{:<24}{:>8}{:>12}{:>12}{:>12}{:>12}\n", "ms, one thread", "movers", "pose", "find movers", "first hits",
               "ratio");
    measure("1,000 boxes", make_boxes(), 5);
    measure("80,000 triangles bend", make_bending_sheet(), 5);
    for (int i = 1; i + 1 < count; i += 2)
        measure(arguments[i], load_scene(arguments[i]), std::atoll(arguments[i + 1]));
    return 0;
}
