// Paintings in their frames, furniture and plants.

#include <fmt/format.h>

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/build.h"
#include "scenes/common/cages.h"
#include "scenes/common/keys.h"
#include "scenes/common/texture_tools.h"

namespace aleph {

namespace {

// Profiles: outwards from the edge of the picture, and away from the wall.
const Profile gilt_profile = {{0.0, 0.008},  {0.0, 0.018},   {0.0, 0.018},   {0.012, 0.022}, {0.02, 0.03},
                              {0.034, 0.03}, {0.05, 0.05},   {0.075, 0.062}, {0.095, 0.05},  {0.1, 0.035},
                              {0.11, 0.03},  {0.115, 0.015}, {0.115, 0.0},   {0.115, 0.0}};
const Profile plain_profile = {{0.0, 0.008},   {0.0, 0.034},  {0.0, 0.034},  {0.005, 0.038},
                               {0.035, 0.038}, {0.04, 0.034}, {0.04, 0.034}, {0.04, 0.0}};

struct Hanging {
    const char* image;
    glm::dvec3 middle;  ///< on the wall
    glm::dvec2 size;    ///< m, without the frame
    int wall;           ///< 0 north, 1 south, 2 far, 3 near
    int frame;          ///< 0 gilt, 1 black, 2 white
};

const Hanging hangings[] = {
    {"phyllotaxis", {4.9, 1.62, hall_low.z}, {1.0, 1.0}, 0, 2},
    {"ridges", {2.85, 1.66, hall_low.z}, {1.85, 1.0}, 0, 0},
    {"truchet", {0.75, 1.66, hall_low.z}, {0.96, 1.28}, 0, 1},
    {"fields", {-0.75, 1.68, hall_low.z}, {1.04, 1.36}, 0, 1},
    {"panes", {-4.85, 1.68, hall_low.z}, {0.96, 1.28}, 0, 1},
    {"city", {4.3, 1.66, hall_high.z}, {1.6, 1.12}, 1, 1},
    {"seigaiha", {1.2, 1.8, hall_high.z}, {1.95, 1.3}, 1, 0},
    {"quilt", {-1.35, 1.66, hall_high.z}, {1.1, 1.1}, 1, 2},
    {"harmonograph", {-3.2, 1.66, hall_high.z}, {1.1, 1.1}, 1, 1},
    {"packing", {-4.95, 1.66, hall_high.z}, {0.9, 1.14}, 1, 2},
    {"pour", {hall_low.x, 1.66, -2.45}, {1.3, 1.3}, 2, 1},
    {"waves", {hall_low.x, 1.66, 2.5}, {1.1, 1.1}, 2, 1},
    {"julia", {hall_high.x, 1.66, 0.0}, {1.9, 1.29}, 3, 0},
    {"flow", {cabinet_low.x, 1.75, 0.0}, {2.0, 2.0}, 2, 0},
};

struct PlantParts {
    int leaf;              ///< mesh
    int pot, earth, stem;  ///< materials
};

/// Long leaves on thin stems in a pot.
void add_plant(const Group& plants, const std::string& name, const glm::dvec3& place, const PlantParts& parts,
               std::uint32_t seed) {
    const Group plant = plants.add_group(name, place);
    const Profile pot_outline = {{0.0, 0.0},   {0.17, 0.0},   {0.17, 0.0},    {0.19, 0.06}, {0.235, 0.3}, {0.25, 0.38},
                                 {0.265, 0.4}, {0.265, 0.42}, {0.245, 0.425}, {0.235, 0.4}, {0.23, 0.36}};
    plant.add_shape(name + "_pot", lathe(pot_outline, 48), parts.pot);
    plant.add_shape(name + "_earth", cylinder(0.231, 0.02, 32), parts.earth, {0.0, 0.37, 0.0});
    for (int i = 0; i < 34; ++i) {
        const double around = i * 137.508, high = pick(seed, i), wide = pick(seed, i, 1);
        const double reach = 0.05 + 0.2 * wide, top = 0.62 + 0.75 * high;
        const glm::dvec3 out(std::sin(around * pi / 180.0), 0.0, std::cos(around * pi / 180.0));
        const glm::dvec3 foot = glm::dvec3(0.0, 0.38, 0.0) + 0.06 * out;
        const glm::dvec3 tip = to_millionth(glm::dvec3(0.0, top, 0.0) + (0.06 + reach) * out);
        plant.add_rod(fmt::format("{}_stem_{}", name, i), foot, tip, 0.006, parts.stem, 6);
        const double lean = 38.0 + 55.0 * wide * (1.2 - 0.5 * high);
        plant.add_mesh(fmt::format("{}_leaf_{}", name, i), parts.leaf, tip,
                       turn(y_axis, std::fmod(around, 360.0)) * turn(x_axis, lean));
    }
}

void add_couch(Scene& scene, const GalleryMaterials& materials) {
    const int cloth = add_textured(scene, "couch_cloth", "weave");
    scene.materials.back().base_color = glm::dvec3(0.11, 0.34, 0.36);
    const int pillow_cloth = add_textured(scene, "pillow_cloth", "weave");
    scene.materials.back().base_color = glm::dvec3(0.95, 0.5, 0.07);
    const double tile = 6.0;  // repeats of the weave per metre
    for (const int material : {cloth, pillow_cloth})
        scene.materials[material].textures[TextureSlot::base_color].uv_scale = glm::dvec2(tile);

    const Group couch = Group{scene}.add_group("couch", {1.2, 0.0, 3.05}, turn(y_axis, 180.0));
    add_cage_node(couch, "couch_base", make_cushion({2.0, 0.2, 0.84}, 0.03, {0.0, 0.0, 0.0}), cloth, {0.0, 0.24, 0.0});
    add_cage_node(couch, "couch_back", make_cushion({2.04, 0.62, 0.22}, 0.07, {0.0, 0.03, 0.01}), cloth,
                  {0.0, 0.5, -0.36}, turn(x_axis, -9.0));
    const int arm = add_cage(scene, "couch_arm", make_cushion({0.22, 0.5, 0.88}, 0.07, {0.015, 0.01, 0.01}), cloth);
    const int seat =
        add_cage(scene, "couch_seat", make_cushion({0.655, 0.19, 0.68}, 0.05, {0.012, 0.045, 0.02}, 2), cloth);
    const int rest =
        add_cage(scene, "couch_rest", make_cushion({0.655, 0.42, 0.17}, 0.05, {0.015, 0.02, 0.07}, 2), cloth);
    const int pillow =
        add_cage(scene, "couch_pillow", make_cushion({0.42, 0.42, 0.08}, 0.03, {-0.02, -0.02, 0.11}, 2), pillow_cloth);
    const Group foot = couch.add_group("couch_feet");
    for (const auto& [side, letter] : both_sides) {
        couch.add_mesh("couch_arm_" + letter, arm, {side * 1.1, 0.37, 0.0});
        for (const auto& [end, end_letter] : both_sides) {
            const Profile foot_outline = {{0.0, 0.0},    {0.024, 0.0}, {0.024, 0.0}, {0.034, 0.03},
                                          {0.022, 0.05}, {0.04, 0.1},  {0.04, 0.15}};
            foot.add_shape("couch_foot_" + letter + end_letter, lathe(foot_outline, 24), materials.oak,
                           {side * 1.08, 0.0, end * 0.36});
        }
    }
    for (int i = 0; i < 3; ++i) {
        couch.add_mesh(fmt::format("couch_seat_{}", i), seat, {(i - 1) * 0.66, 0.405, 0.08});
        couch.add_mesh(fmt::format("couch_rest_{}", i), rest, {(i - 1) * 0.66, 0.66, -0.2}, turn(x_axis, -14.0));
    }
    couch.add_mesh("couch_pillow_a", pillow, {0.8, 0.66, 0.02},
                   turn(y_axis, -28.0) * turn(x_axis, -20.0) * turn(z_axis, 8.0));
    couch.add_mesh("couch_pillow_b", pillow, {-0.82, 0.66, 0.0},
                   turn(y_axis, 34.0) * turn(x_axis, -22.0) * turn(z_axis, -12.0));
}

void add_bench(Scene& scene, const std::string& name, const glm::dvec3& place, double degrees, int seat,
               const GalleryMaterials& materials) {
    const Group bench = Group{scene}.add_group(name, place, turn(y_axis, degrees));
    bench.add_mesh(name + "_seat", seat, {0.0, 0.44, 0.0});
    for (const auto& [side, letter] : both_sides) {
        bench.add_shape(name + "_leg_" + letter, box({0.06, 0.4, 0.36}), materials.dark, {side * 0.62, 0.2, 0.0});
    }
    bench.add_shape(name + "_rail", box({1.2, 0.05, 0.05}), materials.dark, {0.0, 0.16, 0.0});
}

}  // namespace

void add_pictures(Scene& scene, const GalleryMaterials& materials) {
    const Group pictures = Group{scene}.add_group("pictures");
    const glm::dquat facing[] = {no_turn, z_to_minus_z, z_to_plus_x, z_to_minus_x};
    const int frames[] = {materials.gilt, materials.black_frame, materials.white_frame};
    for (const Hanging& hanging : hangings) {
        const std::string name = hanging.image;
        const int paint = add_textured(scene, name, name);
        const Group node = pictures.add_group("picture_" + name, hanging.middle, facing[hanging.wall]);
        node.add_shape(name + "_canvas", quad(hanging.size.x, hanging.size.y), paint, {0.0, 0.0, 0.012});
        const CageShape moulding =
            make_rectangle_moulding(hanging.size, hanging.frame == 0 ? gilt_profile : plain_profile, true);
        add_cage_node(node, name + "_frame", moulding, frames[hanging.frame]);
        node.add_shape(name + "_label", box({0.12, 0.08, 0.006}), materials.white_frame,
                       {0.5 * hanging.size.x + 0.24, -0.5 * hanging.size.y + 0.04, 0.003});
    }
}

void add_furniture(Scene& scene, const GalleryMaterials& materials) {
    add_couch(scene, materials);
    const int seat =
        add_cage(scene, "bench_seat", make_cushion({1.5, 0.09, 0.42}, 0.02, glm::dvec3(0.0)), materials.oak);
    add_bench(scene, "bench_a", {3.1, 0.0, 1.55}, 90.0, seat, materials);
    add_bench(scene, "bench_b", {-8.0, 0.0, 1.5}, 0.0, seat, materials);

    const int leaf_green = add_lambert(scene, "leaf", {72, 128, 52});
    scene.materials.back().double_sided = true;
    const int pot = add_lambert(scene, "pot", {226, 220, 208});
    const int earth = add_lambert(scene, "earth", {58, 42, 32});
    const int stem = add_lambert(scene, "stem", {92, 118, 60});
    const int leaf = add_cage(scene, "leaf", make_leaf(0.44, 0.15, 0.42), leaf_green);
    const PlantParts parts{leaf, pot, earth, stem};
    const Group plants = Group{scene}.add_group("plants");
    add_plant(plants, "plant_a", {-5.2, 0.0, -1.8}, parts, 301);
    add_plant(plants, "plant_b", {2.95, 0.0, 3.0}, parts, 302);
    add_plant(plants, "plant_c", {-9.4, 0.0, -1.8}, parts, 303);
}

}  // namespace aleph
