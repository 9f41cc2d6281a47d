// Hall and cabinet: walls, floor, ceiling with beams, mouldings, the doorway, and the eight lamps.

#include <fmt/format.h>

#include <numbers>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"
#include "scenes/common/keys.h"

namespace aleph {

namespace {

const Profile skirting_profile = {{0.0, 0.17},  {0.0, 0.17},   {0.008, 0.17}, {0.018, 0.16},
                                  {0.02, 0.14}, {0.028, 0.13}, {0.028, 0.13}, {0.03, 0.12},
                                  {0.03, 0.02}, {0.034, 0.0},  {0.034, 0.0}};
const Profile cornice_profile = {{0.2, 0.0},     {0.2, -0.025}, {0.2, -0.025}, {0.17, -0.035},
                                 {0.12, -0.06},  {0.08, -0.11}, {0.06, -0.15}, {0.06, -0.15},
                                 {0.035, -0.16}, {0.03, -0.2},  {0.0, -0.205}, {0.0, -0.205}};
const Profile architrave_profile = {{0.0, 0.0},  {0.0, 0.03},  {0.0, 0.03},  {0.02, 0.04}, {0.06, 0.04}, {0.08, 0.025},
                                    {0.1, 0.03}, {0.13, 0.05}, {0.15, 0.05}, {0.15, 0.05}, {0.155, 0.0}, {0.155, 0.0}};

struct Room {
    std::string name;
    glm::dvec3 low, high;  ///< inner faces
    double door_x;         ///< of the wall with the doorway
    int wall;              ///< material
};

/// Skirting and cornice of a room; the skirting starts and ends at the doorway. Seen from above, x to the right and -z
/// up.
void add_trim(const Group& parent, const Room& room, int trim, int cornice) {
    const auto& [name, low, high, door_x, wall] = room;
    const double far = door_x == low.x ? high.x : low.x, turn_sign = door_x == low.x ? 1.0 : -1.0;
    const glm::dvec2 half(door_half_width + 0.15, high.z);
    const std::vector<glm::dvec2> around = {{door_x, -turn_sign * half.x}, {door_x, -turn_sign * half.y},
                                            {far, -turn_sign * half.y},    {far, turn_sign * half.y},
                                            {door_x, turn_sign * half.y},  {door_x, turn_sign * half.x}};
    add_cage_node(parent, name + "_skirting", make_moulding(around, false, skirting_profile), trim, glm::dvec3(0.0),
                  z_to_up);
    const std::vector<glm::dvec2> whole = {{low.x, low.z}, {high.x, low.z}, {high.x, high.z}, {low.x, high.z}};
    add_cage_node(parent, name + "_cornice", make_moulding(whole, true, cornice_profile), cornice, {0.0, high.y, 0.0},
                  z_to_up);
}

/// Floor, ceiling and walls of a room, without the wall with the doorway.
void add_shell(const Group& parent, const Room& room, const GalleryMaterials& materials) {
    const auto& [name, low, high, door_x, wall] = room;
    const glm::dvec3 size = high - low, middle = 0.5 * (low + high);
    const double tile = 1.1;  // m, one repeat of the parquet
    parent.add_shape(name + "_floor", quad(size.x, size.z, {size.x / tile, size.z / tile}), materials.parquet,
                     {middle.x, 0.0, middle.z}, z_to_up);
    parent.add_shape(name + "_ceiling", quad(size.x, size.z), materials.ceiling, {middle.x, high.y, middle.z},
                     z_to_down);
    parent.add_shape(name + "_wall_north", quad(size.x, size.y), wall, {middle.x, middle.y, low.z});
    parent.add_shape(name + "_wall_south", quad(size.x, size.y), wall, {middle.x, middle.y, high.z}, z_to_minus_z);
    const bool at_high = door_x == low.x;
    parent.add_shape(name + "_wall_end", quad(size.z, size.y), wall, {at_high ? high.x : low.x, middle.y, middle.z},
                     at_high ? z_to_minus_x : z_to_plus_x);
}

/// The wall between the two rooms, its faces in the colours of the rooms; jambs and floor of the doorway.
void add_doorway(const Group& parent, const GalleryMaterials& materials) {
    const double front = hall_low.x, back = cabinet_high.x, depth = front - back;
    const auto side = [&](const std::string& name, double x, double half, double top, int wall,
                          const glm::dquat& facing) {
        for (const auto& [sign, letter] : both_sides) {
            parent.add_shape(name + "_" + letter, quad(half - door_half_width, top), wall,
                             {x, 0.5 * top, sign * 0.5 * (half + door_half_width)}, facing);
        }
        parent.add_shape(name + "_over", quad(2.0 * door_half_width, top - door_height), wall,
                         {x, 0.5 * (top + door_height), 0.0}, facing);
    };
    side("door_wall_hall", front, hall_high.z, hall_high.y, materials.wall, z_to_plus_x);
    side("door_wall_cabinet", back, cabinet_high.z, cabinet_high.y, materials.blue_wall, z_to_minus_x);
    const double x = 0.5 * (front + back);
    parent.add_shape("door_sill", quad(depth, 2.0 * door_half_width), materials.dark, {x, 0.0, 0.0}, z_to_up);
    parent.add_shape("door_head", quad(depth, 2.0 * door_half_width), materials.trim, {x, door_height, 0.0}, z_to_down);
    parent.add_shape("door_jamb_a", quad(depth, door_height), materials.trim, {x, 0.5 * door_height, -door_half_width});
    parent.add_shape("door_jamb_b", quad(depth, door_height), materials.trim, {x, 0.5 * door_height, door_half_width},
                     z_to_minus_z);
    const double h = door_half_width;
    const std::vector<glm::dvec2> path = {{-h, 0.0}, {-h, door_height}, {h, door_height}, {h, 0.0}};
    const int mesh =
        add_cage(parent.scene, "architrave", make_moulding(path, false, architrave_profile), materials.trim);
    parent.add_mesh("architrave_hall", mesh, {front, 0.0, 0.0}, z_to_plus_x);
    parent.add_mesh("architrave_cabinet", mesh, {back, 0.0, 0.0}, z_to_minus_x);
}

/// A hanging lamp: flat, shining down or tilted towards a wall; or a pyramid on its tip that shines to all sides but
/// up.
struct Lamp {
    std::string name;
    glm::dvec3 place;
    glm::dvec2 size;
    double depth;         ///< of the pyramid, m; 0: flat
    double lean_degrees;  ///< about x
    double ceiling;       ///< height, m
    int glow;             ///< material
};

void add_lamp(const Group& parent, const Lamp& look, const GalleryMaterials& materials) {
    const auto& [name, place, size, depth, lean_degrees, ceiling, glow] = look;
    const Group lamp = parent.add_group(name, place, turn(x_axis, lean_degrees));
    lamp.add_shape(name + "_box", box({size.x + 0.06, 0.06, size.y + 0.06}), materials.steel, {0.0, 0.031, 0.0});
    if (depth > 0.0) {
        const double corner = to_millionth(0.5 * std::numbers::sqrt2 * size.x);
        Shape pyramid = lathe({{0.0, -depth}, {corner, 0.0}}, 4);
        pyramid.smooth = false;
        lamp.add_shape(name + "_glow", pyramid, glow, glm::dvec3(0.0), turn(y_axis, 45.0));
    } else {
        lamp.add_shape(name + "_glow", quad(size.x, size.y), glow, glm::dvec3(0.0), z_to_down);
    }
    for (const auto& [side, letter] : both_sides) {
        const glm::dvec3 foot = place + glm::dvec3(side * 0.4 * size.x, 0.05, 0.0);
        parent.add_rod(name + "_rod_" + letter, foot, {foot.x, ceiling, foot.z}, 0.008, materials.steel);
    }
}

}  // namespace

void add_rooms(Scene& scene, const GalleryMaterials& materials) {
    const Group rooms = Group{scene}.add_group("rooms");
    const Room hall{"hall", hall_low, hall_high, hall_low.x, materials.wall};
    const Room cabinet{"cabinet", cabinet_low, cabinet_high, cabinet_high.x, materials.blue_wall};
    add_shell(rooms, hall, materials);
    add_shell(rooms, cabinet, materials);
    add_doorway(rooms, materials);
    add_trim(rooms, hall, materials.trim, materials.ceiling);
    add_trim(rooms, cabinet, materials.trim, materials.ceiling);

    // Beams: four across, two along.
    for (int i = 0; i < 4; ++i) {
        rooms.add_shape(fmt::format("beam_across_{}", i), box({0.22, 0.26, hall_high.z - hall_low.z}),
                        materials.ceiling, {-4.5 + 3.0 * i, hall_high.y - 0.13, 0.0});
    }
    for (const auto& [side, letter] : both_sides)
        rooms.add_shape("beam_along_" + letter, box({hall_high.x - hall_low.x, 0.2, 0.22}), materials.ceiling,
                        {0.0, hall_high.y - 0.1, side * 1.5});
}

void add_lamps(Scene& scene, const GalleryMaterials& materials) {
    const int warm = add_emitter(scene, "warm_glow", {1.0, 0.88, 0.7}, 10.0);
    const int day = add_emitter(scene, "day_glow", {0.86, 0.94, 1.0}, 8.0);
    const int cabinet = add_emitter(scene, "cabinet_glow", {1.0, 0.8, 0.58}, 14.0);
    const Group lamps = Group{scene}.add_group("lamps");
    // Six light the long walls, one is a skylight, one is in the cabinet.
    for (int i = 0; i < 3; ++i) {
        const double x = -3.9 + 3.9 * i;
        const std::string north = fmt::format("lamp_north_{}", i), south = fmt::format("lamp_south_{}", i);
        const glm::dvec2 size(1.5, 0.28);
        add_lamp(lamps, {north, {x, 3.62, hall_low.z + 1.35}, size, 0.0, 28.0, hall_high.y, warm}, materials);
        add_lamp(lamps, {south, {x, 3.62, hall_high.z - 1.35}, size, 0.0, -28.0, hall_high.y, warm}, materials);
    }
    add_lamp(lamps, {"lamp_skylight", {0.0, 3.85, 0.0}, {3.2, 1.1}, 0.0, 0.0, hall_high.y, day}, materials);
    add_lamp(lamps, {"lamp_cabinet", {-8.1, 3.3, 0.0}, {0.9, 0.9}, 0.36, 0.0, cabinet_high.y, cabinet}, materials);
}

}  // namespace aleph
