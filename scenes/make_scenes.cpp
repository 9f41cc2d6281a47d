// Writes scenes and their textures: make_scenes OUTPUT_FOLDER [SCENE...] (usually scenes; all of them without a name).
// Deterministic: tests/scenes/scenes_test.cpp compares the bytes.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdio>
#include <exception>
#include <functional>
#include <map>
#include <ranges>
#include <string>
#include <vector>

#include "scenes/antique-room/antique_room.h"
#include "scenes/art-gallery/gallery.h"
#include "scenes/boomerang/boomerang_scene.h"
#include "scenes/common/generator.h"
#include "scenes/materials/textures.h"
#include "scenes/pool/pool_scene.h"

namespace {

using namespace aleph;
using Folder = std::filesystem::path;

const std::map<std::string, std::function<void(const Folder&)>> makers = {
    {"antique-room", [](const Folder& f) { write_scene(f, make_antique_room("textures/"), make_antique_textures()); }},
    {"art-gallery", [](const Folder& f) { write_scene(f, make_art_gallery("textures/"), make_gallery_textures()); }},
    {"boomerang",
     [](const Folder& f) { write_scene(f, make_boomerang_scene("textures/"), make_boomerang_textures()); }},
    {"materials", [](const Folder& f) { write_materials_textures(f / "textures"); }},
    {"pool", [](const Folder& f) { write_scene(f, make_pool_scene(true, "textures/"), make_pool_textures()); }},
    {"pool-still", [](const Folder& f) { write_scene(f, make_pool_scene(false, "../pool/textures/"), {}); }},
};

}  // namespace

int main(int argc, char** argv) {
    std::vector<std::string> names(argv + std::min(argc, 2), argv + argc);
    const auto all = std::views::keys(makers);
    if (argc < 2 || !std::ranges::all_of(names, [](const std::string& name) { return makers.contains(name); })) {
        fmt::print(stderr,
                   "usage: make_scenes OUTPUT_FOLDER [SCENE...]\nWrites these scenes there, or some of them: {}\n",
                   fmt::join(all, ", "));
        return 2;
    }
    if (names.empty()) names.assign(all.begin(), all.end());
    try {
        for (const std::string& name : names) makers.at(name)(Folder(argv[1]) / name);
    } catch (const std::exception& error) {
        fmt::print(stderr, "make_scenes: {}\n", error.what());
        return 1;
    }
    return 0;
}
