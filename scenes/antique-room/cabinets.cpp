// The bookcase, the tall clock, the globe.

#include <fmt/format.h>

#include <algorithm>

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"
#include "scenes/common/keys.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

struct BookRow {
    double from, to;  ///< m, along the shelf
    double height;    ///< m, of the tallest books
    std::uint32_t seed;
};

/// Fills a shelf with books, some leaning.
void add_books(const Group& shelf, const std::string& name, const BookRow& row, const std::vector<int>& bindings) {
    double x = row.from;
    for (int i = 0;; ++i) {
        const auto value = [&](int k) { return pick(row.seed, i, k); };
        const double thick = 0.022 + 0.03 * value(0), tall = row.height * (0.72 + 0.22 * value(1)),
                     deep = 0.15 + 0.05 * value(2);
        if (x + thick + 0.05 > row.to) break;
        const bool leans = value(3) < 0.08 && i > 2;
        const auto binding = static_cast<std::size_t>(value(4) * static_cast<double>(bindings.size()));
        const glm::dvec3 size = to_millionth(glm::dvec3(thick, tall, deep));
        const double lean = leans ? 9.0 : 0.0;
        shelf.add_shape(fmt::format("{}_{}", name, i), box(size), bindings[binding],
                        to_millionth(glm::dvec3(x + 0.5 * thick + (leans ? 0.5 * tall * 0.16 : 0.0), 0.5 * tall,
                                                0.14 - 0.5 * deep + 0.02)),
                        turn(z_axis, lean));
        x += thick + 0.001 + (leans ? tall * 0.17 : 0.0);
        if (value(5) < 0.07) x += 0.09;
    }
}

constexpr glm::dvec3 bookcase_size(1.5, 2.2, 0.36);  // m

void add_bookcase_body(const Group& bookcase, const AntiqueMaterials& materials) {
    const int wood = materials.walnut;
    const double width = bookcase_size.x, height = bookcase_size.y, depth = bookcase_size.z;
    bookcase.add_shape("bookcase_back", box({width, height, 0.02}, {2.0, 3.0}), wood,
                       {0.0, 0.5 * height, -0.5 * depth});
    bookcase.add_shape("bookcase_base", box({width + 0.08, 0.12, depth + 0.06}, {2.0, 0.3}), wood, {0.0, 0.06, 0.0});
    for (const auto& [side, letter] : both_sides) {
        bookcase.add_shape("bookcase_side_" + letter, box({0.04, height - 0.12, depth}, {0.6, 3.0}), wood,
                           {side * (0.5 * width - 0.02), 0.06 + 0.5 * height, 0.0});
        const Profile column_outline = {{0.0, 0.0},    {0.04, 0.0},   {0.04, 0.0},   {0.04, 0.04},  {0.026, 0.06},
                                        {0.034, 0.08}, {0.024, 0.1},  {0.03, 0.6},   {0.024, 1.72}, {0.036, 1.75},
                                        {0.026, 1.78}, {0.042, 1.82}, {0.042, 1.88}, {0.042, 1.88}, {0.0, 1.88}};
        bookcase.add_shape("bookcase_column_" + letter, lathe(column_outline, 32), materials.mahogany,
                           {side * (0.5 * width - 0.02), 0.12, 0.5 * depth + 0.02});
        // Doors below.
        const double door = 0.5 * width - 0.06;
        bookcase.add_shape("bookcase_door_" + letter, box({door, 0.5, 0.03}, {1.0, 0.8}), wood,
                           {side * 0.5 * (door + 0.01), 0.38, 0.5 * depth - 0.03});
        bookcase.add_shape("bookcase_knob_" + letter, sphere(0.018), materials.brass,
                           {side * 0.05, 0.4, 0.5 * depth + 0.002});
    }
}

/// Panels on the doors, and a cornice on three sides.
void add_bookcase_mouldings(const Group& bookcase, const AntiqueMaterials& materials) {
    const double width = bookcase_size.x, height = bookcase_size.y, depth = bookcase_size.z;
    const Profile profile = {{0.0, 0.0}, {0.0, 0.01}, {0.0, 0.01}, {0.012, 0.017}, {0.026, 0.012}, {0.034, 0.0}};
    const int panel = add_cage(bookcase.scene, "bookcase_panel", make_rectangle_moulding({0.54, 0.38}, profile, false),
                               materials.mahogany);
    for (const auto& [side, letter] : both_sides)
        bookcase.add_mesh("bookcase_panel_" + letter, panel, {side * 0.35, 0.38, 0.5 * depth - 0.015});
    const Profile crown_profile = {{0.0, -0.1}, {0.015, -0.09}, {0.02, -0.06}, {0.05, -0.03}, {0.07, 0.0},
                                   {0.07, 0.0}, {0.07, 0.03},   {0.07, 0.03},  {-0.1, 0.03}};
    const double x = 0.5 * width + 0.02, z = 0.5 * depth;
    add_cage_node(bookcase, "bookcase_crown",
                  make_moulding({{x, z + 0.1}, {x, -z - 0.02}, {-x, -z - 0.02}, {-x, z + 0.1}}, false, crown_profile),
                  materials.mahogany, {0.0, height, 0.0}, z_to_up);
    bookcase.add_shape("bookcase_top", box({width, 0.03, depth}), materials.walnut, {0.0, height + 0.005, 0.0});
}

