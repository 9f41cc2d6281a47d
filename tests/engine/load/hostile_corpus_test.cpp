// Hostile glTF and scene files. Every value of a file that holds one element of each kind is replaced in turn by
// hostile values, and by others that contradict the rest of the file. Each is loaded, posed and built for rays. It must
// be refused in one sentence or load, within the limits of load_cost.h. If one ends the program, it is left in the
// scratch folder.

#include <gmock/gmock.h>

#include "engine/load/load_scene.h"
#include "engine/load/validate_scene.h"
#include "engine/pose/pose.h"
#include "engine/rays/ray_scene.h"
#include "tests/support/files/gltf_bad_input.h"
#include "tests/support/files/gltf_deform_draft.h"
#include "tests/support/files/load_cost.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// The first things that a viewer does with a file.
void use(const fs::path& path) {
    const Scene scene = load_scene(path);
    const Refusal refusal = find_refusal([&] { validate(scene); });
    ALEPH_CHECK(refusal.message.empty(), "what loads is valid: " + refusal.message);
    const FrameRange range = frame_range(scene);
    RayScene rays(scene);
    for (const std::int64_t frame : {range.first, range.last})
        rays.update(pose(scene, scene.film.frame_rate.seconds_of(frame)), glm::dvec3(0.0));
}

struct Tally {
    int files = 0, refused = 0;

    static bool is_sentence(const std::string& message, const fs::path& path) {
        return message.find(path.filename().string()) != std::string::npos && message.find('\n') == std::string::npos &&
               message.size() < 1000;
    }

    void add(const fs::path& path, const std::string& name) {
        const LoadCost cost = load_cost([&] { use(path); });
        expect_bounded(cost, name);
        ++files;
        if (!cost.refused()) return;
        ++refused;
        EXPECT_TRUE(is_sentence(cost.refusal.message, path)) << name << ": " << cost.refusal.message;
    }
};

/// As JSON texts: 1e400 is not a number that nlohmann would write.
const std::vector<std::string>& hostile_values() {
    static const std::vector<std::string> values = [] {
        std::istringstream words(R"(-1 0 1 3 255 65536 2147483647 4294967296 18446744073709551615 1e308 1e400 -0.5 null
            "" "1" "../../../../etc/passwd" "\u0000" true {} [] [[]] NaN)");
        std::vector<std::string> all(std::istream_iterator<std::string>{words}, {});
        std::string& deep = all.emplace_back("0");
        for (int i = 0; i < 4000; ++i) deep = "[" + deep + "]";
        return all;
    }();
    return values;
}

/// Pointers to every value below the root, containers too.
void collect_pointers(const Json& value, const Json::json_pointer& at, std::vector<Json::json_pointer>& into) {
    if (!at.empty()) into.push_back(at);
    if (value.is_object())
        for (const auto& [key, item] : value.items()) collect_pointers(item, at / key, into);
    if (value.is_array())
        for (std::size_t i = 0; i < value.size(); ++i) collect_pointers(value[i], at / i, into);
}

// The address sanitizer takes ten times as long: it gets every fourth pair of a place and a value. With an odd number
// of values each value and each place has its turn.
#if defined(__SANITIZE_ADDRESS__)
constexpr int every = 4;
#else
constexpr int every = 1;
#endif

/// Tries a file with every value replaced by each hostile one.
void replace_each_value(const Json& document, const fs::path& path, Tally& tally) {
    std::vector<Json::json_pointer> pointers;
    collect_pointers(document, Json::json_pointer(), pointers);
    const std::string mark = "\"HOSTILE\"";
    EXPECT_EQ(hostile_values().size() % 2, 1u);
    int pair = 0;
    for (const Json::json_pointer& pointer : pointers) {
        Json changed = document;
        changed[pointer] = "HOSTILE";
        const std::string text = changed.dump();
        for (const std::string& value : hostile_values()) {
            if (pair++ % every != 0) continue;
            write_text(path, std::string(text).replace(text.find(mark), mark.size(), value));
            tally.add(path, pointer.to_string() + " = " + value.substr(0, 30));
        }
    }
}

