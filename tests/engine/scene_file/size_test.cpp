// Hostile scene files of the largest size that is parsed: each is read or refused within the limits of
// load_cost.h.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdio>
#include <functional>
#include <string>

#include "engine/base/errors.h"
#include "engine/json/memory.h"
#include "engine/scene_file/scene_text.h"
#include "tests/support/files/load_cost.h"
#include "tests/support/refusal.h"

namespace aleph {
namespace {

/// Makes the text and reads it; both count.
LoadCost read_text(const std::function<std::string()>& make) {
    return load_cost([&] { read_scene_text(make(), "hostile.json"); });
}

std::string repeated(const std::string& head, const std::string& piece, const std::string& tail, std::size_t bytes) {
    std::string text = "{\"aleph\": 1, " + head;
    text.reserve(bytes + piece.size() + tail.size());
    while (text.size() + piece.size() + tail.size() < bytes) text += piece;
    text += tail;
    return text;
}

struct Hostile {
    const char* name;
    std::string head, piece, tail;
};

TEST(HostileSceneFile, StaysWithinTheLimits) {
    const std::vector<Hostile> files = {
        {"numbers", "\"meshes\": {\"m\": {\"shape\": {\"type\": \"mesh\", \"triangles\": [], \"positions\": [0,0", ",0",
         "]}}}}"},
        {"long numbers", "\"meshes\": {\"m\": {\"shape\": {\"type\": \"mesh\", \"triangles\": [], \"positions\": [0,0",
         ",-1.2345678901234567e-5", "]}}}}"},
        {"groups", "\"meshes\": {\"m\": {\"shape\": {\"type\": \"mesh\", \"triangles\": [], \"positions\": [[0,0,0]",
         ",[0,0,0]", "]}}}}"},
        {"vertex points",
         "\"points\": {\"p\": [0,0,0]}, \"meshes\": {\"m\": {\"shape\": {\"type\": \"mesh\", \"points\": \"p\", "
         "\"triangles\": [], \"vertex_points\": [0",
         ",0", "]}}}}"},
        {"keys", "\"nodes\": [{\"scale\": {\"values\": [1", ",1", "]}}]}"},
        {"nodes", "\"nodes\": [{}", ",{}", "]}"},
        {"boxes", "\"nodes\": [{}", ",{\"shape\":{\"type\":\"box\"}}", "]}"},
        {"spheres", "\"nodes\": [{}", ",{\"shape\":{\"type\":\"sphere\",\"segments\":512}}", "]}"},
        {"shared", "\"meshes\": {\"a\": {\"shape\": {\"type\": \"box\"}}}, \"nodes\": [{}", ",{\"mesh\":\"a\"}", "]}"},
        {"materials", "\"nodes\": [{}", ",{\"shape\":{\"type\":\"quad\"},\"material\":{}}", "]}"},
        {"instances",
         "\"nodes\": [{\"name\": \"a\", \"shape\": {\"type\": \"box\"}, \"children\": [{\"shape\": {\"type\": "
         "\"box\"}}]}",
         ",{\"instance\":\"a\"}", "]}"},
        {"faces", "\"cages\": {\"c\": {\"positions\": [0,0,0,1,0,0,0,1,0], \"faces\": [[0,1,2]", ",[0,1,2]", "]}}}"},
        {"cages", "\"nodes\": [{}",
         ",{\"shape\":{\"type\":\"cage\",\"cage\":{\"positions\":[0,0,0,1,0,0,0,1,0],\"faces\":[[0,1,2]]}}}", "]}"},
        {"names", "\"nodes\": [{\"name\": \"a", "a", "\"}]}"},
        {"comments", "\"nodes\": [/*", "\"[,:", "*/]}"},
        {"cuts", "\"cuts\": [0", ",0", "]}"},
        {"lists", "\"nodes\": [[]", ",[]", "]}"},
        {"wrong keys", "\"nodes\": [{\"scale\": {\"keys\": [[]", ",[]", "]}}]}"},
        {"profile", "\"nodes\": [{\"shape\": {\"type\": \"lathe\", \"segments\": 4096, \"profile\": [[0,0]",
         ",[1,0],[2,1]", "]}}]}"},
    };
    for (const Hostile& file : files) {
        // The largest text that is parsed: the costliest one.
        std::size_t bytes = LoadLimits{}.text();
        const std::string sample = repeated(file.head, file.piece, file.tail, std::size_t{1} << 20);
        const double per_byte =
            static_cast<double>(estimate_json_memory(sample, true)) / static_cast<double>(sample.size());
        if (per_byte > 1.0) {
            bytes = std::min(
                bytes, static_cast<std::size_t>(0.99 * static_cast<double>(LoadLimits{}.json_values()) / per_byte));
        }
        const LoadCost cost = read_text([&] { return repeated(file.head, file.piece, file.tail, bytes); });
        expect_bounded(cost, file.name);
        std::printf("%-14s %5.1f MB of text, %s: %.0f MiB\n", file.name, static_cast<double>(bytes) / 1e6,
                    cost.refused() ? "refused" : "read", cost.memory.peak_mebibytes());
    }
}

TEST(HostileSceneFile, MemoryIsEstimatedBeforeParsing) {
    EXPECT_EQ(estimate_json_memory("", true), 0u);
    EXPECT_GT(estimate_json_memory("[1,2,3]", false), estimate_json_memory("[1,2]", false));
    EXPECT_LT(estimate_json_memory("[\"[[[[,,,,\"]", false), 300u) << "text is no structure";
    EXPECT_EQ(estimate_json_memory("1 // [,:\n", true), 0u);
    EXPECT_EQ(estimate_json_memory("1 /* [,: */", true), 0u);
    EXPECT_GT(estimate_json_memory("1 /* */ [1,1]", true), 0u);
    const std::string text = repeated("\"cuts\": [0", ",0", "]}", std::size_t{20} << 20);
    const Refusal found = find_refusal([&] { read_scene_text(text, "hostile.json"); });
    EXPECT_NE(found.reason.find("include"), std::string::npos) << "says what to do";
}

TEST(HostileSceneFile, CagesAreCountedBeforeTheyAreRefined) {
    const auto cage = [](const char* level) {
        return fmt::format(
            R"({{"shape":{{"type":"cage","cage":{{"positions":[0,0,0,1,0,0,1,1,0,0,1,0],"faces":[[0,1,2,3]],)"
            R"("max_level":10,"level":{}}}}}}})",
            level);
    };
    const auto scene = [](const std::string& nodes) { return fmt::format("{{\"aleph\": 1, \"nodes\": [{}]}}", nodes); };
    for (const char* level : {"7", "8", "9", "10"}) {
        const LoadCost cost = read_text([&] { return scene(cage(level)); });
        expect_bounded(cost, level);
    }
    const LoadCost many = read_text([&] {
        std::string nodes = cage("2");
        for (std::size_t i = 1; i < max_scene_cages; ++i) {
            nodes += ',';
            nodes += cage("2");
        }
        return scene(nodes);
    });
    EXPECT_FALSE(many.refused()) << many.refusal.message;
    expect_bounded(many, "many cages");
}

TEST(HostileSceneFile, InstancesOfInstancesAreCounted) {
    std::string nodes = R"({"name": "n0", "shape": {"type": "box"}, "children": [{"shape": {"type": "quad"}}]})";
    for (int i = 1; i < 40; ++i) {
        nodes += fmt::format(R"(,{{"name": "n{}", "children": [{{"instance": "n{}"}}, {{"instance": "n{}"}}]}})", i,
                             i - 1, i - 1);
    }
    const LoadCost cost = read_text([&] { return fmt::format("{{\"aleph\": 1, \"nodes\": [{}]}}", nodes); });
    EXPECT_TRUE(cost.refused()) << cost.refusal.message;
    expect_bounded(cost, "instances of instances");
}

}  // namespace
}  // namespace aleph