/// Leather in seven colours.
std::vector<int> add_bindings(Scene& scene) {
    std::vector<int> bindings;
    const glm::dvec3 tints[] = {{0.42, 0.06, 0.05}, {0.07, 0.16, 0.1}, {0.08, 0.1, 0.26}, {0.5, 0.28, 0.1},
                                {0.22, 0.1, 0.06},  {0.55, 0.46, 0.3}, {0.3, 0.05, 0.16}};
    for (int i = 0; i < 7; ++i) {
        bindings.push_back(add_textured(scene, fmt::format("binding_{}", i), "spine", 0.5));
        scene.materials.back().base_color = tints[i] * 1.6;
        // Worn leather: a weak highlight that does not hide the colour.
        scene.materials.back().gloss.specular = 0.5;
    }
    return bindings;
}

void add_bookcase_ornaments(const Group& bookcase, const AntiqueMaterials& materials) {
    const Profile jar_outline = {{0.0, 0.0},  {0.06, 0.0},   {0.06, 0.0},  {0.09, 0.05},  {0.1, 0.12},   {0.07, 0.19},
                                 {0.05, 0.2}, {0.06, 0.215}, {0.03, 0.24}, {0.014, 0.25}, {0.016, 0.27}, {0.0, 0.28}};
    bookcase.add_shape("bookcase_jar", lathe(jar_outline, 48), materials.porcelain, {0.48, 1.0625, 0.03});
    const Profile bowl_outline = {{0.0, 0.0},   {0.05, 0.0},   {0.05, 0.0},  {0.045, 0.015}, {0.09, 0.06},
                                  {0.12, 0.12}, {0.113, 0.12}, {0.08, 0.06}, {0.0, 0.03}};
    bookcase.add_shape("bookcase_bowl", lathe(bowl_outline, 48), materials.brass, {0.57, 1.8225, 0.03});
}

}  // namespace

void add_bookcase(Scene& scene, const AntiqueMaterials& materials) {
    const Group bookcase =
        Group{scene}.add_group("bookcase", {1.55, 0.0, antique_low.z + 0.05 + 0.5 * bookcase_size.z});
    add_bookcase_body(bookcase, materials);
    add_bookcase_mouldings(bookcase, materials);
    const std::vector<int> bindings = add_bindings(scene);
    const double levels[] = {0.66, 1.05, 1.43, 1.81};
    for (int i = 0; i < 4; ++i) {
        bookcase.add_shape(fmt::format("bookcase_shelf_{}", i),
                           box({bookcase_size.x - 0.08, 0.025, bookcase_size.z - 0.02}, {2.0, 0.4}), materials.walnut,
                           {0.0, levels[i], -0.01});
        const Group shelf = bookcase.add_group(fmt::format("shelf_{}", i), {0.0, levels[i] + 0.0125, 0.0});
        const double stop = i == 1 ? 0.26 : i == 3 ? 0.42 : 0.7;
        add_books(shelf, fmt::format("book_{}", i), {-0.69, stop, 0.33, 401u + static_cast<std::uint32_t>(i)},
                  bindings);
    }
    add_bookcase_ornaments(bookcase, materials);
}

