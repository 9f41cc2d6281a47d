// The pages that texts refer to exist.

#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

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
