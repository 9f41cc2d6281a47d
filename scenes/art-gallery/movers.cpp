// The moving exhibits except the balls (ball_work.cpp): the top, the kinetic work, the mobile; and the camera.

#include <fmt/format.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

// The top slows down: its spin falls evenly, its precession rate is inversely proportional to the spin.
constexpr double first_spin = 2.0 * pi * 2.3, last_spin = 2.0 * pi * 1.25;  // rad/s
constexpr double slowing = (first_spin - last_spin) / gallery_seconds;      // rad/s2

std::vector<MotionKey<double>> make_precession() {
    const double strength = 2.0 * pi * 0.2 * first_spin;
    std::vector<MotionKey<double>> keys;
    for (int i = 0; i <= 30; ++i) {
        const double t = gallery_seconds * i / 30.0, spin = first_spin - slowing * t;
        keys.push_back({t, strength / spin, strength / slowing * std::log(first_spin / spin), strength / spin});
    }
    return keys;
}

/// The top leans farther as it slows down, and nods a little.
std::vector<MotionKey<double>> make_lean() {
    std::vector<MotionKey<double>> keys;
    for (int i = 0; i <= 100; ++i) {
        const double t = gallery_seconds * i / 100.0, grown = t / gallery_seconds, nod = 2.0 * pi * 0.9;
        const double rate = glm::radians(9.0) / gallery_seconds + glm::radians(0.9) * nod * std::cos(nod * t);
        keys.push_back({t, rate, glm::radians(10.0 + 9.0 * grown + 0.9 * std::sin(nod * t)), rate});
    }
    return keys;
}

struct Vane {
    const char* name;
    glm::dvec3 color;  ///< sRGB, 0..255
};

constexpr double kinetic_floor = 0.015, kinetic_roof = 1.9;  // m above the table's node

double panel_height(int i) {
    return 1.3 + 0.1 * ((i * 2) % 5);
}

/// The foot of rods and spindles.
Shape make_socket() {
    const Profile outline = {{0.0, 0.0},     {0.05, 0.0},   {0.05, 0.0},    {0.05, 0.008},
                             {0.042, 0.016}, {0.026, 0.02}, {0.022, 0.045}, {0.0, 0.05}};
    return lathe(outline, 24);
}

/// Plinth, turntable, roof and axle. Returns the turntable.
Group add_turntable(Scene& scene, const GalleryMaterials& materials) {
    const Group work = Group{scene}.add_group("kinetic", {-2.75, 0.0, -2.35});
    const Profile plinth_outline = {{0.0, 0.0},    {1.12, 0.0},  {1.12, 0.0},  {1.12, 0.34},
                                    {1.11, 0.355}, {1.09, 0.36}, {1.09, 0.36}, {0.0, 0.36}};
    work.add_shape("kinetic_plinth", lathe(plinth_outline, 96), materials.plinth);
    const Group table = work.add_group("kinetic_table", {0.0, 0.375, 0.0});
    turn_about(scene, table, y_axis, even_track(0.0, gallery_seconds, 0.0, 2.0 * pi * 2.5));
    // Wider than the plinth and with a round edge, to avoid a narrow corner, where irradiance records would crowd.
    const Profile disc_outline = {{0.0, -0.015}, {1.1, -0.015}, {1.15, -0.012}, {1.165, 0.0},
                                  {1.15, 0.012}, {1.1, 0.015},  {1.1, 0.015},   {0.0, 0.015}};
    table.add_shape("kinetic_disc", lathe(disc_outline, 96), materials.plinth);
    // The roof blocks the lamps: the light below it comes from the vanes.
    const Profile roof_outline = {{0.0, 1.9},   {1.08, 1.9},  {1.08, 1.9}, {1.1, 1.915},
                                  {1.08, 1.93}, {1.08, 1.93}, {0.0, 1.97}};
    table.add_shape("kinetic_roof", lathe(roof_outline, 96), materials.plinth);
    table.add_rod("kinetic_axle", {0.0, 0.0, 0.0}, {0.0, 2.0, 0.0}, 0.03, materials.steel, 24);
    return table;
}

