// Hostile scene files as large as they may be: each ends in 2 s and 512 MiB (release builds), read or refused.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <ctime>
#include <functional>
#include <string>

#include "engine/base/errors.h"
#include "engine/json_text.h"
#include "engine/scene_json.h"

namespace aleph {
namespace {

#if defined(NDEBUG) && !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
constexpr bool limits_count = true;
#else
constexpr bool limits_count = false;
#endif

struct Cost {
    int exit_code = -1;    ///< 0: read; 1: refused with an InputError; 2: anything else
    double seconds = 0.0;  ///< of the processor, so that a busy machine changes nothing
    double mebibytes = 0.0;
};

/// Makes the text and reads it in a process of its own, whose peak is counted, the text included.
Cost read_in_child(const std::function<std::string()>& make) {
    int channel[2];
    EXPECT_EQ(pipe(channel), 0);
    const pid_t child = fork();
    if (child == 0) {
        const std::string text = make();
        const std::clock_t start = std::clock();
        int code = 0;
        try {
            read_scene_text(text, "hostile.json");
        } catch (const InputError&) {
            code = 1;
        } catch (...) {
            code = 2;
        }
        const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
        _exit(write(channel[1], &seconds, sizeof seconds) == sizeof seconds ? code : 2);
    }
    int status = 0;
    rusage usage{};
    wait4(child, &status, 0, &usage);
    Cost cost{WIFEXITED(status) ? WEXITSTATUS(status) : -1, 0.0, static_cast<double>(usage.ru_maxrss) / 1024.0};
    close(channel[1]);
    if (read(channel[0], &cost.seconds, sizeof cost.seconds) != sizeof cost.seconds) cost.exit_code = -1;
    close(channel[0]);
    return cost;
}

void expect_cheap(const Cost& cost, const char* name) {
    EXPECT_TRUE(cost.exit_code == 0 || cost.exit_code == 1) << name << ": " << cost.exit_code;
    if (!limits_count) return;
    EXPECT_LT(cost.seconds, 2.0) << name;
    EXPECT_LT(cost.mebibytes, 512.0) << name;
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

TEST(HostileSceneFile, EndsInTwoSecondsAndHalfAGibibyte) {
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
        {"profile", "\"nodes\": [{\"shape\": {\"type\": \"lathe\", \"segments\": 4096, \"profile\": [[0,0]",
         ",[1,0],[2,1]", "]}}]}"},
    };
    for (const Hostile& file : files) {
        // The largest that is parsed at all: below that, more text costs more.
        std::size_t bytes = max_scene_text_bytes;
        const std::string sample = repeated(file.head, file.piece, file.tail, std::size_t{1} << 20);
        const double per_byte =
            static_cast<double>(estimate_json_memory(sample, true)) / static_cast<double>(sample.size());
        if (per_byte > 1.0) {
            bytes = std::min(bytes, static_cast<std::size_t>(0.99 * static_cast<double>(max_json_memory) / per_byte));
        }
        const Cost cost = read_in_child([&] { return repeated(file.head, file.piece, file.tail, bytes); });
        expect_cheap(cost, file.name);
        std::printf("%-14s %5.1f MB of text, %s: %.2f s, %.0f MiB\n", file.name, static_cast<double>(bytes) / 1e6,
                    cost.exit_code == 0 ? "read" : "refused", cost.seconds, cost.mebibytes);
    }
}

TEST(HostileSceneFile, MemoryIsEstimatedBeforeParsing) {
    EXPECT_EQ(estimate_json_memory("", true), 0u);
    EXPECT_GT(estimate_json_memory("[1,2,3]", false), estimate_json_memory("[1,2]", false));
    EXPECT_LT(estimate_json_memory("[\"[[[[,,,,\"]", false), 300u) << "text is no structure";
    EXPECT_EQ(estimate_json_memory("1 // [,:\n", true), 0u);
    EXPECT_EQ(estimate_json_memory("1 /* [,: */", true), 0u);
    EXPECT_GT(estimate_json_memory("1 /* */ [1,1]", true), 0u);
    try {
        read_scene_text(repeated("\"cuts\": [0", ",0", "]}", std::size_t{20} << 20), "hostile.json");
        FAIL();
    } catch (const InputError& error) {
        EXPECT_NE(error.reason().find("include"), std::string::npos) << "says what to do";
    }
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
        const Cost cost = read_in_child([&] { return scene(cage(level)); });
        expect_cheap(cost, level);
        std::printf("level %s: %s, %.2f s, %.0f MiB\n", level, cost.exit_code == 0 ? "read" : "refused", cost.seconds,
                    cost.mebibytes);
    }
    const Cost many = read_in_child([&] {
        std::string nodes = cage("2");
        for (std::size_t i = 1; i < max_scene_cages; ++i) {
            nodes += ',';
            nodes += cage("2");
        }
        return scene(nodes);
    });
    EXPECT_EQ(many.exit_code, 0);
    expect_cheap(many, "many cages");
    std::printf("%zu cages: %.2f s, %.0f MiB\n", max_scene_cages, many.seconds, many.mebibytes);
}

TEST(HostileSceneFile, InstancesOfInstancesAreCounted) {
    std::string nodes = R"({"name": "n0", "shape": {"type": "box"}, "children": [{"shape": {"type": "quad"}}]})";
    for (int i = 1; i < 40; ++i) {
        nodes += fmt::format(R"(,{{"name": "n{}", "children": [{{"instance": "n{}"}}, {{"instance": "n{}"}}]}})", i,
                             i - 1, i - 1);
    }
    const Cost cost = read_in_child([&] { return fmt::format("{{\"aleph\": 1, \"nodes\": [{}]}}", nodes); });
    EXPECT_EQ(cost.exit_code, 1);
    expect_cheap(cost, "instances of instances");
}

}  // namespace
}  // namespace aleph
