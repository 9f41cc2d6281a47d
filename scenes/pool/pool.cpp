// Writes the scenes `pool` and `pool-still` and their textures: make_pool OUTPUT_FOLDER (usually scenes).
// Deterministic: tests/scenes/scenes_test.cpp compares the bytes.

#include "scenes/common/generator.h"
#include "scenes/pool/pool_scene.h"

int main(int argc, char** argv) {
    using namespace aleph;
    return run_generator(argc, argv, "make_pool", "pool/ and pool-still/", [](const std::filesystem::path& output) {
        write_scene(output / "pool", make_pool_scene(true, "textures/"), make_pool_textures());
        write_scene(output / "pool-still", make_pool_scene(false, "../pool/textures/"), {});
    });
}