void add_tall_clock(Scene& scene, const AntiqueMaterials& materials) {
    const int wood = materials.mahogany;
    const Group clock = Group{scene}.add_group("tall_clock", {-1.75, 0.0, antique_low.z + 0.27});
    clock.add_shape("clock_plinth", box({0.54, 0.12, 0.34}), wood, {0.0, 0.06, 0.0});
    clock.add_shape("clock_base", box({0.48, 0.46, 0.3}), wood, {0.0, 0.35, 0.0});
    clock.add_shape("clock_step", box({0.44, 0.05, 0.27}), wood, {0.0, 0.605, 0.0});
    clock.add_shape("clock_trunk_back", box({0.36, 0.84, 0.04}), wood, {0.0, 1.05, -0.1});
    for (const auto& [side, letter] : both_sides) {
        clock.add_shape("clock_stile_" + letter, box({0.06, 0.84, 0.22}), wood, {side * 0.15, 1.05, 0.0});
        const Profile column_outline = {{0.0, 0.0},     {0.026, 0.0},  {0.026, 0.02}, {0.016, 0.035},
                                        {0.02, 0.05},   {0.015, 0.07}, {0.017, 0.38}, {0.022, 0.4},
                                        {0.016, 0.415}, {0.028, 0.44}, {0.028, 0.46}, {0.0, 0.46}};
        clock.add_shape("clock_column_" + letter, lathe(column_outline, 28), materials.brass, {side * 0.2, 1.5, 0.14});
        const Profile finial_outline = {{0.0, 0.0},    {0.02, 0.0},   {0.014, 0.02}, {0.034, 0.05},
                                        {0.03, 0.075}, {0.012, 0.09}, {0.008, 0.13}, {0.0, 0.14}};
        clock.add_shape("clock_finial_" + letter, lathe(finial_outline, 28), materials.brass, {side * 0.2, 2.09, 0.06});
    }
    // The pendulum does not move: the clock has stopped.
    clock.add_rod("clock_pendulum_rod", {0.0, 0.86, -0.03}, {0.0, 1.46, -0.03}, 0.006, materials.brass);
    const Profile pendulum_outline = {{0.0, -0.012}, {0.05, -0.009}, {0.075, 0.0}, {0.05, 0.009}, {0.0, 0.012}};
    clock.add_shape("clock_pendulum", lathe(pendulum_outline, 48), materials.brass, {0.0, 0.84, -0.03},
                    turn(x_axis, 90.0));
    clock.add_shape("clock_hood", box({0.44, 0.5, 0.26}), wood, {0.0, 1.73, 0.0});
    clock.add_shape("clock_hood_foot", box({0.5, 0.05, 0.34}), wood, {0.0, 1.475, 0.0});
    clock.add_shape("clock_cornice", box({0.52, 0.05, 0.36}), wood, {0.0, 2.005, 0.0});
    clock.add_shape("clock_cornice_top", box({0.47, 0.07, 0.32}), wood, {0.0, 2.06, 0.0});
    clock.add_shape("clock_bonnet", cylinder(0.17, 0.24, 64), wood, {0.0, 2.08, 0.0}, turn(x_axis, 90.0));
    clock.add_shape("clock_dial", quad(0.32, 0.32), find_named(scene.materials, "dial"), {0.0, 1.74, 0.133});
    clock.add_shape("clock_bezel", torus(0.165, 0.014, 64), materials.brass, {0.0, 1.74, 0.134}, turn(x_axis, 90.0));
}

void add_globe(Scene& scene, const AntiqueMaterials& materials) {
    const int map = add_textured(scene, "globe", "globe", 0.2);
    const Group stand = Group{scene}.add_group("globe_stand", {-2.15, 0.0, 1.0});
    for (int i = 0; i < 3; ++i) {
        const Group arm = stand.add_group(fmt::format("globe_leg_{}", i), glm::dvec3(0.0), turn(y_axis, 120.0 * i));
        arm.add_rod(fmt::format("globe_leg_rod_{}", i), {0.0, 0.0, 0.3}, {0.0, 0.46, 0.08}, 0.018, materials.mahogany,
                    20);
        arm.add_shape(fmt::format("globe_foot_{}", i), sphere(0.03), materials.brass, {0.0, 0.03, 0.3});
    }
    const Profile column_outline = {{0.0, 0.38},   {0.04, 0.38},  {0.075, 0.42}, {0.07, 0.47}, {0.03, 0.52},
                                    {0.045, 0.55}, {0.025, 0.58}, {0.04, 0.63},  {0.0, 0.64}};
    stand.add_shape("globe_column", lathe(column_outline, 40), materials.mahogany);
    const Group tilt = stand.add_group("globe_tilt", {0.0, 0.93, 0.0}, turn(z_axis, 23.5));
    tilt.add_shape("globe", sphere(0.25), map, glm::dvec3(0.0), turn(y_axis, 60.0));
    tilt.add_rod("globe_axis", {0.0, -0.29, 0.0}, {0.0, 0.29, 0.0}, 0.008, materials.brass);
    stand.add_shape("globe_meridian", torus(0.285, 0.012, 72), materials.brass, {0.0, 0.93, 0.0}, turn(x_axis, 90.0));
    stand.add_shape("globe_horizon", torus(0.33, 0.02, 72), materials.mahogany, {0.0, 0.93, 0.0});
    for (int i = 0; i < 3; ++i) {
        const Group arm =
            stand.add_group(fmt::format("globe_arm_{}", i), glm::dvec3(0.0), turn(y_axis, 120.0 * i + 60.0));
        arm.add_rod(fmt::format("globe_arm_rod_{}", i), {0.0, 0.6, 0.02}, {0.0, 0.92, 0.33}, 0.012, materials.brass,
                    16);
    }
}

}  // namespace aleph
