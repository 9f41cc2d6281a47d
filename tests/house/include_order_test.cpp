// Rules for includes: they point one way, and every source folder is a layer.

#include <regex>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// A folder, and which other folders its files may include.
struct Layer {
    std::string folder;
    std::vector<std::string> may_include;
};

/// From the bottom up: each may include folders that stand above it in this list only.
const std::vector<Layer>& layers() {
    static const std::vector<Layer> all = [] {
        const std::vector<std::string> model = {"engine/base", "engine/scene", "engine/surface"};
        const std::vector<std::string> text = {"engine/base", "engine/json", "engine/scene", "engine/surface"};
        std::vector<std::string> engine = model;
        for (const char* folder : {"pose", "rays", "image", "json", "scene_file", "gltf", "gltf/write", "alembic"})
            engine.push_back(std::string("engine/") + folder);
        const std::vector<std::string> below_load = engine;
        engine.push_back("engine/load");
        std::vector<std::string> stages = engine;
        for (const char* folder : {"motion", "perception/vision", "perception/saliency", "perception"})
            stages.push_back(folder);
        // Each includes those before it.
        std::vector<Layer> rooms;
        for (const char* room :
             {"settings", "surface", "pixels",      "guide",  "light",       "path",    "cache",  "estimate",
              "time",     "shade",   "plan",        "frame",  "output",      "compare", "images", "budget",
              "verify",   "study",   "study/pages", "python", "cli/support", "cli"}) {
            rooms.push_back({std::string("render/") + room, stages});
            stages.push_back(rooms.back().folder);
        }
        const auto with = [](std::vector<std::string> folders, std::initializer_list<const char*> more) {
            folders.insert(folders.end(), more.begin(), more.end());
            return folders;
        };
        std::vector<Layer> found{
            {"engine/base", {}},
            {"engine/scene", {"engine/base"}},
            {"engine/surface", {"engine/base", "engine/scene"}},
            {"engine/pose", model},
            {"engine/rays", with(model, {"engine/pose"})},
            {"engine/image", {"engine/base"}},
            {"engine/json", {"engine/base"}},
            {"engine/scene_file", with(text, {"engine/pose"})},
            {"engine/gltf/validate", {"engine/base", "engine/json", "engine/scene"}},
            {"engine/gltf", with(text, {"engine/image", "engine/gltf/validate"})},
            {"engine/gltf/write", with(model, {"engine/pose", "engine/image", "engine/gltf/validate"})},
            {"engine/alembic", with(model, {"engine/json"})},
            {"engine/load", below_load},
            {"motion", engine},
            {"perception/vision", {"engine/base"}},
            {"perception/saliency", {"engine/base", "perception/vision"}},
            {"perception", {"engine/base", "perception/vision", "perception/saliency"}},
        };
        // Subcommands, which cli/ names but does not include.
        for (const char* part : {"explain", "compare", "farm"})
            rooms.push_back({std::string("render/cli/") + part, stages});
        found.insert(found.end(), rooms.begin(), rooms.end());
        return found;
    }();
    return all;
}

/// The layer of a file (a path from the repository's root): the one with the longest folder. Null outside all of them.
const Layer* layer_of(const std::string& path) {
    const Layer* found = nullptr;
    for (const Layer& layer : layers()) {
        const bool inside = path.starts_with(layer.folder + "/");
        if (inside && (found == nullptr || layer.folder.size() > found->folder.size())) found = &layer;
    }
    return found;
}

/// The names in the #include lines of a text, in quotes or in angle brackets.
std::vector<std::string> included_paths(const std::string& text) {
    static const std::regex line(R"re((?:^|\n)[ \t]*#[ \t]*include[ \t]*["<]([^">\n]+)[">])re");
    std::vector<std::string> paths;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), line); it != std::sregex_iterator(); ++it) {
        paths.push_back(fs::path((*it)[1].str()).lexically_normal().generic_string());
    }
    return paths;
}

/// The includes of a file that point the wrong way, as "file includes other".
std::vector<std::string> find_violations(const std::string& file, const std::string& text) {
    std::vector<std::string> violations;
    const Layer* own = layer_of(file);
    if (own == nullptr) return violations;
    for (const std::string& path : included_paths(text)) {
        // Relative to the including file a path could step into another folder without its name.
        const bool relative = path.starts_with("../") || fs::path(path).is_absolute();
        const Layer* other = layer_of(path);
        const bool allowed =
            other == nullptr || other == own ||
            std::find(own->may_include.begin(), own->may_include.end(), other->folder) != own->may_include.end();
        const bool outside = path.starts_with("tests/") || path.starts_with("scenes/");
        if (relative || !allowed || outside) violations.push_back(file + " includes " + path);
    }
    return violations;
}

/// The sources of all layers: texts by path from the repository's root.
const std::map<std::string, std::string>& sources() {
    static const std::map<std::string, std::string> all = [] {
        const fs::path root = source_folder();
        std::map<std::string, std::string> found;
        for (const char* folder : {"engine", "motion", "perception", "render"}) {
            for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
                const std::string path = fs::relative(entry.path(), root).generic_string();
                if (path.find("node_modules") != std::string::npos || !entry.is_regular_file()) continue;
                if (path.ends_with(".h") || path.ends_with(".cpp")) found[path] = read_bytes(entry.path());
            }
        }
        return found;
    }();
    return all;
}

