// Writes the scene `art-gallery` and its textures: make_art_gallery OUTPUT_FOLDER (usually scenes).
// The same bytes every time; tests/unit/gallery_scenes_test.cpp holds it to that.

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "engine/archive.h"
#include "scenes/art-gallery/gallery.h"
#include "scenes/art-gallery/pictures.h"

int main(int argc, char** argv) {
    using namespace aleph;
    if (argc != 2) {
        std::fputs("usage: make_art_gallery OUTPUT_FOLDER\nWrites art-gallery/ there.\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / "art-gallery";
        std::filesystem::create_directories(folder / "textures");
        write_textures(folder / "textures", make_painted_pictures());
        write_textures(folder / "textures", make_computed_pictures());
        write_textures(folder / "textures", make_gallery_surfaces());
        save_scene(make_art_gallery("textures/"), folder / "scene.json");
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_art_gallery: {}\n", error.what());
        return 1;
    }
    return 0;
}
