// Table and chairs with turned legs, the armchair, the side table with its lamp.

#include <fmt/format.h>

#include <cmath>

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

/// A turned leg: rings, a baluster and a bun foot.
Shape turned_leg(double height, double radius) {
    std::vector<glm::dvec2> profile = {{0.0, 0.0},  {0.55, 0.0},  {0.55, 0.0},  {0.8, 0.03},   {0.75, 0.07},
                                       {0.45, 0.1}, {0.6, 0.12},  {0.42, 0.14}, {0.5, 0.25},   {0.85, 0.5},
                                       {1.0, 0.6},  {0.85, 0.68}, {0.5, 0.72},  {0.75, 0.745}, {0.5, 0.77},
                                       {0.9, 0.8},  {0.95, 0.82}, {0.95, 1.0},  {0.95, 1.0},   {0.0, 1.0}};
    for (glm::dvec2& point : profile) point = to_millionth(glm::dvec3(point.x * radius, point.y * height, 0.0));
    return lathe(profile, 28);
}

void add_chair(Scene& scene, const std::string& name, const glm::dvec3& place, double degrees, int seat,
               const AntiqueMaterials& materials) {
    const Group chair = Group{scene}.add_group(name, place, turn(y_axis, degrees));
    const int wood = materials.mahogany;
    const Shape leg = turned_leg(0.43, 0.026), spindle = turned_leg(0.4, 0.014);
    for (const auto& [x, letter] : both_sides) {
        chair.add_shape(name + "_leg_front_" + letter, leg, wood, {x * 0.2, 0.0, 0.19});
        chair.add_rod(name + "_leg_back_" + letter, {x * 0.19, 0.0, -0.22}, {x * 0.18, 0.44, -0.19}, 0.019, wood, 20);
        chair.add_rod(name + "_post_" + letter, {x * 0.18, 0.44, -0.19}, {x * 0.19, 0.98, -0.27}, 0.018, wood, 20);
        chair.add_shape(name + "_knob_" + letter, sphere(0.026), wood, {x * 0.19, 0.995, -0.272});
        chair.add_rod(name + "_stretcher_" + letter, {x * 0.2, 0.16, 0.19}, {x * 0.188, 0.16, -0.21}, 0.011, wood, 16);
    }
    chair.add_rod(name + "_stretcher", {-0.195, 0.16, 0.0}, {0.195, 0.16, 0.0}, 0.011, wood, 16);
    chair.add_shape(name + "_frame", box({0.46, 0.055, 0.44}), wood, {0.0, 0.43, 0.0});
    chair.add_mesh(name + "_seat", seat, {0.0, 0.475, 0.0});
    const double lean = -std::atan2(0.08, 0.54) * 180.0 / pi;
    for (int i = 0; i < 4; ++i)
        chair.add_shape(fmt::format("{}_spindle_{}", name, i), spindle, wood, {-0.108 + 0.072 * i, 0.53, -0.2},
                        turn(x_axis, lean));
    chair.add_shape(name + "_rail_low", box({0.36, 0.035, 0.02}), wood, {0.0, 0.53, -0.2});
    chair.add_shape(name + "_rail_high", box({0.37, 0.09, 0.022}), wood, {0.0, 0.94, -0.262}, turn(x_axis, lean));
}

void add_table(Scene& scene, const Group& table, const AntiqueMaterials& materials) {
    const Profile top_outline = {{0.0, 0.71},   {0.5, 0.71},  {0.54, 0.715}, {0.56, 0.725}, {0.565, 0.735},
                                 {0.56, 0.745}, {0.55, 0.75}, {0.55, 0.75},  {0.0, 0.75}};
    table.add_shape("table_top", lathe(top_outline, 96, {4.0, 1.0}), materials.walnut);
    const Profile column_outline = {{0.0, 0.12},   {0.05, 0.12},  {0.1, 0.15}, {0.11, 0.2},  {0.08, 0.26}, {0.05, 0.29},
                                    {0.065, 0.31}, {0.045, 0.33}, {0.05, 0.4}, {0.085, 0.5}, {0.09, 0.54}, {0.05, 0.6},
                                    {0.07, 0.62},  {0.05, 0.64},  {0.1, 0.69}, {0.2, 0.71}};
    table.add_shape("table_column", lathe(column_outline, 56), materials.mahogany);
    const int foot =
        add_cage(scene, "table_foot", make_cushion({0.07, 0.09, 0.44}, 0.03, {0.0, 0.02, 0.0}, 2), materials.mahogany);
    for (int i = 0; i < 3; ++i) {
        const double angle = 120.0 * i + 20.0, a = angle * pi / 180.0;
        table.add_mesh(fmt::format("table_foot_{}", i), foot,
                       to_millionth(glm::dvec3(0.25 * std::sin(a), 0.125, 0.25 * std::cos(a))),
                       turn(y_axis, angle) * turn(x_axis, 20.0));
    }
}

