// The page on authoring scenes: every example on it loads and renders, and every key of the schema is in one.

#include <nlohmann/json.hpp>

#include "engine/json/text.h"
#include "engine/load/load_scene.h"
#include "engine/scene_file/scene_text.h"
#include "engine/scene_file/schema.h"
#include "render/frame/sequence.h"
#include "tests/support/files/gltf_draft.h"
#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path source = source_folder();

struct Example {
    int line = 0;        ///< of its fence
    std::string before;  ///< the page's text since the last example
    std::string text;
};

/// Fenced blocks of the page: "json" is a whole file, "json node" a node.
std::vector<Example> read_examples() {
    std::stringstream page(read_bytes(source / "scenes" / "AUTHORING.md"));
    std::vector<Example> examples;
    std::string line, fence, before;
    for (int number = 1; std::getline(page, line); ++number) {
        if (!line.starts_with("```")) {
            (fence.empty() ? before : examples.back().text) += line + '\n';
            continue;
        }
        if (!fence.empty()) {
            if (fence == "```json node") {
                examples.back().text = "{\"aleph\": 1, \"nodes\": [" + examples.back().text + "]}";
            }
            fence.clear();
            continue;
        }
        fence = line;
        EXPECT_TRUE(fence == "```json" || fence == "```json node") << "line " << number << ": " << fence;
        examples.push_back({number, std::exchange(before, ""), ""});
    }
    return examples;
}

/// A glTF file with one triangle, and with the material and the animation that an example names.
std::string one_triangle() {
    GltfDraft draft = triangle_draft();
    draft.animate(0, "translation", {0, 1}, {0, 0, 0, 10, 0, 0});
    draft.json["animations"][0]["name"] = "Walk";
    draft.json["materials"] = {{{"name", "Steel"}}};
    draft.primitive()["material"] = 0;
    return draft.to_text();
}

/// Loads an example from a file, with stand-ins for the files that it names.
Scene load_example(const Example& example, const fs::path& folder) {
    const Scene named = read_scene_text(example.text, "example.json").scene;
    const auto put = [&](const std::string& path, const fs::path& from) {
        fs::create_directories((folder / path).parent_path());
        fs::copy_file(from, folder / path, fs::copy_options::overwrite_existing);
    };
    for (const SceneImage& image : named.images) {
        put(image.path, source / "scenes" / "pool" / "textures" / "ball_01.png");
    }
    for (const Include& include : named.source.includes) {
        if (include.path.ends_with(".glb")) {
            put(include.path, source / "scenes" / "room" / "room.glb");
        } else if (include.path.ends_with(".abc")) {
            put(include.path, source / "tests" / "assets" / "abc" / "subd_creases.abc");
        } else {
            std::ofstream(folder / include.path) << one_triangle();
        }
    }
    std::ofstream(folder / "example.json") << example.text;
    return load_scene(folder / "example.json");
}

/// The settings of an example, at a size and with sample counts that take milliseconds.
RenderSettings small_settings(const Scene& scene) {
    RenderSettings settings;
    apply_settings(settings, scene.source.settings, "example.json");
    settings.picture.width = 16;
    settings.picture.height = 12;
    settings.cache.gather = 4;
    settings.sampling.spp = 1;
    settings.light.light_samples = 1;
    return settings;
}

/// Most examples show a part of a scene, without a camera.
void add_missing_camera(Scene& scene) {
    const auto has_camera = [](const Node& node) { return node.camera != no_index; };
    if (std::ranges::any_of(scene.nodes, has_camera)) return;
    Node eye{.name = "added camera",
             .transform = {.translation = glm::dvec3(0.0, 1.0, 6.0)},
             .camera = static_cast<int>(scene.cameras.size())};
    scene.cameras.emplace_back();
    scene.nodes.push_back(std::move(eye));
}

TEST(Authoring, EveryExampleLoadsSavesAndRendersWithItsSettings) {
    const ScratchFolder folder;
    const std::vector<Example> examples = read_examples();
    EXPECT_GE(examples.size(), 10u);
    for (const Example& example : examples) {
        SCOPED_TRACE("AUTHORING.md, line " + std::to_string(example.line));
        try {
            Scene scene = load_example(example, folder.path());
            for (const std::string& warning : scene.source.warnings) {
                EXPECT_NE(warning.find("no light"), std::string::npos) << warning;
            }
            save_scene(scene, folder.path() / "saved.json");
            Scene saved = load_scene(folder.path() / "saved.json");
            saved.source.file = scene.source.file;
            saved.source.warnings = scene.source.warnings;
            EXPECT_TRUE(saved == scene);
            add_missing_camera(scene);
            const RenderSettings settings = small_settings(scene);
            Sequence sequence(std::move(scene), settings);
            const std::int64_t frame = sequence.range().first;
            EXPECT_EQ(sequence.render(frame, {.frame = false, .maps = true, .progress = {}}).limits.alpha.width, 16);
            const FrameOutput output = sequence.render(frame);
            EXPECT_EQ(output.shaded.color.width, 16);
            EXPECT_EQ(output.shaded.counts.invalid_samples, 0u);
        } catch (const std::exception& error) {
            ADD_FAILURE() << error.what();
        }
    }
}

