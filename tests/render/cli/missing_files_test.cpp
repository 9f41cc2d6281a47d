// `aleph explain` lists the missing files of a scene that is refused: within the limits of memory that refused it.
// `aleph explain`: the files that a scene names and that are not there.

#include "engine/load/load_scene.h"
#include "render/cli/explain/explain.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// 30 MB of text whose values would take a gigabyte, and a buffer that is not there.
std::string hostile_gltf() {
    std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "absent.bin"}], )";
    text += R"("extras": [[])";
    for (int i = 0; i < 10'000'000; ++i) text += ",{}";
    return text + "]}";
}

/// Does what `aleph explain` does with a file.
void explain(const fs::path& path, const LoadLimits& limits) {
    try {
        load_scene(path, limits);
    } catch (const InputError&) {
        list_missing_files(path, limits);
        throw;
    }
}

TEST(MissingFiles, S13_11_RefusedTextsAreNotParsedForTheirMissingFiles) {
    const ScratchFolder folder;
    const std::string text = hostile_gltf();
    write_text(folder / "hostile.gltf", text);
    std::string binary = "glTF";
    for (const std::uint32_t number : {2u, static_cast<std::uint32_t>(20 + (text.size() + 3) / 4 * 4),
                                       static_cast<std::uint32_t>((text.size() + 3) / 4 * 4), 0x4e4f534au})
        for (int i = 0; i < 4; ++i) binary += static_cast<char>(number >> 8 * i & 255);
    binary += text;
    binary.resize((binary.size() + 3) / 4 * 4, ' ');
    write_text(folder / "hostile.glb", binary);
    std::string includes;
    for (int i = 0; i < 200; ++i) includes += fmt::format("{}\"{}hostile.gltf\"", i == 0 ? "" : ",", i % 2 ? "./" : "");
    write_text(folder / "scene.json", "{\"aleph\": 1, \"include\": [" + includes + "]}");
    for (const char* name : {"hostile.gltf", "hostile.glb", "scene.json"}) {
        const LoadCost cost = load_cost([&] { explain(folder / name, {}); });
        EXPECT_TRUE(cost.refused()) << name;
        EXPECT_NE(cost.refusal.message.find("MiB"), std::string::npos) << cost.refusal.message;
        expect_bounded(cost, name);
    }
}

TEST(MissingFiles, TheLimitIsThatOfLoading) {
    const ScratchFolder folder;
    std::string text = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "absent.bin"}], )";
    text += "\"extras\": [0";
    for (int i = 0; i < 200000; ++i) text += ",0";
    write_text(folder / "numbers.gltf", text + "]}");
    EXPECT_EQ(list_missing_files(folder / "numbers.gltf").size(), 1u);
    EXPECT_TRUE(list_missing_files(folder / "numbers.gltf", {std::size_t{16} << 20}).empty());
}

TEST(MissingFiles, AFileThatIsIncludedTwiceIsListedOnce) {
    const ScratchFolder folder;
    write_text(folder / "part.gltf",
               R"({"asset": {"version": "2.0"}, "images": [{"uri": "a.png"}, {"uri": "b.png"}]})");
    write_text(folder / "broken.gltf", "no glTF");
    write_text(folder / "scene.json",
               R"({"aleph": 1, "include": ["broken.gltf", "part.gltf", "./part.gltf", "absent.glb"]})");
    std::vector<std::string> names;
    for (const MissingFile& missing : list_missing_files(folder / "scene.json")) names.push_back(missing.path);
    EXPECT_EQ(names, (std::vector<std::string>{"a.png", "b.png", "absent.glb"}));
}

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
