// Walls with panels and paper, floor, ceiling, fireplace and pictures.

#include <fmt/format.h>

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"

namespace aleph {

namespace {

constexpr double dado = 0.92;       // m, height of the panelling
constexpr double paper_tile = 0.7;  // m, one repeat of the damask

const Profile cornice_profile = {{0.16, 0.0},    {0.16, -0.02}, {0.16, -0.02},  {0.14, -0.03},
                                 {0.11, -0.07},  {0.07, -0.1},  {0.05, -0.12},  {0.05, -0.12},
                                 {0.035, -0.13}, {0.03, -0.17}, {0.012, -0.18}, {0.0, -0.2}};
const Profile rail_profile = {{0.02, 0.05},  {0.045, 0.05}, {0.045, 0.05}, {0.055, 0.035},
                              {0.05, 0.015}, {0.035, 0.0},  {0.02, -0.02}, {0.02, -0.02}};
const Profile skirting_profile = {{0.02, 0.16},  {0.03, 0.16},  {0.03, 0.16}, {0.036, 0.145},
                                  {0.045, 0.13}, {0.045, 0.13}, {0.045, 0.0}};
const Profile panel_profile = {{0.0, 0.0},     {0.0, 0.012},   {0.0, 0.012}, {0.012, 0.02},
                               {0.026, 0.016}, {0.036, 0.004}, {0.04, 0.0}};
const Profile frame_profile = {{0.0, 0.006},  {0.0, 0.016},   {0.0, 0.016},  {0.01, 0.02},   {0.02, 0.03},
                               {0.035, 0.03}, {0.05, 0.05},   {0.07, 0.058}, {0.085, 0.045}, {0.092, 0.03},
                               {0.1, 0.025},  {0.105, 0.012}, {0.105, 0.0}};

struct Wall {
    std::string name;
    glm::dvec3 middle;  ///< of its foot
    double length;      ///< m
    glm::dquat facing;  ///< x along the wall, z into the room
    int panels;
};

/// Paper above, panelled wood below.
void add_wall(const Group& room, const Wall& where, int panel_mesh, const AntiqueMaterials& materials) {
    const auto& [name, middle, length, facing, panels] = where;
    const Group wall = room.add_group(name, middle, facing);
    const double paper = antique_high.y - dado;
    wall.add_shape(name + "_paper", quad(length, paper, {length / paper_tile, paper / paper_tile}), materials.paper,
                   {0.0, dado + 0.5 * paper, 0.0});
    wall.add_shape(name + "_dado", quad(length, dado, {0.5 * length, 0.5}), materials.panel, {0.0, 0.5 * dado, 0.02});
    for (int i = 0; i < panels; ++i)
        wall.add_mesh(fmt::format("{}_panel_{}", name, i), panel_mesh,
                      {(i + 0.5 - 0.5 * panels) * length / panels, 0.53, 0.02});
}

constexpr double fire_height = 0.78;                  // m, of the opening
constexpr double mantel_height = fire_height + 0.37;  // m

void add_fire_surround(const Group& place, int soot, const AntiqueMaterials& materials) {
    const double half = 0.46, top = fire_height;
    place.add_shape("fire_back", quad(2.0 * half, top), soot, {0.0, 0.5 * top, 0.03});
    place.add_shape("hearth", box({1.7, 0.04, 0.5}), materials.stone, {0.0, 0.02, 0.42});
    for (const auto& [side, letter] : both_sides) {
        place.add_shape("fire_cheek_" + letter, box({0.02, top, 0.2}), soot, {side * (half - 0.01), 0.5 * top, 0.13});
        place.add_shape("fire_pier_" + letter, box({0.2, top, 0.24}, {0.4, 1.2}), materials.stone,
                        {side * (half + 0.1), 0.5 * top, 0.12});
        const Profile column_outline = {{0.0, 0.0},    {0.075, 0.0},  {0.075, 0.0},  {0.075, 0.03},
                                        {0.06, 0.05},  {0.068, 0.07}, {0.052, 0.09}, {0.056, 0.3},
                                        {0.048, 0.62}, {0.05, 0.64},  {0.066, 0.66}, {0.052, 0.68},
                                        {0.078, 0.71}, {0.078, 0.74}, {0.078, 0.74}, {0.0, 0.74}};
        place.add_shape("fire_column_" + letter, lathe(column_outline, 40), materials.stone,
                        {side * (half + 0.1), 0.04, 0.29});
    }
    place.add_shape("fire_lintel", box({2.0 * half + 0.4, 0.3, 0.26}, {2.0, 0.5}), materials.stone,
                    {0.0, top + 0.15, 0.13});
    add_cage_node(place, "fire_tablet", make_rectangle_moulding({0.7, 0.2}, panel_profile, false), materials.stone,
                  {0.0, top + 0.15, 0.26});
    place.add_shape("mantel_shelf", box({1.75, 0.05, 0.42}, {2.0, 0.5}), materials.stone, {0.0, top + 0.345, 0.21});
    place.add_shape("mantel_under", box({1.6, 0.04, 0.36}, {2.0, 0.5}), materials.stone, {0.0, top + 0.3, 0.18});
}

/// Embers that shine up, logs, and the grate.
void add_fire(const Group& place, int embers, int bark, const AntiqueMaterials& materials) {
    place.add_shape("embers", quad(0.46, 0.14), embers, {0.0, 0.13, 0.17}, z_to_up);
    for (int i = 0; i < 3; ++i)
        place.add_rod(fmt::format("log_{}", i), {-0.27 + 0.03 * i, 0.16 + 0.05 * (i % 2), 0.1 + 0.07 * i},
                      {0.25 + 0.02 * i, 0.19 + 0.04 * (i % 2), 0.12 + 0.06 * i}, 0.04, bark, 16);
    place.add_shape("grate", box({0.56, 0.02, 0.2}), materials.black, {0.0, 0.11, 0.17});
    for (int i = 0; i < 7; ++i)
        place.add_rod(fmt::format("grate_bar_{}", i), {-0.27 + 0.09 * i, 0.04, 0.28}, {-0.27 + 0.09 * i, 0.24, 0.3},
                      0.008, materials.black, 10);
}

void add_mantel_clock(const Group& place, const AntiqueMaterials& materials) {
    const Group clock = place.add_group("mantel_clock", {0.0, mantel_height, 0.2});
    clock.add_shape("mantel_clock_base", box({0.3, 0.05, 0.15}), materials.mahogany, {0.0, 0.025, 0.0});
    clock.add_shape("mantel_clock_body", box({0.23, 0.22, 0.12}), materials.mahogany, {0.0, 0.16, 0.0});
    const int dial = add_textured(place.scene, "dial", "dial");
    clock.add_shape("mantel_clock_face", quad(0.15, 0.15), dial, {0.0, 0.165, 0.062});
    clock.add_shape("mantel_clock_ring", torus(0.078, 0.009, 48), materials.brass, {0.0, 0.165, 0.062},
                    turn(x_axis, 90.0));
    const Profile top_outline = {{0.12, 0.0}, {0.1, 0.03}, {0.05, 0.05}, {0.02, 0.06}, {0.025, 0.08}, {0.0, 0.1}};
    clock.add_shape("mantel_clock_top", lathe(top_outline, 40), materials.mahogany, {0.0, 0.27, 0.0});
}

/// Candlesticks beside the clock, and two urns.
void add_mantel_ornaments(const Group& place, const AntiqueMaterials& materials) {
    const Profile stick_outline = {{0.0, 0.0},     {0.06, 0.0},    {0.06, 0.0},   {0.058, 0.012}, {0.03, 0.025},
                                   {0.015, 0.05},  {0.024, 0.075}, {0.012, 0.1},  {0.012, 0.17},  {0.022, 0.19},
                                   {0.014, 0.205}, {0.035, 0.215}, {0.035, 0.22}, {0.0, 0.222}};
    const Shape stick = lathe(stick_outline, 36);
    const Profile urn_outline = {{0.0, 0.0},  {0.06, 0.0},   {0.06, 0.0},  {0.05, 0.02},  {0.025, 0.045}, {0.07, 0.1},
                                 {0.1, 0.17}, {0.095, 0.22}, {0.06, 0.26}, {0.075, 0.29}, {0.065, 0.292}, {0.05, 0.26}};
    const Shape urn = lathe(urn_outline, 48);
    for (const auto& [side, letter] : both_sides) {
        place.add_shape("candlestick_" + letter, stick, materials.brass, {side * 0.36, mantel_height, 0.2});
        place.add_shape("candle_" + letter, cylinder(0.014, 0.2, 20), materials.ivory,
                        {side * 0.36, mantel_height + 0.32, 0.2});
        place.add_shape("mantel_urn_" + letter, urn, materials.porcelain, {side * 0.68, mantel_height, 0.2});
    }
}

}  // namespace

void add_antique_shell(Scene& scene, const AntiqueMaterials& materials) {
    const Group room = Group{scene}.add_group("room");
    const glm::dvec3 size = antique_high - antique_low, middle = 0.5 * (antique_low + antique_high);
    room.add_shape("floor", quad(size.x, size.z, {size.x / 1.5, size.z / 1.2}), materials.boards,
                   {middle.x, 0.0, middle.z}, z_to_up);
    room.add_shape("ceiling", quad(size.x, size.z), materials.ceiling, {middle.x, antique_high.y, middle.z}, z_to_down);
    const int panel =
        add_cage(scene, "panel", make_rectangle_moulding({0.66, 0.58}, panel_profile, false), materials.walnut);
    for (const Wall& wall : {Wall{"wall_fire", {middle.x, 0.0, antique_low.z}, size.x, no_turn, 7},
                             Wall{"wall_back", {middle.x, 0.0, antique_high.z}, size.x, z_to_minus_z, 7},
                             Wall{"wall_window", {antique_low.x, 0.0, middle.z}, size.z, z_to_plus_x, 6},
                             Wall{"wall_right", {antique_high.x, 0.0, middle.z}, size.z, z_to_minus_x, 6}})
        add_wall(room, wall, panel, materials);

    const std::vector<glm::dvec2> around = {{antique_low.x, -antique_high.z},
                                            {antique_high.x, -antique_high.z},
                                            {antique_high.x, -antique_low.z},
                                            {antique_low.x, -antique_low.z}};
    struct Moulding {
        const char* name;
        const std::vector<glm::dvec2>& profile;
        double height;
        int material;
    };
    for (const Moulding& moulding : {Moulding{"cornice", cornice_profile, antique_high.y, materials.ceiling},
                                     Moulding{"dado_rail", rail_profile, dado, materials.panel},
                                     Moulding{"skirting", skirting_profile, 0.0, materials.walnut}})
        add_cage_node(room, moulding.name, make_moulding(around, true, moulding.profile), moulding.material,
                      {0.0, moulding.height, 0.0}, z_to_up);
    // A rose of rings on the ceiling.
    const Profile rose_outline = {{0.45, 0.0},   {0.44, -0.02}, {0.4, -0.03},  {0.36, -0.02}, {0.33, -0.02},
                                  {0.28, -0.04}, {0.2, -0.03},  {0.14, -0.05}, {0.06, -0.08}, {0.0, -0.085}};
    room.add_shape("ceiling_rose", lathe(rose_outline, 72), materials.ceiling, {0.0, antique_high.y, 0.1});
    const int rug = add_textured(scene, "rug", "rug");
    room.add_shape("rug", box({3.0, 0.012, 2.0}), rug, {-0.1, 0.006, 0.1});
}

void add_fireplace(Scene& scene, const AntiqueMaterials& materials) {
    const Group place = Group{scene}.add_group("fireplace", {-0.15, 0.0, antique_low.z});
    const int soot = add_lambert(scene, "soot", {36, 30, 28});
    const int embers = add_emitter(scene, "embers", {1.0, 0.36, 0.1}, 5.0);
    const int bark = add_lambert(scene, "bark", {74, 52, 38});
    add_fire_surround(place, soot, materials);
    add_fire(place, embers, bark, materials);
    add_mantel_clock(place, materials);
    add_mantel_ornaments(place, materials);
}

void add_antique_pictures(Scene& scene, const AntiqueMaterials& materials) {
    struct Hanging {
        const char* image;
        glm::dvec3 middle;
        glm::dvec2 size;
        glm::dquat facing;
    };
    const Group pictures = Group{scene}.add_group("pictures");
    for (const Hanging& hanging : {Hanging{"ship", {-0.15, 1.98, antique_low.z}, {1.0, 0.75}, no_turn},
                                   Hanging{"iris", {antique_low.x, 1.72, 1.25}, {0.42, 0.56}, z_to_plus_x},
                                   Hanging{"valley", {antique_high.x, 1.75, -0.2}, {1.1, 0.77}, z_to_minus_x}}) {
        const std::string name = hanging.image;
        const int paint = add_textured(scene, name, name);
        const Group node = pictures.add_group("picture_" + name, hanging.middle, hanging.facing);
        node.add_shape(name + "_canvas", quad(hanging.size.x, hanging.size.y), paint, {0.0, 0.0, 0.01});
        add_cage_node(node, name + "_frame", make_rectangle_moulding(hanging.size, frame_profile, true),
                      materials.gilt);
    }
}

}  // namespace aleph
