#include "scenes/antique-room/antique_room.h"

#include "scenes/common/build.h"

namespace aleph {

void add_antique_camera(Scene& scene) {
    // The camera walks along the back of the room and pans from the window to the bookcase.
    add_walking_camera(scene,
                       {{0, {1.75, 1.55, 2.05}, {-0.75, 0.92, -0.8}},
                        {40, {1.1, 1.52, 2.0}, {-0.6, 0.94, -0.9}},
                        {80, {0.2, 1.48, 2.05}, {-0.1, 0.96, -1.0}},
                        {antique_last_frame, {-0.6, 1.45, 2.05}, {0.35, 0.98, -1.1}}},
                       52.0);
}

Scene make_antique_room(const std::string& textures) {
    // Exposure chosen by eye: the automatic one uses direct light only, which does not reach half of the room.
    Scene scene = begin_scene("antique-room", antique_last_frame, 3.0, textures, make_antique_textures());

    AntiqueMaterials materials{};
    materials.paper = add_textured(scene, "paper", "damask");
    materials.panel = add_textured(scene, "panel", "walnut", 0.3);
    materials.walnut = add_textured(scene, "walnut", "walnut", 0.2);
    materials.mahogany = add_lambert(scene, "mahogany", {122, 56, 34}, 0.15);
    materials.boards = add_textured(scene, "boards", "boards", 0.16);
    materials.ceiling = add_lambert(scene, "ceiling", {232, 224, 206});
    materials.stone = add_textured(scene, "stone", "stone", 0.25);
    materials.brass = add_lambert(scene, "brass", {198, 152, 66}, 0.2);
    materials.gilt = add_lambert(scene, "gilt", {196, 150, 74}, 0.3);
    materials.cloth = add_textured(scene, "velvet", "velvet");
    scene.materials.back().base_color = glm::dvec3(0.16, 0.3, 0.2);
    materials.leather = add_lambert(scene, "leather", {122, 40, 28}, 0.28);
    materials.ivory = add_lambert(scene, "ivory", {238, 228, 204});
    materials.black = add_lambert(scene, "iron", {36, 34, 36});
    materials.green = add_lambert(scene, "stem", {76, 112, 56});
    scene.materials.back().double_sided = true;
    materials.porcelain = add_lambert(scene, "porcelain", {196, 214, 228}, 0.12);

    for (const auto add : {add_antique_shell, add_antique_window, add_fireplace, add_antique_pictures,
                           add_table_and_chairs, add_armchair, add_side_table, add_bookcase, add_tall_clock, add_globe})
        add(scene, materials);
    add_antique_camera(scene);
    return scene;
}

}  // namespace aleph
