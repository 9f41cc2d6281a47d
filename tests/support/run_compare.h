#pragma once
// `aleph compare` without starting the program.

#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include "render/cli/commands.h"

namespace aleph {

struct CompareOutcome {
    int code;
    std::string out, errors;
};

/// @param arguments  what follows `aleph compare`
inline CompareOutcome run_compare(const std::vector<std::string>& arguments) {
    CLI::App app{"test"};
    Command command;
    app.require_subcommand(0, 1);
    add_compare_command(app, command);
    std::vector<const char*> argv{"aleph", "compare"};
    for (const std::string& argument : arguments) argv.push_back(argument.c_str());
    std::ostringstream errors;
    testing::internal::CaptureStdout();
    const int code = run_program(app, command, static_cast<int>(argv.size()), argv.data(), errors);
    return {code, testing::internal::GetCapturedStdout(), errors.str()};
}

}  // namespace aleph