/// Which keys of the schema the examples use.
class Coverage {
  public:
    Coverage() : root_(scene_schema()) {}

    void mark(const json& schema_or_reference, const json& value, const std::string& place) {
        const auto [schema, here] = resolve(schema_or_reference, place);
        if (schema->contains("anyOf")) {
            int index = 0;
            for (const json& one : (*schema)["anyOf"]) mark(one, value, here + "/" + std::to_string(index++));
            return;
        }
        if (value.is_array() && schema->contains("items")) {
            const json& items = (*schema)["items"];
            for (std::size_t i = 0; i < value.size(); ++i) {
                if (items.is_array() && i >= items.size()) break;
                mark(items.is_array() ? items[i] : items, value[i], here + "/items");
            }
        }
        if (!value.is_object()) return;
        for (const auto& member : value.items()) {
            if (schema->contains("properties") && (*schema)["properties"].contains(member.key())) {
                seen_.insert(name_of(here, member.key()));
                mark((*schema)["properties"][member.key()], member.value(), here + "/" + member.key());
            } else if (schema->contains("additionalProperties") && (*schema)["additionalProperties"].is_object()) {
                mark((*schema)["additionalProperties"], member.value(), here + "/*");
            }
        }
    }

    /// Every key that the schema knows.
    void list_keys(const json& schema, const std::string& place, std::set<std::string>& keys) const {
        if (schema.contains("properties")) {
            for (const auto& property : schema["properties"].items()) {
                keys.insert(name_of(place, property.key()));
                list_keys(property.value(), place + "/" + property.key(), keys);
            }
        }
        for (const char* inner : {"items", "additionalProperties"}) {
            if (schema.contains(inner) && schema[inner].is_object()) {
                list_keys(schema[inner], place + (inner[0] == 'i' ? "/items" : "/*"), keys);
            }
        }
        if (schema.contains("anyOf")) {
            int index = 0;
            for (const json& one : schema["anyOf"]) list_keys(one, place + "/" + std::to_string(index++), keys);
        }
    }

    bool has(const std::string& key) const { return seen_.contains(key); }

  private:
    std::pair<const json*, std::string> resolve(const json& schema, std::string place) const {
        const json* now = &schema;
        while (now->contains("$ref")) {
            place = (*now)["$ref"].get<std::string>().substr(1);
            now = &root_.at(json::json_pointer(place));
        }
        return {now, place};
    }

    /// Names a key. All values are keyed in the same way, whatever they are.
    static std::string name_of(const std::string& place, const std::string& key) {
        return (place.starts_with("/definitions/keyed_") ? "keyed" : place) + "/" + key;
    }

    const json& root_;
    std::set<std::string> seen_;
};

TEST(Authoring, EveryKeyOfTheSchemaStandsInAnExample) {
    Coverage coverage;
    for (const Example& example : read_examples()) {
        coverage.mark(scene_schema(), parse_json_text(example.text, "example.json").root, "");
    }
    std::set<std::string> keys;
    coverage.list_keys(scene_schema(), "", keys);
    for (const auto& definition : scene_schema()["definitions"].items()) {
        coverage.list_keys(definition.value(), "/definitions/" + definition.key(), keys);
    }
    EXPECT_GT(keys.size(), 150u);
    for (const std::string& key : keys) EXPECT_TRUE(coverage.has(key)) << key << " has no example in AUTHORING.md";
}

TEST(Authoring, EveryWordOfTheSchemaIsOnThePage) {
    const std::string page = read_bytes(source / "scenes" / "AUTHORING.md");
    std::set<std::string> words;
    const std::function<void(const json&)> collect = [&](const json& schema) {
        if (schema.is_array()) {
            for (const json& one : schema) collect(one);
        }
        if (!schema.is_object()) return;
        for (const auto& member : schema.items()) {
            if (member.key() == "enum" && member.value().is_array()) {
                for (const json& word : member.value()) {
                    if (word.is_string()) words.insert(word.get<std::string>());
                }
            } else {
                collect(member.value());
            }
        }
    };
    collect(scene_schema());
    EXPECT_GT(words.size(), 30u);
    for (const std::string& word : words) {
        EXPECT_TRUE(page.find('`' + word + '`') != std::string::npos ||
                    page.find('"' + word + '"') != std::string::npos)
            << word;
    }
}

}  // namespace
}  // namespace aleph
