// Hostile scene files. Randomly damaged ones are refused with an InputError or read, and what was read can be saved;
// the largest that are parsed stay within the limits of load_cost.h.

#include <cctype>
#include <cstdio>

#include "engine/json/text.h"
#include "engine/scene_file/scene_text.h"
#include "tests/support/files/load_cost.h"

namespace aleph {
namespace {

const std::string whole_file = R"({"aleph": 1, "name": "n", "fps": "30000/1001", "frames": [0, 59], "cuts": [3, 30],
  "viewing": {"pixels_per_degree": 31, "display_white": 100, "persistence": 0.5}, "exposure": 0.5, "camera": "eye",
  "environment": {"keys": [[0, [0, 0, 0]], [12, [1, 1, 1]]], "interpolation": "step"},
  "environment_image": "felt", "environment_rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [30, 720]]}},
  "images": {"felt": "felt.png"}, "settings": {"accuracy": 0.1, "gather": 512, "guide": "full", "size": "64x48",
    "adapter_k": 1, "min_radius_pixels": 1},
  "materials": {"felt": {"base_color": [0.1, 0.5, 0.1], "alpha": 1, "metallic": 1, "roughness": 1, "specular": 1,
      "specular_color": [1, 1, 1], "ior": 1.5, "base_color_texture": {"image": "felt", "wrap": ["clamp", "mirror"],
      "offset": [1, 0], "scale": [1, 2], "rotation": 3}},
    "glass": {"transmission": 1, "thickness": 0.5, "attenuation_distance": 2, "attenuation_color": [1, 0, 1], "anisotropy_rotation": 30,
      "clearcoat": 1, "clearcoat_roughness": 1, "clearcoat_normal_scale": 1, "sheen_color": [0.5, 0, 0], "sheen_roughness": 1,
      "anisotropy": 1, "normal_texture": "felt", "normal_scale": 0.5},
    "lamp": {"emission": [1, 1, 1], "emission_strength": {"values": [1, 2, 3], "start": 4, "period": 0.5}}},
  "meshes": {"ball": {"shape": {"type": "sphere", "radius": 0.5, "segments": 8}, "material": "felt"},
    "flag": {"shape": {"type": "mesh", "points": "cloth", "vertex_points": [0, 1, 2, 0], "triangles": [[0, 1, 2], [3, 1, 2]],
      "uv": [0, 0, 1, 0, 1, 1, 0, 1], "colors": [1,1,1,1, 1,1,1,1, 1,1,1,1, 1,1,1,1]}, "present": {"keys": [[0, true], [9, false]]}}},
  "points": {"cloth": {"keys": [[0, [0,0,0, 1,0,0, 1,1,0]], [9, [0,0,0, 1,0,0, 1,1,5]]]}},
  "cages": {"tent": {"positions": [[0,0,0], [1,0,0], [1,1,0], [0,1,0], [0,0,2]], "faces": [[0,1,2,3], [0,3,4], [1,0,4]], "level": 1,
    "max_level": 2, "creases": [{"points": [0, 3], "sharpness": 2}], "corners": [{"point": 4, "sharpness": 10}], "holes": [2],
    "uv": [0,0, 1,0], "face_uv": [[0,1,1,0], [0,1,0], [1,1,1]], "parts": [0, 1, 0]}},
  "lights": {"key": {"type": "spot", "color": [1, 1, 1], "intensity": 40, "range": 9, "inner_cone": 10, "outer_cone": 20}},
  "cameras": {"eye": {"fov": 45, "near": 1, "aperture": 1, "focus": 1, "shutter": [0, 0.5]}},
  "nodes": [{"name": "table", "shape": {"type": "box", "size": [1, 2, 3], "uv_scale": [1, 1]}, "material": "lamp", "children": [
      {"name": "b1", "mesh": "ball", "translation": {"keys": [[0, [0, 0, 0]], [5, [1, 0, 0]]], "unit": "seconds"}},
      {"rotation": {"axis": [0, 1, 0], "degrees": {"keys": [[0, 0], [30, 720]]}}, "scale": 2, "visible": false}]},
    {"name": "b2", "instance": "b1", "parent": "table", "rotation": [0, 0, 0, 1], "include": "a.glb"},
    {"name": "c", "camera": "eye", "light": "key", "shape": {"type": "cylinder", "height": 1}, "matrix": [1,0,0,4, 0,1,0,5, 0,0,1,6, 0,0,0,1]},
    {"shape": {"type": "cage", "cage": "tent", "part": 1}, "instance": "b1"}, {"mesh": "flag", "inherits": false, "visible": "always"},
    {"shape": {"type": "torus", "radius": 0.5, "tube_radius": 0.25, "segments": 6}, "operations": [{"translate": [1, 2, 3]},
      {"rotate_y": {"keys": [[0, 0], [30, 360]]}}, {"rotate": {"axis": [0, 1, 0], "degrees": 45}}]},
    {"shape": {"type": "lathe", "segments": 5, "smooth": true, "profile": [[0, 0], [0.5, 0.25], [0.5, 0.25], [0, 1]]}},
    {"scale": {"cycle": [0, 0.25], "period": 1, "values": [1, [1, 2, 3]]}, "translation": {"interpolation": "cubic",
      "keys": [[0, [0, 0, 0], [1, 1, 1], [0, 0, 0]], [9, [0, 0, 0], [2, 2, 2], [0, 0, 0]]]}}]})";

