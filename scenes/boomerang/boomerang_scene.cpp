#include "scenes/boomerang/boomerang_scene.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

/// Inner faces of the room.
constexpr glm::dvec3 low{-2.6, 0.0, -2.4}, high{2.6, 3.0, 3.6};

/// A track in degrees to radians.
Track<double> in_radians(Track<double> degrees) {
    for (double& value : degrees.values) value = glm::radians(value);
    return degrees;
}

void add_room(Scene& scene) {
    const int mural = add_textured(scene, "mural", "mural");
    const int tiles = add_textured(scene, "tiles", "tiles");
    const int plaster = add_textured(scene, "plaster", "plaster");
    const int lime = add_lambert(scene, "lime", {236, 228, 210});
    const int blue = add_lambert(scene, "blue_wash", {126, 176, 186});
    const int wood = add_lambert(scene, "dark_wood", {104, 66, 42});

    const Group room = Group{scene}.add_group("room");
    const glm::dvec3 size = high - low, middle = 0.5 * (low + high);
    room.add_shape("floor", quad(size.x, size.z, {size.x / 0.8, size.z / 0.8}), tiles, {middle.x, 0.0, middle.z},
                   z_to_up);
    room.add_shape("ceiling", quad(size.x, size.z), lime, {middle.x, high.y, middle.z}, z_to_down);
    room.add_shape("mural_wall", quad(size.x, size.y), mural, {middle.x, middle.y, low.z});
    room.add_shape("near_wall", quad(size.x, size.y), lime, {middle.x, middle.y, high.z}, z_to_minus_z);
    room.add_shape("clay_wall", quad(size.z, size.y, {3.0, 1.5}), plaster, {low.x, middle.y, middle.z}, z_to_plus_x);
    room.add_shape("blue_wall", quad(size.z, size.y), blue, {high.x, middle.y, middle.z}, z_to_minus_x);
    room.add_shape("skirting", box({size.x, 0.12, 0.025}), wood, {middle.x, 0.06, low.z + 0.0125});
    for (const double side : {-1.0, 1.0}) {
        room.add_shape(side < 0.0 ? "skirting_left" : "skirting_right", box({0.025, 0.12, size.z - 0.05}), wood,
                       {side * (high.x - 0.0125), 0.06, middle.z + 0.025});
    }
    const double beams[] = {low.z + 0.07, -0.1, 1.5, 3.0};
    for (int i = 0; i < 4; ++i) {
        room.add_shape(fmt::format("beam_{}", i), box({size.x, 0.16, 0.14}), wood, {middle.x, high.y - 0.08, beams[i]});
    }
}

/// Turned pots with clipped trees, and a bench under the mural.
void add_furniture(Scene& scene) {
    const int clay = add_lambert(scene, "clay", {184, 92, 58});
    const int glaze = add_lambert(scene, "glaze", {36, 92, 116}, 0.25);
    const int green = add_lambert(scene, "leaves", {74, 118, 54});
    const int bark = add_lambert(scene, "bark", {112, 84, 60});
    const int oak = add_lambert(scene, "oak", {176, 128, 80}, 0.4);
    const Profile pot = {{0.0, 0.0},   {0.15, 0.0},  {0.15, 0.0},  {0.2, 0.16},  {0.235, 0.34}, {0.25, 0.37},
                         {0.25, 0.41}, {0.25, 0.41}, {0.22, 0.41}, {0.22, 0.41}, {0.2, 0.33},   {0.0, 0.33}};
    const auto add_tree = [&](const std::string& name, const glm::dvec3& place, int material, double height) {
        const Group node = Group{scene}.add_group(name, place);
        node.add_shape(name + "_pot", lathe(pot), material);
        node.add_shape(name + "_stem", cylinder(0.018, height, 16), bark, {0.0, 0.33 + 0.5 * height, 0.0});
        node.add_shape(name + "_crown", sphere(0.24), green, {0.0, 0.5 + height, 0.0});
        node.add_shape(name + "_ball", sphere(0.14), green, {0.0, 0.84 + height, 0.0});
    };
    add_tree("tree_left", {-2.12, 0.0, -1.75}, clay, 0.5);
    add_tree("tree_right", {2.1, 0.0, -1.6}, glaze, 0.34);

    const Group bench = Group{scene}.add_group("bench", {0.1, 0.0, -2.05});
    bench.add_shape("bench_seat", box({1.7, 0.05, 0.36}), oak, {0.0, 0.44, 0.0});
    for (const auto& [side, letter] : both_sides)
        bench.add_shape("bench_leg_" + letter, box({0.07, 0.415, 0.3}), oak, {side * 0.7, 0.2075, 0.0});
}

