// Writes the scene `antique-room` and its textures: make_antique_room OUTPUT_FOLDER (usually scenes).
// Deterministic: tests/scenes/scenes_test.cpp compares the bytes.

#include "scenes/antique-room/antique_room.h"
#include "scenes/common/generator.h"

int main(int argc, char** argv) {
    using namespace aleph;
    return run_generator(argc, argv, "make_antique_room", "antique-room/", [](const std::filesystem::path& output) {
        write_scene(output / "antique-room", make_antique_room("textures/"), make_antique_textures());
    });
}
