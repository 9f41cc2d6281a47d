#pragma once
// What the subcommands share: options that read numbers the same way in every country, and the one place where
// errors become messages and exit codes.

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace aleph {

/// A subcommand whose options have been read: does the work and returns the exit code.
using Command = std::function<int()>;

enum ExitCode : int {
    exit_done = 0,
    exit_different = 1,  ///< `aleph compare` alone
    exit_failed = 1,
    exit_bad_input = 2,  ///< usage, scene, picture
};

/// Numbers as JSON and C++ write them, whatever the locale (HARD_CASES DT-09): the whole text, finite, in range.
/// @throws CLI::ConversionError naming the option
template <class T>
T parse_value(std::string_view text, const std::string& option);

/// An option that fills `value`, for int, std::uint32_t and double; what `value` holds now is shown as the default.
template <class T>
CLI::Option* add_value(CLI::App& app, const std::string& option, T& value, const std::string& help);

/// "640x480".
/// @throws CLI::ConversionError naming the option
void parse_size(std::string_view text, const std::string& option, int& width, int& height);

/// Reads the command line, with `command` to be set by the subcommand that was chosen, runs it, and says what went
/// wrong in one line: 2 for bad usage and InputError, 1 for everything else.
int run_program(CLI::App& app, const Command& command, int argc, const char* const* argv, std::ostream& errors);

/// Runs a command and turns errors into messages and exit codes.
int run_command(const Command& command, std::ostream& errors);

}  // namespace aleph
