#pragma once
// Shared by the subcommands: what they do once their options have been read; messages and exit codes of errors.

#include <cstddef>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace aleph {

/// The work of a subcommand, to be done after its options have been read; returns the exit code.
using Command = std::function<int()>;

enum ExitCode : int {
    exit_done = 0,
    exit_different = 1,  ///< of `aleph compare`
    exit_failed = 1,
    exit_bad_input = 2,  ///< wrong usage, or a scene or picture that cannot be read
    exit_beyond = 3,     ///< `aleph render --strict`: all is written, but errs by more than was asked for
    exit_again = 75,     ///< a signal stopped it; the same command goes on from there (EX_TEMPFAIL of sysexits)
};

/// "1 frame", "12 frames".
std::string count_text(std::size_t count, const std::string& what);

/// Prints each as a line on standard error.
void print_warnings(const std::vector<std::string>& warnings);

/// Reads the command line, which sets `command`, and runs the command. An error is reported in one line on `errors`.
/// @return the command's exit code, 2 for wrong usage and InputError, 1 for any other error
int run_program(CLI::App& app, const Command& command, int argc, const char* const* argv, std::ostream& errors);

/// Runs a command; errors as in run_program.
int run_command(const Command& command, std::ostream& errors);

}  // namespace aleph
