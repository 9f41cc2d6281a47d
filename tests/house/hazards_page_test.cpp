// tests/HAZARDS.md and the tests name the same hazards.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"

namespace aleph {
namespace {

namespace fs = std::filesystem;

/// Every match of a pattern's first group.
std::vector<std::string> find_all(const std::string& text, const std::regex& pattern) {
    std::vector<std::string> found;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), pattern); it != std::sregex_iterator(); ++it)
        found.push_back((*it)[1].str());
    return found;
}

/// The IDs in a text, as test names spell them: without the hyphen.
std::set<std::string> list_ids(const std::string& text) {
    static const std::regex id(
        R"re((?:^|[^A-Za-z0-9])((?:KF|RP|RC|PY|CS|IC|MC|OU|DT|FX)-?\d\d|S1[23]_\d+)(?![0-9]))re");
    std::set<std::string> ids;
    for (std::string found : find_all(text, id)) {
        std::erase(found, '-');
        ids.insert(found);
    }
    return ids;
}

/// A row of the page: where the tests of an ID are.
using Rows = std::map<std::string, std::vector<fs::path>>;

Rows read_rows(const fs::path& page) {
    static const std::regex row(R"re(^\| ([A-Z0-9]{2}-\d\d|S1[23]_\d+) \| .{10,} \|(.*)\|$)re"),
        link(R"re(\]\(([^)]+)\))re");
    Rows rows;
    std::ifstream file(page);
    for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, row)) continue;
        const std::string id = *list_ids(match[1].str()).begin();
        EXPECT_EQ(rows.count(id), 0u) << id << " has two rows";
        for (const std::string& target : find_all(match[2].str(), link))
            rows[id].push_back(page.parent_path() / target);
    }
    return rows;
}

/// The IDs in every file of the tests, and in the page of the hard scenes.
const std::map<fs::path, std::set<std::string>>& ids_by_file() {
    static const auto all = [] {
        std::map<fs::path, std::set<std::string>> ids;
        std::vector<fs::path> files = {source_folder() / "scenes/hard/README.md"};
        for (const auto& entry : fs::recursive_directory_iterator(source_folder() / "tests")) {
            const std::string kind = entry.path().extension().string();
            if (kind == ".cpp" || kind == ".h" || kind == ".sh") files.push_back(entry.path());
        }
        for (const fs::path& file : files) ids[file] = list_ids(read_bytes(file));
        return ids;
    }();
    return all;
}

TEST(HardReadme, HasARowForEveryIdOfTheTestsAndOfTheHardScenes) {
    const Rows rows = read_rows(source_folder() / "tests/HAZARDS.md");
    for (const auto& [file, ids] : ids_by_file()) {
        for (const std::string& id : ids) EXPECT_TRUE(rows.contains(id)) << id << " of " << file << " has no row";
    }
}

TEST(HardReadme, EveryRowLeadsToTestsThatNameItsId) {
    const Rows rows = read_rows(source_folder() / "tests/HAZARDS.md");
    EXPECT_GT(rows.size(), 100u);
    for (const auto& [id, files] : rows) {
        EXPECT_FALSE(files.empty()) << id << " has no test";
        for (const fs::path& file : files) {
            const auto found = ids_by_file().find(file.lexically_normal());
            ASSERT_NE(found, ids_by_file().end()) << id << ": there is no " << file;
            EXPECT_TRUE(found->second.contains(id)) << file << " does not name " << id;
        }
    }
}

}  // namespace
}  // namespace aleph