/// A vase with seven irises.
void add_irises(Scene& scene, const Group& table, const AntiqueMaterials& materials) {
    const Profile vase_outline = {{0.0, 0.0},   {0.06, 0.0},   {0.06, 0.0},  {0.055, 0.01},
                                  {0.08, 0.06}, {0.095, 0.12}, {0.08, 0.19}, {0.045, 0.24},
                                  {0.04, 0.27}, {0.055, 0.3},  {0.05, 0.3},  {0.034, 0.27}};
    table.add_shape("vase", lathe(vase_outline, 56), materials.porcelain, {0.0, 0.75, -0.05});
    const int petal_paint = add_lambert(scene, "petal", {124, 92, 190});
    scene.materials.back().double_sided = true;
    const int petal = add_cage(scene, "petal", make_leaf(0.1, 0.055, 0.7), petal_paint);
    const int blade = add_cage(scene, "blade", make_leaf(0.4, 0.03, 0.35), materials.green);
    for (int i = 0; i < 7; ++i) {
        const double around = 137.5 * i, a = around * pi / 180.0, wide = 0.05 + 0.03 * (i % 3),
                     high = 0.26 + 0.045 * ((i * 3) % 5);
        const glm::dvec3 root(0.0, 1.0, -0.05),
            tip = to_millionth(root + glm::dvec3(wide * 1.8 * std::sin(a), high, wide * 1.8 * std::cos(a)));
        table.add_rod(fmt::format("iris_stem_{}", i), root, tip, 0.005, materials.green, 8);
        for (int k = 0; k < 6; ++k) {
            const double lean = k % 2 == 0 ? 88.0 : 22.0;
            table.add_mesh(fmt::format("iris_{}_petal_{}", i, k), petal, tip,
                           turn(y_axis, 60.0 * k + 20.0 * i) * turn(x_axis, lean));
        }
        table.add_mesh(fmt::format("iris_blade_{}", i), blade, root,
                       turn(y_axis, std::fmod(around + 60.0, 360.0)) * turn(x_axis, 18.0 + 4.0 * (i % 4)));
    }
}

/// Two cups on saucers.
void add_tea(const Group& table, const AntiqueMaterials& materials) {
    const Profile cup_outline = {{0.0, 0.006},   {0.02, 0.006}, {0.024, 0.0},   {0.03, 0.01}, {0.038, 0.035},
                                 {0.042, 0.055}, {0.04, 0.055}, {0.035, 0.035}, {0.0, 0.012}};
    const Shape cup = lathe(cup_outline, 40);
    const Profile saucer_outline = {{0.0, 0.0},    {0.035, 0.0},   {0.05, 0.005}, {0.072, 0.014},
                                    {0.07, 0.017}, {0.045, 0.009}, {0.0, 0.006}};
    const Shape saucer = lathe(saucer_outline, 40);
    const glm::dvec3 cups[] = {{0.34, 0.75, 0.16}, {-0.3, 0.75, 0.26}};
    for (int i = 0; i < 2; ++i) {
        table.add_shape(fmt::format("saucer_{}", i), saucer, materials.porcelain, cups[i]);
        table.add_shape(fmt::format("cup_{}", i), cup, materials.porcelain, cups[i] + glm::dvec3(0.0, 0.007, 0.0));
        table.add_shape(fmt::format("cup_handle_{}", i), torus(0.016, 0.004, 32), materials.porcelain,
                        cups[i] + glm::dvec3(0.05, 0.037, 0.0), turn(x_axis, 90.0));
    }
}

}  // namespace

void add_table_and_chairs(Scene& scene, const AntiqueMaterials& materials) {
    const glm::dvec3 place(-0.35, 0.012, 0.15);
    const Group table = Group{scene}.add_group("table", place);
    add_table(scene, table, materials);
    add_irises(scene, table, materials);
    add_tea(table, materials);
    table.add_shape("table_book_a", box({0.19, 0.035, 0.26}), materials.leather, {0.12, 0.768, 0.34},
                    turn(y_axis, 24.0));
    table.add_shape("table_book_b", box({0.15, 0.028, 0.21}), materials.cloth, {0.125, 0.8, 0.335}, turn(y_axis, 41.0));

    const int seat =
        add_cage(scene, "chair_seat", make_cushion({0.44, 0.07, 0.42}, 0.03, {0.0, 0.025, 0.0}, 2), materials.cloth);
    add_chair(scene, "chair_a", {0.5, 0.012, 0.62}, -118.0, seat, materials);
    add_chair(scene, "chair_b", {-1.2, 0.012, 0.32}, 98.0, seat, materials);
    add_chair(scene, "chair_c", {-0.2, 0.012, -0.72}, -6.0, seat, materials);
}