/// Elements that become keys on loading: many of them, so that this is a short file of its own.
const std::string guided_file = R"({"aleph": 1, "frames": [0, 9], "nodes": [{"name": "b1"},
    {"name": "d", "look_at": "b1", "up": [0, 0, 1], "translation": {"interpolation": "smooth", "keys": [[0, [9, 0, 0]], [4, {"named": "v"}], [9, [0, 5, 1]]]}},
    {"follow_path": {"points": [[0, 0, 0], {"named": "v"}, [2, 0, 2]], "closed": true, "at": {"named": "t"}, "align": true, "up": [0, 1, 0]}},
    {"look_at": {"named": "v"}, "scale": {"named": "t"}}],
  "named": {"v": [1, 2, {"named": "n"}], "n": 3, "t": {"interpolation": "ease", "keys": [[0, 0.5], [9, 1]]}}})";

class Damage {
  public:
    std::string apply(std::string text) {
        if (below(2) == 0) {  // half of them gently: one digit
            const std::size_t digit = text.find_first_of("0123456789", below(text.rfind('1')));
            text[digit] = static_cast<char>('0' + below(10));
            return text;
        }
        for (std::size_t times = 1 + below(3); times > 0; --times) {
            std::size_t at = below(text.size()), removed = 1 + below(12);
            std::string added;
            switch (below(5)) {
                case 0:
                    added = static_cast<char>(below(256));
                    removed = 1;
                    break;
                case 1:
                    break;
                case 2:
                    added = text.substr(below(text.size()), std::exchange(removed, 0));
                    break;
                case 3:
                    added = pieces_[below(pieces_.size())];
                    removed = 0;
                    break;
                default:  // a number becomes another
                    added = pieces_[below(pieces_.size())];
                    at = text.find_first_of("0123456789", at);
                    removed = 1;
            }
            if (at < text.size()) text.replace(at, removed, added);
        }
        return text;
    }

  private:
    std::size_t below(std::size_t n) { return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_); }

    std::mt19937 random_{20};
    std::vector<std::string> pieces_ = {
        "{",     "}",    "[",     "]",         ",",      ":",    "\"", "null", "-1",   "0",    "1e308",
        "1e999", "true", "[[1]]", "{\"a\":1}", "1e-320", "\"\"", "//", "/*",   "-0.0", "4097", "18446744073709551616"};
};

/// Damages a file so often. A third and more is still read, half and more is refused.
void expect_read_or_refused(const std::string& whole, int times) {
    ASSERT_NO_THROW(read_scene_text(whole, "whole.json"));
    Damage damage;
    int read = 0, refused = 0;
    for (int i = 0; i < times; ++i) {
        const std::string text = damage.apply(whole);
        Scene scene;
        try {
            scene = read_scene_text(text, "damaged.json").scene;
            ++read;
        } catch (const InputError& error) {
            EXPECT_EQ(error.file(), "damaged.json");
            EXPECT_FALSE(error.reason().empty());
            ++refused;
            continue;
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what() << "\n" << text;
            continue;
        }
        try {
            EXPECT_TRUE(read_scene_text(write_scene_text(scene, "again.json"), "again.json").scene == scene) << text;
        } catch (const std::exception& error) {
            ADD_FAILURE() << "was read but not written: " << error.what() << "\n" << text;
        }
    }
    EXPECT_GT(read, times / 3);
    EXPECT_GT(refused, times / 2);
}

