#include <fmt/format.h>

#include <cmath>

#include "scenes/common/build.h"
#include "scenes/pool/pool_scene.h"

namespace aleph {

namespace {

constexpr double wainscot_height = 0.95;  // m
constexpr double paper_tile = 0.6;        // m, one repeat of the wallpaper

/// One wall, seen from inside: wainscot below, wallpaper above, rails between.
struct Wall {
    const char* name;
    glm::dvec3 middle;  ///< on the floor
    double length;
    glm::dquat facing;
};

struct WallMaterials {
    int paper, panel, trim;
};

void add_wall(const Group& room, const Wall& wall, const WallMaterials& materials) {
    const Group node = room.add_group(wall.name, wall.middle, wall.facing);
    const auto name = [&](const char* part) { return fmt::format("{}_{}", wall.name, part); };
    const double paper = room_high.y - wainscot_height;
    node.add_shape(name("paper"), quad(wall.length, paper, {wall.length / paper_tile, paper / paper_tile}),
                   materials.paper, {0.0, wainscot_height + 0.5 * paper, 0.0});
    node.add_shape(name("wainscot"),
                   box({wall.length, wainscot_height - 0.12, 0.03}, {std::round(wall.length / 0.7), 1.0}),
                   materials.panel, {0.0, 0.12 + 0.5 * (wainscot_height - 0.12), 0.015});
    node.add_shape(name("skirting"), box({wall.length, 0.12, 0.04}), materials.trim, {0.0, 0.06, 0.02});
    node.add_shape(name("chair_rail"), box({wall.length, 0.06, 0.06}), materials.trim,
                   {0.0, wainscot_height + 0.03, 0.03});
    node.add_shape(name("cornice"), box({wall.length, 0.1, 0.09}), materials.trim, {0.0, room_high.y - 0.05, 0.045});
}

struct Painting {
    std::string image;
    glm::dvec3 middle;  ///< on the wall
    glm::dvec2 size;    ///< m, without the frame
    glm::dquat facing;
    int frame;  ///< material
};

void add_painting(const Group& room, const Painting& painting, int mount) {
    const auto& [image, middle, size, facing, frame] = painting;
    const int picture = add_textured(room.scene, image, image);
    const Group node = room.add_group("painting_" + image, middle, facing);
    node.add_shape(image + "_frame", box({size.x + 0.14, size.y + 0.14, 0.04}), frame, {0.0, 0.0, 0.02});
    node.add_shape(image + "_mount", box({size.x + 0.06, size.y + 0.06, 0.01}), mount, {0.0, 0.0, 0.045});
    node.add_shape(image + "_picture", quad(size.x, size.y), picture, {0.0, 0.0, 0.051});
}

/// Spare cues in a rack on the wall at z = room_high.z.
void add_cue_rack(const Group& room, double x, int wood, int ivory) {
    const Group node = room.add_group("cue_rack", {x, 0.0, room_high.z}, z_to_minus_z);
    node.add_shape("rack_top", box({0.72, 0.1, 0.05}), wood, {0.0, 1.75, 0.025});
    node.add_shape("rack_shelf", box({0.72, 0.05, 0.12}), wood, {0.0, 1.04, 0.09});
    for (int i = 0; i < 5; ++i) {
        const double place = -0.28 + 0.14 * i;
        node.add_shape(fmt::format("spare_butt_{}", i), cylinder(0.014, 0.6, 16), wood, {place, 1.365, 0.1});
        node.add_shape(fmt::format("spare_shaft_{}", i), cylinder(0.009, 0.62, 16), ivory, {place, 1.975, 0.1});
    }
}

/// A bar stool with a round seat.
void add_stool(const Group& room, const std::string& name, const glm::dvec3& place, int leather, int wood) {
    const Group node = room.add_group(name, place);
    node.add_shape(name + "_seat", cylinder(0.19, 0.07, 48), leather, {0.0, 0.74, 0.0});
    node.add_shape(name + "_disc", cylinder(0.17, 0.025, 48), wood, {0.0, 0.69, 0.0});
    node.add_shape(name + "_column", cylinder(0.03, 0.66, 24), wood, {0.0, 0.3475, 0.0});
    node.add_shape(name + "_foot", cylinder(0.2, 0.035, 48), wood, {0.0, 0.0175, 0.0});
}

}  // namespace

void add_room(Scene& scene) {
    const WallMaterials materials{add_textured(scene, "wallpaper", "wallpaper"),
                                  add_textured(scene, "wainscot", "wainscot"),
                                  add_lambert(scene, "trim", {120, 78, 48})};
    const int floor = add_textured(scene, "floor", "floor");
    const int ceiling = add_lambert(scene, "ceiling", {232, 226, 212});
    const int gilt = add_lambert(scene, "gilt", {196, 156, 84});
    const int mount = add_lambert(scene, "mount", {238, 232, 220});
    const int dark = add_lambert(scene, "dark_wood", {92, 52, 30});
    const int ivory = add_lambert(scene, "maple", {222, 190, 140});
    const int leather = add_lambert(scene, "leather", {140, 42, 34});

    const Group room = Group{scene}.add_group("room");
    const glm::dvec3 size = room_high - room_low, middle = 0.5 * (room_low + room_high);
    room.add_shape("floor", quad(size.x, size.z, {size.x / 1.2, size.z / 1.2}), floor, {middle.x, 0.0, middle.z},
                   z_to_up);
    room.add_shape("ceiling", quad(size.x, size.z), ceiling, {middle.x, room_high.y, middle.z}, z_to_down);
    add_wall(room, {"wall_far", {room_low.x, 0.0, middle.z}, size.z, z_to_plus_x}, materials);
    add_wall(room, {"wall_near", {room_high.x, 0.0, middle.z}, size.z, z_to_minus_x}, materials);
    add_wall(room, {"wall_right", {middle.x, 0.0, room_low.z}, size.x, no_turn}, materials);
    add_wall(room, {"wall_left", {middle.x, 0.0, room_high.z}, size.x, z_to_minus_z}, materials);

    add_painting(room, {"sunset", {room_low.x, 1.55, 0.75}, {1.05, 0.7}, z_to_plus_x, gilt}, mount);
    add_painting(room, {"blocks", {room_low.x, 1.55, -0.85}, {0.54, 0.72}, z_to_plus_x, dark}, mount);
    add_painting(room, {"circles", {-2.75, 1.55, room_high.z}, {0.66, 0.66}, z_to_minus_z, gilt}, mount);
    add_cue_rack(room, -1.35, dark, ivory);
    add_stool(room, "stool_a", {-3.05, 0.0, -1.9}, leather, dark);
    add_stool(room, "stool_b", {-2.35, 0.0, -2.25}, leather, dark);
}

void add_lights(Scene& scene) {
    // Over the table: a shade with an emissive underside. Flush, because walls close to an emitter add noise.
    const int shade = add_lambert(scene, "shade", {34, 92, 70});
    const int brass = add_lambert(scene, "brass", {190, 148, 74});
    const int glow = add_emitter(scene, "lamp_glow", {1.0, 0.87, 0.66}, 14.0);
    const glm::dvec3 size(1.7, 0.2, 0.5);
    const double bottom = cloth_height + 0.9, cord = room_high.y - bottom - size.y;
    const Group lamp = Group{scene}.add_group("lamp", {0.0, bottom, 0.0});
    lamp.add_shape("lamp_shade", box(size), shade, {0.0, 0.5 * size.y, 0.0});
    lamp.add_shape("lamp_panel", quad(size.x - 0.1, size.z - 0.1), glow, {0.0, -0.001, 0.0}, z_to_down);
    for (const auto& [side, letter] : both_sides) {
        lamp.add_shape("lamp_cord_" + letter, cylinder(0.006, cord, 12), brass, {side * 0.6, size.y + 0.5 * cord, 0.0});
        lamp.add_shape("lamp_trim_" + letter, box({size.x + 0.02, 0.02, 0.01}), brass,
                       {0.0, 0.02, side * (0.5 * size.z + 0.005)});
    }

    // A soft ceiling light over the sitting corner, so that the walls are not too dark.
    const int frame = add_lambert(scene, "light_frame", {226, 220, 206});
    const int soft = add_emitter(scene, "ceiling_glow", {1.0, 0.9, 0.76}, 5.0);
    const Group panel = Group{scene}.add_group("ceiling_light", {-2.1, room_high.y, 0.2});
    panel.add_shape("ceiling_light_frame", box({1.5, 0.04, 1.5}), frame, {0.0, -0.02, 0.0});
    panel.add_shape("ceiling_light_panel", quad(1.4, 1.4), soft, {0.0, -0.041, 0.0}, z_to_down);

    // A tall window in the evening; its bars are a little in front of the sky.
    const int sky = add_emitter(scene, "evening_sky", glm::dvec3(1.0), 0.4, "sky");
    const Group window = Group{scene}.add_group("window", {-1.9, 1.75, room_low.z});
    const double width = 1.5, height = 1.4;
    window.add_shape("window_sky", quad(width, height), sky, {0.0, 0.0, 0.01});
    for (const double side : {-1.0, 0.0, 1.0}) {
        const int i = static_cast<int>(side) + 1;
        window.add_shape(fmt::format("window_post_{}", i), box({0.05, height, 0.02}), frame,
                         {side * 0.5 * (width - 0.05), 0.0, 0.1});
        window.add_shape(fmt::format("window_bar_{}", i), box({width + 0.1, 0.06, 0.03}), frame,
                         {0.0, side * 0.5 * (height + 0.06), 0.1});
    }
}

}  // namespace aleph