void add_armchair(Scene& scene, const AntiqueMaterials& materials) {
    const Group chair = Group{scene}.add_group("armchair", {1.55, 0.0, -0.95}, turn(y_axis, -52.0));
    const int leather = materials.leather;
    add_cage_node(chair, "armchair_base", make_cushion({0.72, 0.2, 0.7}, 0.04, {0.0, 0.0, 0.01}), leather,
                  {0.0, 0.24, 0.0});
    add_cage_node(chair, "armchair_seat", make_cushion({0.56, 0.16, 0.62}, 0.05, {0.01, 0.04, 0.02}, 2), leather,
                  {0.0, 0.41, 0.05});
    add_cage_node(chair, "armchair_back", make_cushion({0.7, 0.86, 0.18}, 0.07, {0.01, 0.04, 0.035}, 2), leather,
                  {0.0, 0.72, -0.3}, turn(x_axis, -12.0));
    const int wing =
        add_cage(scene, "armchair_wing", make_cushion({0.1, 0.46, 0.26}, 0.045, {0.015, 0.02, 0.03}, 2), leather);
    const int arm =
        add_cage(scene, "armchair_arm", make_cushion({0.15, 0.36, 0.66}, 0.05, {0.015, 0.01, 0.02}, 2), leather);
    for (const auto& [side, letter] : both_sides) {
        chair.add_mesh("armchair_arm_" + letter, arm, {side * 0.355, 0.46, 0.02});
        chair.add_shape("armchair_roll_" + letter, cylinder(0.085, 0.66, 40), leather, {side * 0.37, 0.64, 0.03},
                        turn(x_axis, 90.0));
        chair.add_mesh("armchair_wing_" + letter, wing, {side * 0.34, 0.9, -0.24}, turn(x_axis, -12.0));
        for (const auto& [end, end_letter] : both_sides)
            chair.add_shape("armchair_foot_" + letter + end_letter, turned_leg(0.15, 0.032), materials.mahogany,
                            {side * 0.31, 0.0, end * 0.29});
    }
    add_cage_node(chair, "armchair_pillow", make_cushion({0.38, 0.3, 0.07}, 0.03, {-0.02, -0.015, 0.09}, 2),
                  materials.cloth, {0.02, 0.62, -0.1}, turn(x_axis, -20.0));
}

void add_side_table(Scene& scene, const AntiqueMaterials& materials) {
    const Group table = Group{scene}.add_group("side_table", {2.2, 0.0, -1.85});
    const Profile top_outline = {{0.0, 0.6},   {0.26, 0.6},  {0.28, 0.61}, {0.28, 0.62},
                                 {0.27, 0.63}, {0.27, 0.63}, {0.0, 0.63}};
    table.add_shape("side_table_top", lathe(top_outline, 64), materials.mahogany);
    table.add_shape("side_table_stem", turned_leg(0.6, 0.05), materials.mahogany);
    const Profile base_outline = {{0.0, 0.0}, {0.22, 0.0}, {0.22, 0.0}, {0.21, 0.025}, {0.1, 0.045}, {0.0, 0.05}};
    table.add_shape("side_table_base", lathe(base_outline, 48), materials.mahogany);
    const int shade = add_lambert(scene, "lamp_shade", {226, 196, 142});
    scene.materials.back().double_sided = true;
    const int glow = add_emitter(scene, "lamp_glow", {1.0, 0.76, 0.46}, 60.0);
    const Profile foot_outline = {{0.0, 0.0},   {0.09, 0.0}, {0.09, 0.0},   {0.085, 0.015}, {0.05, 0.03}, {0.08, 0.09},
                                  {0.09, 0.14}, {0.06, 0.2}, {0.025, 0.24}, {0.02, 0.3},    {0.0, 0.3}};
    table.add_shape("lamp_foot", lathe(foot_outline, 48), materials.porcelain, {0.0, 0.63, 0.0});
    table.add_rod("lamp_stem", {0.0, 0.93, 0.0}, {0.0, 1.1, 0.0}, 0.008, materials.brass, 16);
    Shape cone = lathe({{0.21, 0.94}, {0.12, 1.22}}, 64);
    cone.smooth = false;
    table.add_shape("lamp_shade", cone, shade);
    table.add_shape("lamp_down", quad(0.09, 0.09), glow, {0.0, 1.06, 0.0}, z_to_down);
    table.add_shape("lamp_up", quad(0.09, 0.09), glow, {0.0, 1.105, 0.0}, z_to_up);
    table.add_shape("side_table_book", box({0.14, 0.03, 0.2}), materials.cloth, {-0.14, 0.645, 0.1},
                    turn(y_axis, 30.0));
}

}  // namespace aleph
