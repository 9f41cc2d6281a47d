// Writes the scenes `pool` and `pool-still` and their textures: make_pool OUTPUT_FOLDER (usually scenes).
// The same bytes every time; tests/unit/scenes_test.cpp holds it to that.

#include <fmt/format.h>

#include <cstdio>
#include <exception>
#include <filesystem>

#include "engine/archive.h"
#include "scenes/pool/pool_scene.h"
#include "scenes/pool/textures.h"

namespace aleph {

namespace {

void write_scenes(const std::filesystem::path& output) {
    std::filesystem::create_directories(output / "pool" / "textures");
    std::filesystem::create_directories(output / "pool-still");
    write_textures(output / "pool" / "textures", make_room_textures());
    write_textures(output / "pool" / "textures", make_ball_textures());
    save_scene(make_pool_scene(true, "textures/"), output / "pool" / "scene.json");
    save_scene(make_pool_scene(false, "../pool/textures/"), output / "pool-still" / "scene.json");
}

}  // namespace

}  // namespace aleph

int main(int argc, char** argv) {
    if (argc != 2) {
        std::fputs("usage: make_pool OUTPUT_FOLDER\nWrites pool/ and pool-still/ there.\n", stderr);
        return 2;
    }
    try {
        aleph::write_scenes(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_pool: {}\n", error.what());
        return 1;
    }
    return 0;
}
