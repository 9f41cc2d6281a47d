// Writes the scene `art-gallery` and its textures: make_art_gallery OUTPUT_FOLDER (usually scenes).
// Deterministic: tests/scenes/scenes_test.cpp compares the bytes.

#include "scenes/art-gallery/gallery.h"
#include "scenes/common/generator.h"

int main(int argc, char** argv) {
    using namespace aleph;
    return run_generator(argc, argv, "make_art_gallery", "art-gallery/", [](const std::filesystem::path& output) {
        write_scene(output / "art-gallery", make_art_gallery("textures/"), make_gallery_textures());
    });
}
