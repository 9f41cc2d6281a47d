// Work that grows no faster than the scene: bytes allocated for deep and for wide scenes of n and 2n nodes.
// `aleph explain` lists the missing files of a scene that is refused, within the limits of memory that refused it.

#include "engine/load/load_scene.h"
#include "render/cli/explain/explain.h"
#include "render/output/frame_files.h"
#include "render/surface/node_paths.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

constexpr int few = 1500;

std::string gltf_of_nodes(int count, bool deep) {
    std::string nodes, roots = "0";
    for (int i = 0; i < count; ++i) {
        nodes += i == 0 ? "{\"mesh\": 0" : ", {\"mesh\": 0";
        if (deep && i + 1 < count) nodes += ", \"children\": [" + std::to_string(i + 1) + "]";
        nodes += "}";
        if (!deep && i > 0) roots += ", " + std::to_string(i);
    }
    return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [)" + roots + "]}], \"nodes\": [" + nodes +
           R"(], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [0, 0, 0]}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"byteLength": 36, "uri": "data:application/octet-stream;base64,)" +
           std::string(48, 'A') + "\"}]}";
}

std::string scene_of_nodes(int count, bool deep) {
    std::string nodes;
    for (int i = 0; i < count; ++i) {
        const std::string number = std::to_string(i);
        nodes += (i == 0 ? "{\"name\": \"n" : ", {\"name\": \"n") + number + "\", \"mesh\": \"box\"";
        if (deep && i > 0) nodes += ", \"parent\": \"n" + std::to_string(i - 1) + "\"";
        nodes += "}";
    }
    return R"({"aleph": 1, "meshes": {"box": {"shape": {"type": "box"}}}, "nodes": [)" + nodes + "]}";
}

using Costs = std::vector<std::pair<std::string, std::size_t>>;

Costs costs_of(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
    Scene scene;
    Costs costs;
    const auto add = [&](const char* part, const std::function<void()>& work) {
        costs.emplace_back(part, count_allocations(work).bytes);
    };
    add("loading", [&] { scene = load_scene(file); });
    add("explain", [&] {
        RenderSettings settings;
        settings.picture.width = settings.picture.height = 4;
        explain_text(explain_scene(scene, settings, "", {}), 0);
    });
    add("explain --at", [&] { explain_moment(scene, 0.0); });
    add("a frame's file", [&] {
        FrameOutput output;
        output.hits = Image<Hit>(1, 1);
        make_frame_image(output, true, scene, RenderSettings(), 1.0);
    });
    return costs;
}

TEST(Growth, TwiceTheNodesCostAtMostTwiceTheBytesAndATenth) {
    const ScratchFolder folder;
    for (const bool deep : {false, true}) {
        for (const bool gltf : {false, true}) {
            SCOPED_TRACE(std::string(gltf ? "glTF, " : "scene file, ") + (deep ? "deep" : "wide"));
            const auto costs = [&](int count) {
                return gltf ? costs_of(folder / "scene.gltf", gltf_of_nodes(count, deep))
                            : costs_of(folder / "scene.json", scene_of_nodes(count, deep));
            };
            const Costs once = costs(few), twice = costs(2 * few);
            for (std::size_t i = 0; i < once.size(); ++i)
                EXPECT_LE(static_cast<double>(twice[i].second), 2.2 * static_cast<double>(once[i].second))
                    << once[i].first << ": " << once[i].second << " and " << twice[i].second << " bytes";
        }
    }
}

TEST(Growth, LongPathsAreShortenedInTheMiddleAndStillDiffer) {
    Scene scene;
    for (int i = 0; i < 200; ++i) {
        scene.nodes.push_back({.name = "é" + std::to_string(i), .parent = i - 1});
    }
    scene.nodes.push_back(scene.nodes.back());
    const NodePaths paths(scene);
    std::set<std::string> all;
    std::string whole;
    for (std::size_t i = 0; i < 200; ++i) {
        whole += "/" + scene.nodes[i].name;
        const std::string path = paths[i];
        EXPECT_TRUE(all.insert(path).second) << path;
        if (whole.size() <= NodePaths::longest_path) {
            EXPECT_EQ(path, whole);
            continue;
        }
        EXPECT_LE(path.size(), NodePaths::longest_path);
        const std::size_t dots = path.find("..."), name = path.rfind("...") + 3;
        EXPECT_EQ(name - dots, 22u) << path;
        EXPECT_GE(dots, NodePaths::kept_of_path - 3);
        EXPECT_EQ(path.substr(0, dots), whole.substr(0, dots));
        EXPECT_TRUE(whole.ends_with(path.substr(name))) << path;
        for (const std::size_t at : {dots, whole.size() - (path.size() - name)})  // no character is split
            EXPECT_NE(static_cast<unsigned char>(whole[at]) & 0xc0, 0x80) << path;
    }
    EXPECT_TRUE(all.insert(paths[200]).second);
    EXPECT_TRUE(paths[200].ends_with("/é199#2")) << paths[200];
    EXPECT_EQ(paths.depth(200), 199u);
}

TEST(Growth, NumbersAndNamesThatLookLikeThemDiffer) {
    Scene scene;
    for (const char* name : {"a#2", "a", "a", "a", "a#2"}) scene.nodes.emplace_back().name = name;
    const NodePaths paths(scene);
    std::vector<std::string> all;
    for (std::size_t i = 0; i < scene.nodes.size(); ++i) all.push_back(paths[i]);
    EXPECT_EQ(all, (std::vector<std::string>{"/a#2", "/a", "/a#3", "/a#4", "/a#2#2"}));
}

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
