#pragma once
// Comparisons as test results: JUnit's XML, which CI services show.

#include <filesystem>
#include <string>
#include <vector>

#include "render/cli/compare/compare_options.h"
#include "render/compare/compare_sequence.h"

namespace aleph {

inline constexpr const char* junit_suite = "aleph compare";

struct JunitCase {
    std::string name;
    std::string failure;  ///< why the test failed; empty: it passed
};

/// One test case of two pictures, in words.
JunitCase make_junit_case(const std::string& name, const CompareResult& result,
                          const std::optional<VisibleShares>& visible, const CompareSettings& settings, bool same);

/// Writes one test suite.
/// @throws OutputError
void write_junit(const std::filesystem::path& path, const std::string& suite, const std::vector<JunitCase>& cases);

}  // namespace aleph
