// Writes the scene `boomerang` and its textures: make_boomerang OUTPUT_FOLDER (usually scenes).
// The same bytes every time; tests/unit/boomerang_scene_test.cpp holds it to that.

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "engine/archive.h"
#include "scenes/boomerang/boomerang_scene.h"

int main(int argc, char** argv) {
    using namespace aleph;
    if (argc != 2) {
        std::fputs("usage: make_boomerang OUTPUT_FOLDER\nWrites boomerang/ there.\n", stderr);
        return 2;
    }
    try {
        const std::filesystem::path folder = std::filesystem::path(argv[1]) / "boomerang";
        std::filesystem::create_directories(folder / "textures");
        write_textures(folder / "textures", make_boomerang_textures());
        save_scene(make_boomerang_scene("textures/"), folder / "scene.json");
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_boomerang: {}\n", error.what());
        return 1;
    }
    return 0;
}
