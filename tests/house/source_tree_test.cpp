// Rules for the source tree: what lies at the top, how long files are, and which pages texts refer to.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

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
            const std::string text = read_bytes(source_folder() / path);
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

/// Names of the Markdown files that a text refers to, without their folders.
std::set<std::string> find_cited_pages(const std::string& text) {
    static const std::regex page(R"re([A-Za-z0-9_-]+\.md\b)re");
    std::set<std::string> names;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), page); it != std::sregex_iterator(); ++it)
        names.insert(it->str());
    return names;
}

TEST(House, PagesThatAreCitedExist) {
    constexpr std::array folders = {"engine", "motion", "perception", "render", "scenes", "tests"};
    std::set<std::string> pages = {"README.md"};
    for (const char* folder : folders) {
        for_each_file(folder, [&](const fs::path& path) {
            if (path.extension() == ".md") pages.insert(path.filename().string());
        });
    }
    const auto check = [&](const fs::path& path) {
        if (!is_text(path)) return;
        for (const std::string& name : find_cited_pages(read_bytes(source_folder() / path)))
            EXPECT_TRUE(pages.contains(name)) << path << " refers to " << name << ", which is not in the repository";
    };
    for (const char* folder : folders) for_each_file(folder, check);
    for (const char* file : {"CMakeLists.txt", "README.md"}) check(file);
}

TEST(House, CitedPagesAreFound) {
    const std::string end = ".md";  // apart, so that this file itself cites nothing
    EXPECT_EQ(find_cited_pages("// see render/README" + end + " and NOTES" + end + "."),
              (std::set<std::string>{"NOTES" + end, "README" + end}));
    EXPECT_TRUE(find_cited_pages("a.mdx, file.m, md").empty());
}

}  // namespace
}  // namespace aleph
