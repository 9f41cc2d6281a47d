// Work that grows no faster than the scene: bytes allocated for deep and for wide scenes of n and 2n nodes.

#include <atomic>
#include <cstdlib>
#include <new>

#include "engine/load/load_scene.h"
#include "render/cli/explain/explain.h"
#include "render/output/frame_files.h"
#include "render/surface/node_paths.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace {

std::atomic<std::size_t> allocated = 0;

}  // namespace

// Not inlined: GCC would take malloc and delete, or new and free, for a pair that does not match.
[[gnu::noinline]] void* operator new(std::size_t size) {
    allocated += size;
    if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
    throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
    std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
    std::free(memory);
}

namespace aleph {
namespace {

constexpr int few = 1500;

/// A glTF file of nodes without names that all show one triangle.
std::string gltf_text(int count, bool deep) {
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

/// A scene file of nodes, each the parent of the next one if it is deep.
std::string scene_text(int count, bool deep) {
    std::string nodes;
    for (int i = 0; i < count; ++i) {
        const std::string number = std::to_string(i);
        nodes += (i == 0 ? "{\"name\": \"n" : ", {\"name\": \"n") + number + "\", \"mesh\": \"box\"";
        if (deep && i > 0) nodes += ", \"parent\": \"n" + std::to_string(i - 1) + "\"";
        nodes += "}";
    }
    return R"({"aleph": 1, "meshes": {"box": {"shape": {"type": "box"}}}, "nodes": [)" + nodes + "]}";
}

/// The size of all allocations of some work, bytes.
std::size_t bytes_of(const std::function<void()>& work) {
    const std::size_t before = allocated;
    work();
    return allocated - before;
}

struct Cost {
    std::size_t load, explain, moment, frame;
};

Cost cost_of(const std::filesystem::path& file, const std::string& text) {
    std::ofstream(file) << text;
    Scene scene;
    Cost cost{};
    cost.load = bytes_of([&] { scene = load_scene(file); });
    cost.explain = bytes_of([&] {
        RenderSettings settings;
        settings.picture.width = settings.picture.height = 4;
        explain_text(explain_scene(scene, settings, "", {}), 0);
    });
    cost.moment = bytes_of([&] { explain_moment(scene, 0.0); });
    cost.frame = bytes_of([&] {
        FrameOutput output;
        output.hits = Image<Hit>(1, 1);
        make_frame_image(output, true, scene, RenderSettings(), 1.0);
    });
    return cost;
}

TEST(Growth, TwiceTheNodesCostAtMostTwiceTheBytesAndATenth) {
    const ScratchFolder folder;
    for (const bool deep : {false, true}) {
        for (const bool gltf : {false, true}) {
            const auto cost = [&](int count) {
                return gltf ? cost_of(folder / "scene.gltf", gltf_text(count, deep))
                            : cost_of(folder / "scene.json", scene_text(count, deep));
            };
            const Cost once = cost(few), twice = cost(2 * few);
            SCOPED_TRACE(std::string(gltf ? "glTF, " : "scene file, ") + (deep ? "deep" : "wide"));
            const auto check = [&](const char* part, std::size_t Cost::*bytes) {
                EXPECT_LE(static_cast<double>(twice.*bytes), 2.2 * static_cast<double>(once.*bytes))
                    << part << ": " << once.*bytes << " and " << twice.*bytes << " bytes";
            };
            check("loading", &Cost::load);
            check("explain", &Cost::explain);
            check("explain --at", &Cost::moment);
            check("a frame's file", &Cost::frame);
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

}  // namespace
}  // namespace aleph