TEST(DamagedSceneFile, IsReadOrRefusedAndWhatIsReadCanBeSaved) {
    expect_read_or_refused(whole_file, 2000);
    expect_read_or_refused(guided_file, 400);
}

/// Values that are not finite numbers up to 1e18, in every place for a number.
TEST(DamagedSceneFile, InfinityAnywhereIsRefused) {
    int places = 0;
    bool in_text = false;
    for (std::size_t at = 0; at < whole_file.size(); ++at) {
        if (whole_file[at] == '"') in_text = !in_text;
        if (in_text || std::isdigit(whole_file[at]) == 0) continue;
        const std::size_t end = whole_file.find_first_not_of("0123456789.", at);
        for (const char* bad : {"1e999", "-1e999", "1e19", "-1e19", "NaN", "\"0\""}) {
            const std::string text = std::string(whole_file).replace(at, end - at, bad);
            const Refusal found = find_refusal([&] { read_scene_text(text, "broken.json"); });
            EXPECT_EQ(found.file, "broken.json") << bad << " at " << whole_file.substr(at > 30 ? at - 30 : 0, 40);
            EXPECT_FALSE(found.place.empty());
        }
        ++places;
        at = end - 1;
    }
    EXPECT_GT(places, 250);
}

TEST(DamagedSceneFile, EveryBeginningOfAFileIsRefused) {
    for (std::size_t length = 0; length < whole_file.size(); ++length) {
        EXPECT_THROW(read_scene_text(std::string_view(whole_file).substr(0, length), "short.json"), InputError)
            << length;
    }
}

/// Makes the text and reads it; both count.
LoadCost read_text(const std::function<std::string()>& make, const LoadLimits& limits = {}) {
    return load_cost([&] { read_scene_text(make(), "hostile.json", limits); });
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
        {"eased keys", "\"nodes\": [{\"scale\": {\"interpolation\": \"smooth\", \"values\": [1", ",2", "]}}]}"},
        {"named", "\"named\": {\"m\": [1,2,3], \"n\": [1", ",{\"named\":\"m\"}", "]}}"},
        {"uses of names", "\"named\": {\"m\": 1}, \"cuts\": [0", ",{\"named\":\"m\"}", "]}"},
        {"path points", "\"nodes\": [{\"follow_path\": {\"at\": 0, \"points\": [[0,0,0]", ",[1,0,0],[2,1,0]", "]}}]}"},
        {"paths", "\"named\": {\"p\": [[0,0,0],[1,0,0]], \"t\": {\"keys\": [[0,0],[99,1]]}}, \"nodes\": [{}",
         ",{\"follow_path\":{\"points\":{\"named\":\"p\"},\"at\":{\"named\":\"t\"},\"align\":true}}", "]}"},
        {"still looks", "\"nodes\": [{\"translation\": [0,0,9]}", ",{\"look_at\":[0,9,1]}", "]}"},
        {"looks",
         "\"frames\": [0, 1000], \"nodes\": [{\"name\": \"a\", \"operations\": [{\"translate\": {\"keys\": [[0, "
         "[1,0,9]], [1000, [1,9,9]]]}}, {\"rotate_x\": 4}]}",
         ",{\"look_at\":\"a\"}", "]}"},
    };
    // A quarter of the memory takes a quarter of the time, and work that grows faster is beyond its quarter too.
    const LoadLimits limits{LoadLimits{}.memory / 4};
    for (const Hostile& file : files) {
        // The largest text that is parsed: the costliest one.
        std::size_t bytes = limits.text();
        const std::string sample = repeated(file.head, file.piece, file.tail, std::size_t{1} << 20);
        const double per_byte =
            static_cast<double>(estimate_json_memory(sample, true)) / static_cast<double>(sample.size());
        if (per_byte > 1.0) {
            bytes =
                std::min(bytes, static_cast<std::size_t>(0.99 * static_cast<double>(limits.json_values()) / per_byte));
        }
        const LoadCost cost = read_text([&] { return repeated(file.head, file.piece, file.tail, bytes); }, limits);
        expect_bounded(cost, file.name, limits);
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
