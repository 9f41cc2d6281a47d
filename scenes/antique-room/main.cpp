// Writes the scene `antique-room` and its textures: make_antique_room OUTPUT_FOLDER (usually scenes).
// The same bytes every time; tests/unit/gallery_scenes_test.cpp holds it to that.

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "engine/archive.h"
#include "scenes/antique-room/antique_room.h"

int main(int argc, char** argv) {
    using namespace aleph;
    if (argc != 2) {
        std::fputs("usage: make_antique_room OUTPUT_FOLDER\nWrites antique-room/ there.\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / "antique-room";
        std::filesystem::create_directories(folder / "textures");
        write_textures(folder / "textures", make_antique_textures());
        save_scene(make_antique_room("textures/"), folder / "scene.json");
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_antique_room: {}\n", error.what());
        return 1;
    }
    return 0;
}
