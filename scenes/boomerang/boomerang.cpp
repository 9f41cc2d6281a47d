// Writes the scene `boomerang` and its textures: make_boomerang OUTPUT_FOLDER (usually scenes).
// Deterministic: tests/scenes/scenes_test.cpp compares the bytes.

#include "scenes/boomerang/boomerang_scene.h"
#include "scenes/common/generator.h"

int main(int argc, char** argv) {
    using namespace aleph;
    return run_generator(argc, argv, "make_boomerang", "boomerang/", [](const std::filesystem::path& output) {
        write_scene(output / "boomerang", make_boomerang_scene("textures/"), make_boomerang_textures());
    });
}