/// A coloured panel on a spindle.
void add_vane(const Group& table, int i, const Vane& vane, const GalleryMaterials& materials) {
    const int paint = add_lambert(table.scene, fmt::format("vane_{}", vane.name), vane.color);
    const Group arm = table.add_group(fmt::format("vane_arm_{}", vane.name), glm::dvec3(0.0), turn(y_axis, 72.0 * i));
    // Each vane also swings about its own vertical axis.
    const Group pivot = arm.add_group(fmt::format("vane_{}", vane.name), {0.0, 0.0, 0.62});
    std::vector<double> times, angles;
    for (int k = 0; k <= 10; ++k) {
        times.push_back(gallery_seconds * k / 10.0);
        angles.push_back(glm::radians((k + i) % 2 == 0 ? 14.0 : -14.0));
    }
    turn_about(table.scene, pivot, y_axis, eased_track(times, angles));
    const double height = panel_height(i);
    arm.add_rod(fmt::format("vane_spindle_{}", vane.name), {0.0, kinetic_floor, 0.62}, {0.0, kinetic_roof, 0.62}, 0.017,
                materials.steel, 16);
    arm.add_shape(fmt::format("vane_socket_{}", vane.name), make_socket(), materials.steel, {0.0, kinetic_floor, 0.62});
    pivot.add_shape(fmt::format("vane_panel_{}", vane.name), box({0.025, height, 0.7}), paint,
                    {0.0, 0.06 + 0.5 * height, 0.0});
}

/// A white ball that moves up and down a rod.
void add_rider(const Group& table, int i, int white, const GalleryMaterials& materials) {
    const Group rider = table.add_group(fmt::format("rider_{}", i), glm::dvec3(0.0), turn(y_axis, 72.0 * i + 50.0));
    const int lift = rider.add_shape(fmt::format("rider_ball_{}", i), sphere(0.12), white, {0.0, 0.6, 0.8});
    std::vector<double> times;
    std::vector<glm::dvec3> places;
    for (int k = 0; k <= 12; ++k) {
        times.push_back(gallery_seconds * k / 12.0);
        places.emplace_back(0.0, (k + i) % 2 == 0 ? 0.32 : 1.1, 0.8);
    }
    table.scene.nodes[lift].transform.translation = eased_track(times, places);
    rider.add_rod(fmt::format("rider_rod_{}", i), {0.0, kinetic_floor, 0.8}, {0.0, kinetic_roof, 0.8}, 0.01,
                  materials.steel, 12);
    rider.add_shape(fmt::format("rider_socket_{}", i), make_socket(), materials.steel, {0.0, kinetic_floor, 0.8});
}

}  // namespace

void add_top(Scene& scene, const GalleryMaterials& materials) {
    const Group work = Group{scene}.add_group("top_work", {2.15, 0.0, -0.95});
    const Profile stand_outline = {{0.0, 0.0},    {0.34, 0.0},   {0.34, 0.0},   {0.34, 0.03},  {0.3, 0.06},
                                   {0.16, 0.09},  {0.09, 0.16},  {0.075, 0.3},  {0.075, 0.62}, {0.1, 0.74},
                                   {0.22, 0.81},  {0.4, 0.83},   {0.42, 0.845}, {0.42, 0.865}, {0.41, 0.875},
                                   {0.41, 0.875}, {0.38, 0.868}, {0.15, 0.852}, {0.0, 0.85}};
    work.add_shape("top_stand", lathe(stand_outline, 80), materials.marble);
    const int skin = add_textured(scene, "top", "top", 0.25);

    const Group turning = work.add_group("top_precession", {0.0, 0.85, 0.0});
    turn_about(scene, turning, y_axis, cubic_track(make_precession()));
    const Group leaning = turning.add_group("top_lean");
    turn_about(scene, leaning, x_axis, cubic_track(make_lean()));
    const Profile top_outline = {{0.0, 0.0},     {0.012, 0.012}, {0.03, 0.05},  {0.1, 0.105}, {0.19, 0.175},
                                 {0.215, 0.215}, {0.2, 0.25},    {0.12, 0.285}, {0.035, 0.3}, {0.024, 0.32},
                                 {0.024, 0.4},   {0.032, 0.42},  {0.026, 0.44}, {0.0, 0.447}};
    const int top = leaning.add_shape("top", lathe(top_outline, 96), skin);
    const double angle = first_spin * gallery_seconds - 0.5 * slowing * gallery_seconds * gallery_seconds;
    turn_about(
        scene, top, {0.0, 1.0, 0.0},
        cubic_track<double>({{0.0, first_spin, 0.0, first_spin}, {gallery_seconds, last_spin, angle, last_spin}}));
}

void add_kinetic_work(Scene& scene, const GalleryMaterials& materials) {
    // Saturated vanes turn in front of a white wall. Each has a white panel beside it, like the two pages of an open
    // book, and white balls move between the books: both take the colours of the vanes.
    const Group table = add_turntable(scene, materials);
    const Vane vanes[] = {{"red", {242, 40, 24}},
                          {"yellow", {254, 200, 12}},
                          {"green", {46, 192, 66}},
                          {"blue", {30, 116, 240}},
                          {"magenta", {240, 40, 150}}};
    const int white = add_lambert(scene, "kinetic_white", {242, 240, 234});
    for (int i = 0; i < 5; ++i) {
        add_vane(table, i, vanes[i], materials);
        const Group page = table.add_group(fmt::format("page_{}", i), glm::dvec3(0.0), turn(y_axis, 72.0 * i + 27.0));
        page.add_shape(fmt::format("page_panel_{}", i), box({0.025, panel_height(i), 0.7}), white,
                       {0.0, 0.5 * panel_height(i), 0.62});
        add_rider(table, i, white, materials);
    }
}

