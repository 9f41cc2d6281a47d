// Rules for the source tree: includes point one way, files are short, and texts cite only what the repository holds.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"

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
        for (const char* folder : {"pose", "rays", "image", "json", "scene_file", "gltf", "alembic"})
            engine.push_back(std::string("engine/") + folder);
        const std::vector<std::string> below_load = engine;
        engine.push_back("engine/load");
        std::vector<std::string> stages = engine;
        for (const char* folder : {"motion", "perception"}) stages.push_back(folder);
        std::vector<std::string> all_below_cli = stages;
        all_below_cli.push_back("render");
        const auto with = [](std::vector<std::string> folders, std::initializer_list<const char*> more) {
            folders.insert(folders.end(), more.begin(), more.end());
            return folders;
        };
        return std::vector<Layer>{
            {"engine/base", {}},
            {"engine/scene", {"engine/base"}},
            {"engine/surface", {"engine/base", "engine/scene"}},
            {"engine/pose", model},
            {"engine/rays", with(model, {"engine/pose"})},
            {"engine/image", {"engine/base"}},
            {"engine/json", {"engine/base"}},
            {"engine/scene_file", text},
            {"engine/gltf/validate", {"engine/base", "engine/json"}},
            {"engine/gltf", with(text, {"engine/image", "engine/gltf/validate"})},
            {"engine/alembic", with(model, {"engine/json"})},
            {"engine/load", below_load},
            {"motion", engine},
            {"perception", {"engine/base"}},
            {"render", stages},
            {"render/cli", all_below_cli},
        };
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

/// What the #include lines of a text name, in quotes or in angle brackets.
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

std::string read_file(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

TEST(House, IncludesPointOneWay) {
    const fs::path root = source_folder();
    int files = 0, own_includes = 0;
    for (const char* folder : {"engine", "motion", "perception", "render"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            const std::string path = fs::relative(entry.path(), root).generic_string();
            if (path.find("node_modules") != std::string::npos) continue;
            if (!entry.is_regular_file() || (entry.path().extension() != ".h" && entry.path().extension() != ".cpp"))
                continue;
            ++files;
            const std::string text = read_file(entry.path());
            for (const std::string& violation : find_violations(path, text)) ADD_FAILURE() << violation;
            for (const std::string& included : included_paths(text)) own_includes += layer_of(included) != nullptr;
        }
    }
    EXPECT_GT(files, 40);          // the folders were found
    EXPECT_GT(own_includes, 100);  // and their includes understood
}

TEST(House, EveryFolderIsALayer) {
    const fs::path root = source_folder();
    std::set<std::string> known;
    for (const Layer& layer : layers()) known.insert(layer.folder);
    for (const char* folder : {"engine", "motion", "perception", "render"}) {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(root / folder)) {
            if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
            const std::string own = fs::relative(entry.path().parent_path(), root).generic_string();
            if (own.find("node_modules") != std::string::npos) continue;
            EXPECT_TRUE(known.contains(own)) << entry.path() << " lies in a folder that layers() does not list";
        }
    }
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
    const auto count = [](const char* file, const char* text) { return find_violations(file, text).size(); };
    EXPECT_EQ(count("perception/a.cpp", "#include \"engine/scene/scene.h\"\n"), 1u);
    EXPECT_EQ(count("perception/a.cpp", "#include \"motion/velocity.h\"\n"), 1u);
    EXPECT_EQ(count("engine/scene/a.cpp", "// c\n  #  include <motion/velocity.h>\n"), 1u);
    EXPECT_EQ(count("engine/pose/a.cpp", "#include \"perception/perception.h\"\n#include \"render/settings.h\"\n"), 2u);
    EXPECT_EQ(count("engine/base/a.h", "#include \"engine/scene/scene.h\"\n"), 1u);
    EXPECT_EQ(count("engine/base/a.h", "#include \"engine/base/../scene/scene.h\"\n"), 1u);
    EXPECT_EQ(count("engine/scene/a.h", "#include \"engine/pose/pose.h\"\n"), 1u);
    EXPECT_EQ(count("engine/surface/a.h", "#include \"engine/rays/ray_scene.h\"\n"), 1u);
    EXPECT_EQ(count("engine/json/a.h", "#include \"engine/gltf/gltf.h\"\n"), 1u);
    EXPECT_EQ(count("engine/gltf/a.cpp", "#include \"engine/scene_file/fields.h\"\n"), 1u);
    EXPECT_EQ(count("engine/gltf/validate/a.cpp", "#include \"engine/gltf/reader.h\"\n"), 1u);
    EXPECT_EQ(count("engine/image/a.h", "#include \"engine/load/load_scene.h\"\n"), 1u);
    EXPECT_EQ(count("motion/a.cpp", "#include \"perception/perception.h\"\n"), 1u);
    EXPECT_EQ(count("render/a.cpp", "#include \"render/cli/options.h\"\n"), 1u);
    EXPECT_EQ(count("render/a.cpp", "#include \"../render/settings.h\"\n"), 1u);
    EXPECT_EQ(count("render/a.cpp", "#include \"tests/unit/helper.h\"\n"), 1u);

    EXPECT_EQ(
        count("perception/a.cpp", "#include <vector>\n#include \"engine/base/image.h\"\n#include \"perception/b.h\"\n"),
        0u);
    EXPECT_EQ(count("engine/scene_file/a.cpp", "#include \"engine/base/image.h\"\n#include \"schema.inc\"\n"), 0u);
    EXPECT_EQ(count("engine/gltf/a.cpp", "#include \"engine/gltf/validate/validate.h\"\n"), 0u);
    EXPECT_EQ(count("motion/a.cpp", "#include \"engine/scene/scene.h\"\n"), 0u);
    EXPECT_EQ(count("render/cli/a.cpp", "#include \"render/settings.h\"\n#include \"render/cli/b.h\"\n"), 0u);
    EXPECT_EQ(count("render/a.cpp", "#include \"perception/perception.h\"\n#include \"motion/velocity.h\"\n"), 0u);
}

