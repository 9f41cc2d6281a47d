// `aleph explain`: the files that a scene names and that are not there.

#include <gtest/gtest.h>

#include <fstream>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/cli/explain/explain.h"
#include "tests/support/scratch_folder.h"

namespace aleph {
namespace {

TEST(Explain, ListsEveryMissingFile) {
    const ScratchFolder folder;
    const auto write = [&](const char* name, const char* text) { std::ofstream(folder.path() / name) << text; };
    write("inner.gltf", R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "gone.bin"}]})");
    write("scene.json", R"({"images": {"a": "gone.png", "b": "too.png"}, "environment_image": "sky.exr",
        "aleph": 1, "nodes": [{"name": "n", "include": "inner.gltf"}, {"name": "m", "include": "gone.glb"}]})");
    const std::vector<MissingFile> missing = list_missing_files(folder.path() / "scene.json");
    std::vector<std::string> paths;
    for (const MissingFile& item : missing) paths.push_back(item.path);
    const std::vector<std::string> expected = {"gone.png", "too.png", "sky.exr", "gone.bin", "gone.glb"};
    EXPECT_EQ(paths, expected);
    EXPECT_THROW(load_scene(folder.path() / "scene.json"), InputError);
    EXPECT_TRUE(list_missing_files(folder.path() / "nothing.json").empty());
}

}  // namespace
}  // namespace aleph
