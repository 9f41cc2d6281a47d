#include "scenes/antique-room/antique_room.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "scenes/common/build.h"
#include "scenes/common/keys.h"

namespace aleph {

void add_antique_camera(Scene& scene) {
    // It walks along the back of the room, and its gaze passes from the window to the bookcase.
    struct Stop {
        double frame;
        glm::dvec3 eye, target;
    };
    const Stop stops[] = {{0, {1.75, 1.55, 2.05}, {-0.75, 0.92, -0.8}},
                          {40, {1.1, 1.52, 2.0}, {-0.6, 0.94, -0.9}},
                          {80, {0.2, 1.48, 2.05}, {-0.1, 0.96, -1.0}},
                          {antique_last_frame, {-0.6, 1.45, 2.05}, {0.35, 0.98, -1.1}}};
    std::vector<double> times, yaws, pitches;
    std::vector<glm::dvec3> eyes;
    for (const Stop& stop : stops) {
        const glm::dvec3 look = glm::normalize(stop.target - stop.eye);
        times.push_back(stop.frame / 30.0);
        eyes.push_back(stop.eye);
        yaws.push_back(std::atan2(-look.x, -look.z));
        pitches.push_back(std::asin(look.y));
    }
    const int rig = add_node(scene, "camera_rig");
    scene.nodes.back().translation = eased_track(times, eyes);
    scene.nodes.back().axis_rotation = AxisRotation{{0.0, 1.0, 0.0}, eased_track(times, yaws)};
    add_node(scene, "camera", rig);
    scene.nodes.back().axis_rotation = AxisRotation{{1.0, 0.0, 0.0}, eased_track(times, pitches)};
    Camera camera;
    camera.name = "camera";
    camera.fov = glm::radians(52.0);
    scene.cameras.push_back(camera);
    scene.nodes.back().camera = 0;
}

Scene make_antique_room(const std::string& textures) {
    Scene scene;
    scene.name = "antique-room";
    scene.range = FrameRange{0, antique_last_frame};
    scene.camera = "camera";
    // By eye: the automatic exposure goes by direct light alone, and half of this room lies in the shade of the window.
    scene.exposure = 3.0;
    add_images(scene, textures, make_antique_textures());

    AntiqueMaterials materials{};
    const auto glossy = [&](int material, double roughness) {
        add_gloss(scene, roughness);
        return material;
    };
    materials.paper = add_textured(scene, "paper", "damask");
    materials.panel = glossy(add_textured(scene, "panel", "walnut"), 0.3);
    materials.walnut = glossy(add_textured(scene, "walnut", "walnut"), 0.2);
    materials.mahogany = glossy(add_lambert(scene, "mahogany", {122, 56, 34}), 0.15);
    materials.boards = glossy(add_textured(scene, "boards", "boards"), 0.16);
    materials.ceiling = add_lambert(scene, "ceiling", {232, 224, 206});
    materials.stone = glossy(add_textured(scene, "stone", "stone"), 0.25);
    materials.brass = glossy(add_lambert(scene, "brass", {198, 152, 66}), 0.2);
    materials.gilt = glossy(add_lambert(scene, "gilt", {196, 150, 74}), 0.3);
    materials.cloth = add_textured(scene, "velvet", "velvet");
    scene.materials.back().base_color = glm::dvec3(0.16, 0.3, 0.2);
    materials.leather = glossy(add_lambert(scene, "leather", {122, 40, 28}), 0.28);
    materials.ivory = add_lambert(scene, "ivory", {238, 228, 204});
    materials.black = add_lambert(scene, "iron", {36, 34, 36});
    materials.green = add_lambert(scene, "stem", {76, 112, 56});
    scene.materials.back().double_sided = true;
    materials.porcelain = glossy(add_lambert(scene, "porcelain", {196, 214, 228}), 0.12);

    add_antique_shell(scene, materials);
    add_antique_window(scene, materials);
    add_fireplace(scene, materials);
    add_antique_pictures(scene, materials);
    add_table_and_chairs(scene, materials);
    add_armchair(scene, materials);
    add_side_table(scene, materials);
    add_bookcase(scene, materials);
    add_tall_clock(scene, materials);
    add_globe(scene, materials);
    add_antique_camera(scene);
    return scene;
}

}  // namespace aleph