/// Visible entries of a folder that do not belong at the top of the repository.
std::vector<std::string> find_strays(const fs::path& root) {
    static const std::set<std::string> given = {"CMakeLists.txt", "README.md", "engine", "motion",
                                                "perception",     "render",    "scenes", "tests"};
    std::vector<std::string> strays;
    for (const fs::directory_entry& entry : fs::directory_iterator(root)) {
        const std::string name = entry.path().filename().string();
        if (!name.starts_with(".") && !name.starts_with("build") && !given.contains(name)) strays.push_back(name);
    }
    return strays;
}

TEST(House, TopHoldsNothingElse) {
    for (const std::string& name : find_strays(source_folder())) ADD_FAILURE() << name << " does not belong at the top";
    for (const char* name :
         {"CMakeLists.txt", "README.md", "engine", "motion", "perception", "render", "scenes", "tests"}) {
        EXPECT_TRUE(fs::exists(source_folder() / name)) << name;
    }
}

TEST(House, StraysAreSeen) {
    const fs::path folder = fs::path(testing::TempDir()) / "aleph_house_test";
    fs::remove_all(folder);
    fs::create_directories(folder / "docs");
    fs::create_directories(folder / "engine");
    fs::create_directories(folder / "build-debug");
    std::ofstream(folder / ".clang-format") << "";
    EXPECT_EQ(find_strays(folder), (std::vector<std::string>{"docs"}));
    fs::remove_all(folder);
}

bool is_text(const fs::path& path) {
    static const std::set<std::string> extensions = {".h",  ".cpp", ".md",   ".txt", ".cmake",
                                                     ".in", ".sh",  ".json", ".js"};
    return extensions.contains(path.extension().string());
}

/// Calls visit(path from the root) for every file below a folder of the repository.
template <class Visit>
void for_each_file(const std::string& folder, const Visit& visit) {
    const fs::path root = source_folder();
    for (auto it = fs::recursive_directory_iterator(root / folder); it != fs::recursive_directory_iterator(); ++it) {
        if (it->path().filename() == "node_modules") it.disable_recursion_pending();
        if (it->is_regular_file()) visit(fs::relative(it->path(), root));
    }
}

TEST(House, SourceFilesAreShort) {
    std::vector<std::ptrdiff_t> lengths;
    for (const char* folder : {"engine", "motion", "perception", "render"}) {
        for_each_file(folder, [&](const fs::path& path) {
            if (path.extension() != ".h" && path.extension() != ".cpp") return;
            const std::string text = read_file(source_folder() / path);
            lengths.push_back(std::count(text.begin(), text.end(), '\n'));
            EXPECT_LE(lengths.back(), 300) << path << ": cut it by subject";
        });
    }
    ASSERT_FALSE(lengths.empty());
    const auto middle = lengths.begin() + std::ssize(lengths) / 2;
    std::nth_element(lengths.begin(), middle, lengths.end());
    EXPECT_LT(*middle, 120) << "lines in the median file";
    RecordProperty("median_lines", static_cast<int>(*middle));
}

/// Names of documents that are not part of the repository, as far as a text has them as whole words.
std::vector<std::string> find_outside_citations(const std::string& text) {
    // In two parts, so that this file does not contain them.
    static const std::vector<std::string> names = {
        "HARD"
        "_CASES",
        "MOD"
        "EL.md",
        "DES"
        "IGN",
        "CONVEN"
        "TIONS",
        "PERFOR"
        "MANCE"};
    const auto in_word = [](char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)) != 0; };
    std::vector<std::string> found;
    for (const std::string& name : names) {
        for (auto at = text.find(name); at != std::string::npos; at = text.find(name, at + 1)) {
            const auto end = at + name.size();
            if ((at > 0 && in_word(text[at - 1])) || (end < text.size() && in_word(text[end]))) continue;
            found.push_back(name);
            break;
        }
    }
    return found;
}

TEST(House, CitationsStayInTheRepository) {
    const auto check = [](const fs::path& path) {
        if (!is_text(path)) return;
        for (const std::string& name : find_outside_citations(read_file(source_folder() / path)))
            ADD_FAILURE() << path << " cites " << name << ", which is not in the repository";
    };
    for (const char* folder : {"engine", "motion", "perception", "render", "scenes", "tests"})
        for_each_file(folder, check);
    for (const char* file : {"CMakeLists.txt", "README.md"}) check(file);
}

TEST(House, CitationsAreFound) {
    EXPECT_EQ(find_outside_citations("// see HARD"
                                     "_CASES DT-09")
                  .size(),
              1u);
    EXPECT_EQ(find_outside_citations("DES"
                                     "IGN \"A frame\", MOD"
                                     "EL.md")
                  .size(),
              2u);
    EXPECT_EQ(find_outside_citations("DES"
                                     "IGNED MY_DES"
                                     "IGN DT-09 (tests/hard/README.md)")
                  .size(),
              0u);
}

}  // namespace
}  // namespace aleph