void add_lights(Scene& scene) {
    // Two skylights between the beams, and evening light from a window beside the camera.
    const int day = add_emitter(scene, "daylight", {1.0, 0.95, 0.86}, 9.0);
    const int evening = add_emitter(scene, "evening", {1.0, 0.78, 0.5}, 7.0);
    Group{scene}.add_shape("skylight_far", quad(2.2, 1.0), day, {0.0, high.y - 0.001, -0.9}, z_to_down);
    Group{scene}.add_shape("skylight_near", quad(2.2, 1.0), day, {0.0, high.y - 0.001, 0.7}, z_to_down);
    Group{scene}.add_shape("window", quad(1.1, 1.5), evening, {high.x - 0.001, 1.7, 2.2}, z_to_minus_x);
}

/// The flight: most of a loop, seen from outside; keys every tenth of a second.
void add_boomerang(Scene& scene) {
    const int material = add_textured(scene, "lacquer", "paint", 0.32);
    const double seconds = boomerang_last_frame / 30.0;
    const auto place = [&](double t) {
        const double a = glm::radians(204.0 - 240.0 * t / seconds);
        return glm::dvec3(0.58 * std::cos(a) + 0.02, 1.33 + 0.2 * std::sin(a), 1.2 - 0.7 * std::sin(a));
    };
    std::vector<MotionKey<glm::dvec3>> keys;
    const int count = 15;
    for (int i = 0; i <= count; ++i) {
        const double t = seconds * i / count, dt = 1e-4;
        const glm::dvec3 velocity = (place(t + dt) - place(t - dt)) / (2.0 * dt);
        keys.push_back({to_millionth(t), velocity, place(t), velocity});
    }
    const int flight = add_node(scene, "flight");
    scene.nodes.back().transform.translation = cubic_track(keys);
    const int bank = add_node(scene, "bank", flight);
    turn_about(
        scene, bank, {0.0, 0.0, 1.0},
        in_radians(eased_track<double>({0.0, to_millionth(0.5 * seconds), to_millionth(seconds)}, {24.0, 4.0, -26.0})));
    const int lean = add_node(scene, "lean", bank, glm::dvec3(0.0), turn(x_axis, 60.0));
    const int spin = add_node(scene, "boomerang", lean);
    turn_about(scene, spin, {0.0, 1.0, 0.0},
               in_radians(even_track<double>(0.0, to_millionth(seconds), -40.0,
                                             -40.0 - boomerang_spin_degrees * boomerang_last_frame)));
    scene.nodes[spin].meshes = {append(scene.meshes, make_boomerang_mesh(material))};
}

/// Static in the first half, as in the figure of the thesis; then a slow move to the right that follows the boomerang:
/// the wall moves by about one pixel per frame at 640x480.
void add_camera(Scene& scene) {
    const std::vector<double> times = {0.0, boomerang_still_until / 30.0, to_millionth(boomerang_last_frame / 30.0)};
    const auto hold_and_go = [&](auto from, auto to) { return Track<decltype(from)>(times, {from, from, to}); };
    const int dolly = add_node(scene, "camera_dolly");
    scene.nodes.back().transform.translation = hold_and_go(glm::dvec3(-0.12, 1.5, 3.2), glm::dvec3(0.1, 1.47, 3.14));
    const int pan = add_node(scene, "camera_pan", dolly);
    turn_about(scene, pan, y_axis, in_radians(hold_and_go(1.4, -1.2)));
    add_node(scene, "camera", pan, glm::dvec3(0.0), turn(x_axis, -4.5));
    hang_camera(scene, 44.0);
}

}  // namespace

Scene make_boomerang_scene(const std::string& textures) {
    // Exposure chosen by eye.
    Scene scene = begin_scene("boomerang", boomerang_last_frame, 1.3, textures, make_boomerang_textures());
    add_room(scene);
    add_furniture(scene);
    add_lights(scene);
    add_boomerang(scene);
    add_camera(scene);
    return scene;
}

}  // namespace aleph
