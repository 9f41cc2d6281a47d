#include "scenes/art-gallery/gallery.h"

#include "scenes/common/build.h"

namespace aleph {

std::vector<DrawnTexture> make_gallery_textures() {
    return join({make_painted_pictures(), make_computed_pictures(), make_gallery_surfaces()});
}

Scene make_art_gallery(const std::string& textures) {
    // Exposure chosen by eye: the automatic one uses direct light only, which is weak on ceiling and corners.
    Scene scene = begin_scene("art-gallery", gallery_last_frame, 2.2, textures, make_gallery_textures());

    GalleryMaterials materials{};
    materials.wall = add_lambert(scene, "wall", {236, 232, 224});
    materials.blue_wall = add_lambert(scene, "blue_wall", {52, 96, 128});
    materials.ceiling = add_lambert(scene, "ceiling", {240, 238, 232});
    materials.parquet = add_textured(scene, "parquet", "parquet");
    materials.trim = add_lambert(scene, "trim", {228, 222, 210});
    materials.plinth = add_lambert(scene, "plinth", {238, 236, 230});
    materials.marble = add_textured(scene, "marble", "marble");
    materials.oak = add_textured(scene, "oak", "oak");
    materials.dark = add_lambert(scene, "dark_wood", {66, 46, 34});
    materials.steel = add_lambert(scene, "steel", {150, 152, 156});
    materials.gilt = add_lambert(scene, "gilt", {204, 160, 84}, 0.35);
    materials.black_frame = add_lambert(scene, "black_frame", {34, 32, 32});
    materials.white_frame = add_lambert(scene, "white_frame", {240, 236, 226});

    for (const auto add : {add_rooms, add_lamps, add_pictures, add_furniture, add_sculptures, add_ball_work, add_top,
                           add_kinetic_work, add_mobile})
        add(scene, materials);
    add_gallery_camera(scene);
    return scene;
}

}  // namespace aleph