const std::string scene_text = R"({"aleph": 1, "name": "n", "fps": "30000/1001", "frames": [0, 9], "cuts": [3, 5],
  "viewing": {"pixels_per_degree": 31, "display_white": 100}, "exposure": 0.5, "camera": "eye",
  "environment": {"keys": [[0, [0, 0, 0]], [12, [1, 1, 1]]], "interpolation": "step"},
  "environment_image": "sky.png", "environment_rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [30, 720]]}}, "settings": {"gather": 16},
  "materials": {"felt": {"base_color": [0.1, 0.5, 0.1]}, "lamp": {"emission": [1, 1, 1],
    "emission_strength": {"values": [1, 2, 3], "start": 4, "period": 0.5}}},
  "meshes": {"ball": {"shape": {"type": "sphere", "radius": 0.5, "segments": 8}, "material": "felt"}},
  "lights": {"key": {"type": "point", "intensity": 40, "range": 9}}, "cameras": {"eye": {"fov": 45}},
  "nodes": [{"name": "table", "shape": {"type": "box", "size": [1, 2, 3]}, "material": "lamp", "children": [
      {"name": "b1", "mesh": "ball", "translation": {"keys": [[0, [0, 0, 0]], [5, [1, 0, 0]]], "unit": "seconds"}},
      {"rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [30, 720]]}}, "scale": 2, "visible": false}]},
    {"name": "b2", "instance": "b1", "parent": "table", "rotation": [0, 0, 0, 1]},
    {"name": "c", "camera": "eye", "light": "key", "matrix": [1,0,0,4, 0,1,0,5, 0,0,1,6, 0,0,0,1]},
    {"shape": {"type": "lathe", "segments": 6, "profile": [[0, 0], [1, 0.5], [0, 1]]}},
    {"shape": {"type": "torus", "radius": 2, "tube_radius": 0.5, "segments": 8}},
    {"shape": {"type": "mesh", "triangles": [[0, 1, 2]], "positions": {"keys": [[0, [[0, 0, 0], [1, 0, 0], [0, 1, 0]]],
      [9, [[0, 0, 1], [1, 0, 1], [0, 1, 1]]]]}, "uv": [[0, 0], [1, 0], [0, 1]]}},
    {"shape": {"type": "cage", "cage": {"positions": [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], "faces": [[0, 1, 2, 3]],
      "creases": [{"points": [0, 1, 2], "sharpness": 2}], "corners": [{"point": 0, "sharpness": 1}], "level": 1}}},
    {"look_at": "b1", "up": [0, 0, 1], "scale": {"interpolation": "smooth", "keys": [[0, 1], [4, {"named": "n"}], [9, 2]]}},
    {"follow_path": {"points": [[0, 0, 0], {"named": "v"}, [2, 0, 2]], "closed": true, "align": true, "up": [0, 1, 0],
      "at": {"interpolation": "ease", "keys": [[0, 0], [9, 1]]}}}],
  "named": {"v": [1, 2, {"named": "n"}], "n": 3}})";

TEST(HostileCorpus, S13_11_SceneFilesWithEveryValueReplaced) {
    const ScratchFolder folder;
    Tally tally;
    write_png(folder / "sky.png", Image<Rgb>(2, 1, Rgb(1.0f)));
    write_text(folder / "good.json", scene_text);
    ASSERT_NO_THROW(use(folder / "good.json"));
    replace_each_value(Json::parse(scene_text), folder / "bad.json", tally);
    EXPECT_GT(tally.files, 4000 / every);
    EXPECT_GT(tally.refused, tally.files / 2);
    std::printf("%d scene files, %d of them refused\n", tally.files, tally.refused);
}

TEST(HostileCorpus, S12_9_S13_11_GltfFilesWithEveryValueReplaced) {
    const ScratchFolder folder;
    Tally tally;
    for (GltfDraft draft : {textured_draft(folder, false), deform_draft()}) {
        const std::string whole = draft.to_text();
        write_text(folder / "good.gltf", whole);
        ASSERT_NO_THROW(use(folder / "good.gltf"));
        replace_each_value(Json::parse(whole), folder / "bad.gltf", tally);
    }
    EXPECT_GT(tally.files, 5000 / every);
    EXPECT_GT(tally.refused, tally.files / 2);
    std::printf("%d glTF files, %d of them refused\n", tally.files, tally.refused);
}

TEST(HostileCorpus, S13_11_TheLimitOfMemoryIsASetting) {
    const ScratchFolder folder;
    std::string cuts = R"({"aleph": 1, "cuts": [0)", numbers = R"({"asset": {"version": "2.0"}, "extras": [0)";
    for (int i = 1; i < 200000; ++i) {
        cuts += fmt::format(",{}", i);
        numbers += ",0";
    }
    write_text(folder / "cuts.json", cuts + R"(], "nodes": [{"light": {"type": "point", "intensity": 1}}]})");
    write_text(folder / "numbers.gltf", numbers + "]}");
    for (const char* name : {"cuts.json", "numbers.gltf"}) {
        EXPECT_NO_THROW(load_scene(folder / name)) << name;
        const Refusal found = find_refusal([&] { load_scene(folder / name, {std::size_t{16} << 20}); });
        EXPECT_THAT(found.reason, testing::HasSubstr("MiB")) << name;
    }
}

}  // namespace
}  // namespace aleph