void add_mobile(Scene& scene, const GalleryMaterials& materials) {
    // Each arm hangs from the one above and turns at its own rate.
    struct Arm {
        double left, right, drop;  ///< m: lengths to both sides; length of the wire
        double first;              ///< turns at the start, so that the mobile stays within the picture
        double turns;              ///< during the shot
        glm::dvec3 color;
        double size;
    };
    const Arm arms[] = {{0.62, 1.05, 1.48, 0.05, 1.5, {214, 40, 34}, 0.3},
                        {0.5, 0.8, 0.3, -0.12, -2.5, {246, 184, 28}, 0.25},
                        {0.42, 0.62, 0.27, 0.15, 3.5, {28, 86, 180}, 0.21},
                        {0.36, 0.42, 0.23, -0.2, -4.5, {232, 110, 30}, 0.17}};
    const Profile leaf_outline = {{0.0, -0.02},  {0.5, -0.012}, {0.92, -0.006}, {1.0, 0.0},
                                  {0.92, 0.006}, {0.5, 0.012},  {0.0, 0.02}};
    const Shape leaf = lathe(leaf_outline, 40);
    int parent = add_node(scene, "mobile", no_index, {1.4, hall_high.y, 1.15});
    const int black = materials.black_frame;
    glm::dvec3 hook(0.0);
    for (int i = 0; i < 4; ++i) {
        const Arm& arm = arms[i];
        const Group node =
            Group{scene, parent}.add_group(fmt::format("mobile_arm_{}", i), hook - glm::dvec3(0.0, arm.drop, 0.0));
        turn_about(scene, node, {0.0, 1.0, 0.0},
                   even_track(0.0, gallery_seconds, 2.0 * pi * arm.first, 2.0 * pi * (arm.first + arm.turns)));
        node.add_rod(fmt::format("mobile_wire_{}", i), glm::dvec3(0.0), {0.0, arm.drop, 0.0}, 0.004, black, 8);
        // Rods end in the middle of their paddles.
        const double left_end = -arm.left - 0.8 * arm.size, right_end = arm.right + (i == 3 ? 0.12 : 0.0);
        node.add_rod(fmt::format("mobile_rod_{}", i), {left_end, -0.07, 0.0}, {right_end, 0.03, 0.0}, 0.008, black);
        const auto add_paddle = [&](const std::string& name, double x, double y, double size, const glm::dvec3& color,
                                    double tilt) {
            const int paint = add_lambert(scene, name, color);
            Shape shape = leaf;
            for (glm::dvec2& point : shape.profile) point = to_millionth(glm::dvec3(point * size, 0.0));
            const int paddle = node.add_shape(name, shape, paint, {x, y, 0.0}, turn(z_axis, tilt));
            scene.nodes[paddle].transform.scale = glm::dvec3(1.0, 1.0, 0.72);
        };
        add_paddle(fmt::format("mobile_paddle_{}", i), left_end, -0.07, arm.size, arm.color, 62.0 + 6.0 * i);
        if (i == 3) add_paddle("mobile_paddle_4", right_end, 0.03, 0.15, {240, 240, 236}, 70.0);
        parent = node;
        hook = {arm.right, 0.03, 0.0};
    }
}

void add_gallery_camera(Scene& scene) {
    // Frame, position, target; eased in between.
    add_walking_camera(scene,
                       {{0, {5.1, 1.6, -0.75}, {0.6, 1.62, 2.3}},
                        {120, {5.0, 1.6, 0.95}, {-1.4, 1.4, -0.1}},
                        {235, {3.75, 1.45, 0.35}, {1.75, 1.2, -1.35}},
                        {340, {1.9, 1.5, 0.75}, {-1.2, 1.2, -2.2}},
                        {450, {-0.15, 1.48, 0.05}, {-2.75, 1.1, -2.45}},
                        {510, {-0.25, 1.52, 0.1}, {-5.0, 1.3, -0.3}},
                        {560, {-0.6, 1.55, -0.3}, {-3.9, 1.2, 0.95}},
                        {650, {-1.6, 1.6, -0.5}, {-5.4, 1.35, 0.45}},
                        {749, {-4.1, 1.55, -0.15}, {-8.1, 1.35, 0.0}}},
                       50.0);
}

}  // namespace aleph
