#include "scenes/common/generator.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "engine/load/load_scene.h"

namespace aleph {

Scene begin_scene(const std::string& name, int last_frame, double exposure, const std::string& folder,
                  const std::vector<DrawnTexture>& textures) {
    Scene scene;
    scene.source.name = name;
    scene.film.range = FrameRange{0, last_frame};
    scene.film.camera = "camera";
    scene.film.exposure = exposure;
    add_images(scene, folder, textures);
    return scene;
}

void write_scene(const std::filesystem::path& folder, const Scene& scene, const std::vector<DrawnTexture>& textures) {
    std::filesystem::create_directories(folder);
    if (!textures.empty()) {
        std::filesystem::create_directories(folder / "textures");
        write_textures(folder / "textures", textures);
    }
    save_scene(scene, folder / "scene.json");
}

int run_generator(int argc, char** argv, const char* name, const char* writes,
                  const std::function<void(const std::filesystem::path&)>& write) {
    if (argc != 2) {
        fmt::print(stderr, "usage: {} OUTPUT_FOLDER\nWrites {} there.\n", name, writes);
        return 2;
    }
    try {
        write(argv[1]);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}: {}\n", name, error.what());
        return 1;
    }
    return 0;
}

}  // namespace aleph