/// Does the page of a folder say that other folders may include this header? It has a line "From outside", or marks
/// rows of its table as public, but for some of their files. Where it has neither, all are.
bool is_public(const std::string& page, const std::string& header) {
    const std::string stem = "`" + header.substr(0, header.find('.')) + ".*`", name = "`" + header + "`";
    const auto has = [](const std::string& text, const std::string& part) { return text.find(part) != text.npos; };
    if (const std::size_t at = page.find("**From outside:**"); at != page.npos) {
        const std::string outside = page.substr(at, page.find("\n\n", at) - at);
        return has(outside, "every header") || has(outside, name);
    }
    if (!has(page, "**public**")) return true;
    std::istringstream rows(page);
    for (std::string row; std::getline(rows, row);) {
        if (!row.starts_with("|") || !has(row, "**public**")) continue;
        const std::size_t end = row.find('|', 1);
        const std::string files = row.substr(0, end), rest = row.substr(end);
        const bool excepted = has(rest, "but for " + name) || has(rest, "but for " + stem);
        if ((has(files, name) || has(files, stem)) && !excepted) return true;
    }
    return false;
}

TEST(House, EveryFolderIsALayerAndIncludesPointOneWay) {
    int own_includes = 0;
    for (const auto& [path, text] : sources()) {
        const Layer* own = layer_of(path);
        EXPECT_TRUE(own != nullptr && own->folder == fs::path(path).parent_path())
            << path << " lies in a folder that layers() does not list";
        for (const std::string& violation : find_violations(path, text)) ADD_FAILURE() << violation;
        for (const std::string& included : included_paths(text)) own_includes += layer_of(included) != nullptr;
    }
    EXPECT_GT(sources().size(), 40u);  // the folders were found
    EXPECT_GT(own_includes, 100);      // and their includes understood
}

TEST(House, PagesMarkTheHeadersThatOtherFoldersInclude) {
    std::map<std::string, std::string> pages;
    for (const Layer& layer : layers()) {
        const fs::path page = source_folder() / layer.folder / "README.md";
        pages[layer.folder] = fs::exists(page) ? read_bytes(page) : "";
    }
    for (const auto& [path, text] : sources()) {
        for (const std::string& included : included_paths(text)) {
            const Layer* other = layer_of(included);
            if (other == nullptr || other == layer_of(path)) continue;
            EXPECT_TRUE(is_public(pages.at(other->folder), fs::path(included).filename()))
                << path << " includes " << included << ", which the page of " << other->folder << " does not mark";
        }
    }
    const std::string marked = "| `a.*`, `b.h` | **public**, but for `b.h`: it |\n| `c.h` | them |\n";
    EXPECT_TRUE(is_public(marked, "a.h"));
    EXPECT_FALSE(is_public(marked, "b.h") || is_public(marked, "c.h"));
    EXPECT_FALSE(is_public("| `a.h` | it |\n\n**From outside:** `b.h`.\n\n`a.h`", "a.h"));
}

TEST(House, LayersHaveNoCycle) {
    std::set<std::string> lower;
    for (const Layer& layer : layers()) {
        for (const std::string& folder : layer.may_include) {
            EXPECT_TRUE(lower.contains(folder)) << layer.folder << " may include " << folder << ", which comes later";
        }
        lower.insert(layer.folder);
    }
}

TEST(House, CheckerSeesEveryKindOfViolation) {
    const auto count = [](const char* file, const std::string& included) {
        return find_violations(file, "// c\n" + included + "\n").size();
    };
    EXPECT_EQ(count("perception/a.cpp", "#include \"engine/scene/scene.h\""), 1u);
    EXPECT_EQ(count("engine/scene/a.cpp", "  #  include <motion/velocity.h>"), 1u);
    EXPECT_EQ(count("engine/pose/a.cpp", "#include \"perception/a.h\"\n#include \"render/settings/a.h\""), 2u);
    EXPECT_EQ(count("engine/base/a.h", "#include \"engine/base/../scene/scene.h\""), 1u);
    EXPECT_EQ(count("engine/gltf/validate/a.cpp", "#include \"engine/gltf/reader.h\""), 1u);
    EXPECT_EQ(count("render/frame/a.cpp", "#include \"render/cli/support/options.h\""), 1u);
    EXPECT_EQ(count("render/frame/a.cpp", "#include \"../render/settings/settings.h\""), 1u);
    EXPECT_EQ(count("render/frame/a.cpp", "#include \"tests/support/helper.h\""), 1u);
    EXPECT_EQ(count("perception/a.cpp", "#include <vector>\n#include \"engine/base/image.h\""), 0u);
    EXPECT_EQ(count("engine/scene_file/a.cpp", "#include \"schema.inc\""), 0u);
    EXPECT_EQ(count("engine/gltf/a.cpp", "#include \"engine/gltf/validate/validate.h\""), 0u);
    EXPECT_EQ(count("render/cli/a.cpp", "#include \"render/settings/settings.h\"\n#include \"render/cli/b.h\""), 0u);
}

}  // namespace
}  // namespace aleph
