// tests/HAZARDS.md and the tests name the same hazards.
// The pages that texts refer to exist, and the files that READMEs list.

#include <regex>

#include "tests/support/paths.h"
#include "tests/support/read_bytes.h"
#include "tests/support/test.h"

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

struct TestLink {
    std::string filter;  ///< of GoogleTest; empty: none, the file alone
    fs::path file;
};

/// Rows of the page: where the tests of an ID are.
using Rows = std::map<std::string, std::vector<TestLink>>;

Rows read_rows(const fs::path& page) {
    static const std::regex row(R"re(^\| ([A-Z0-9]{2}-\d\d|S1[23]_\d+) \| .{10,} \|(.*)\|$)re"),
        link(R"re(\[(?:`([^`]+)`|[^`\]]+)\]\(([^)]+)\))re");
    Rows rows;
    std::ifstream file(page);
    for (std::string line; std::getline(file, line);) {
        std::smatch match;
        if (!std::regex_match(line, match, row)) continue;
        const std::string id = *list_ids(match[1].str()).begin();
        EXPECT_EQ(rows.count(id), 0u) << id << " has two rows";
        const std::string links = match[2].str();
        for (auto it = std::sregex_iterator(links.begin(), links.end(), link); it != std::sregex_iterator(); ++it)
            rows[id].push_back({(*it)[1].str(), (page.parent_path() / (*it)[2].str()).lexically_normal()});
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
        for (const auto& [filter, file] : files) {
            const auto found = ids_by_file().find(file);
            ASSERT_NE(found, ids_by_file().end()) << id << ": there is no " << file;
            EXPECT_TRUE(found->second.contains(id)) << file << " does not name " << id;
        }
    }
}

/// Names of the tests in a text, as GoogleTest has them. Parameters that have an ID in their names stand behind their
/// fixture; other parameters, and the tests of fixtures that another file has, are left out.
std::set<std::string> list_tests(const std::string& text) {
    static const std::regex test(R"re(\bTEST(_[FP])?\(\s*(\w+),\s*(\w+)\s*\))re"),
        instance(R"re(\bINSTANTIATE_TEST_SUITE_P\(\s*(\w+),\s*(\w+))re"), parameter(R"re("([A-Z0-9]+_\w+)")re");
    std::multimap<std::string, std::string> prefixes;  // by fixture
    for (auto it = std::sregex_iterator(text.begin(), text.end(), instance); it != std::sregex_iterator(); ++it)
        prefixes.emplace((*it)[2].str(), (*it)[1].str() + "/");
    std::set<std::string> names;
    for (auto it = std::sregex_iterator(text.begin(), text.end(), test); it != std::sregex_iterator(); ++it) {
        const std::string fixture = (*it)[2].str(), name = fixture + "." + (*it)[3].str();
        if ((*it)[1].str() != "_P") names.insert(name);
        const auto [first, last] = prefixes.equal_range(fixture);
        for (auto prefix = first; prefix != last; ++prefix) names.insert(prefix->second + name + "/0");
    }
    for (const auto& [fixture, prefix] : prefixes)
        for (const std::string& name : find_all(text, parameter)) names.insert(prefix + fixture + "./" + name);
    return names;
}

/// Returns whether a filter of GoogleTest has a name: * stands for any text.
bool matches(const std::string& filter, const std::string& name) {
    std::string pattern;
    for (const char c : filter) pattern += c == '*' ? ".*" : c == '.' ? "\\." : std::string(1, c);
    return std::regex_match(name, std::regex(pattern));
}

TEST(HardReadme, EveryFilterHasATestOfItsFile) {
    std::map<fs::path, std::set<std::string>> tests;
    for (const auto& [id, links] : read_rows(source_folder() / "tests/HAZARDS.md")) {
        for (const auto& [filter, file] : links) {
            if (filter.empty() || file.extension() != ".cpp") continue;
            if (!tests.contains(file)) tests[file] = list_tests(read_bytes(file));
            EXPECT_TRUE(std::ranges::any_of(tests[file], [&](const auto& name) { return matches(filter, name); }))
                << id << ": no test of " << file << " has the filter " << filter;
        }
    }
}

TEST(HardReadme, TestsWithParametersHaveTheirPrefix) {
    const std::string macro = "TE";  // apart, so that this file has no such tests
    const std::set<std::string> names = list_tests(
        macro + "ST(A, KF01_B) {}\n" + macro + "ST_P(C, KF02_D) {}\nINSTANTIATE_" + macro + "ST_SUITE_P(All, C, x);");
    EXPECT_EQ(names, (std::set<std::string>{"A.KF01_B", "All/C.KF02_D/0"}));
    EXPECT_TRUE(matches("A.*KF01*", "A.KF01_B"));
    EXPECT_FALSE(matches("C.*KF02*", "All/C.KF02_D/0"));
    EXPECT_TRUE(matches("*C.*KF02*", "All/C.KF02_D/0"));
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

/// Names of the Markdown files that a text refers to, without their folders.
std::set<std::string> find_cited_pages(const std::string& text) {
    static const std::regex page(R"re(([A-Za-z0-9_-]+\.md)\b)re");
    const std::vector<std::string> found = find_all(text, page);
    return {found.begin(), found.end()};
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

/// Names in the first column of tables of files or folders, such as `scene_options.*` and `explain/`.
std::set<std::string> find_listed_files(const std::string& text) {
    static const std::regex name(R"re(`([^`]+)`)re");
    std::set<std::string> listed;
    std::istringstream lines(text);
    bool in_table = false, lists_files = false;
    for (std::string line; std::getline(lines, line);) {
        const bool is_head = !in_table;
        in_table = line.starts_with('|');
        if (is_head) lists_files = line.starts_with("| file") || line.starts_with("| folder");
        if (!lists_files || !in_table) continue;
        for (const std::string& each : find_all(line.substr(0, line.find('|', 1)), name)) listed.insert(each);
    }
    return listed;
}

TEST(House, FilesThatReadmesListExist) {
    std::size_t found = 0;
    const auto check = [&](const fs::path& page) {
        if (page.filename() != "README.md") return;
        const fs::path folder = source_folder() / page.parent_path();
        for (const std::string& name : find_listed_files(read_bytes(source_folder() / page))) {
            ++found;
            std::error_code ignored;
            const fs::path path = (folder / name).lexically_normal();
            const bool exists =
                fs::exists(path) ||
                std::ranges::any_of(fs::directory_iterator(path.parent_path(), ignored), [&](const auto& entry) {
                    return matches(path.filename().string(), entry.path().filename().string());
                });
            EXPECT_TRUE(exists) << page << " lists " << name;
        }
    };
    for (const char* folder : {"engine", "motion", "perception", "render", "tests"}) for_each_file(folder, check);
    EXPECT_GT(found, 200u);
}

TEST(House, CitedPagesAreFound) {
    const std::string end = ".md";  // apart, so that this file itself cites nothing
    EXPECT_EQ(find_cited_pages("// see render/README" + end + " and NOTES" + end + "."),
              (std::set<std::string>{"NOTES" + end, "README" + end}));
    EXPECT_TRUE(find_cited_pages("a.mdx, file.m, md").empty());
}

}  // namespace
}  // namespace aleph
