#pragma once
// Shared by the subcommands: options that read numbers the same way in every locale; messages and exit codes of errors.

#include <CLI/CLI.hpp>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

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

/// An option as users type it: "--error"; the name of a positional one. CLI11's own get_name() has none for options
/// that only --help-all shows.
std::string option_label(const CLI::Option& option);

/// A number as JSON and C++ write it, with a decimal point in every locale. The whole text has to be a finite number in
/// the range of T.
/// @throws CLI::ConversionError naming the option
template <class T>
T parse_value(std::string_view text, const std::string& option);

/// Adds an option that fills `value` (int, std::uint32_t or double). Help shows its present value as the default.
template <class T>
CLI::Option* add_value(CLI::App& app, const std::string& option, T& value, const std::string& help);

/// Adds an option that fills `value`, a text or several.
/// @param type  the value's name in help: "FILE"
template <class T>
CLI::Option* add_text(CLI::App& app, const std::string& option, const char* type, T& value, const std::string& help) {
    return app.add_option(option, value, help)->type_name(type);
}

/// Adds --progress, which fills the form of progress_look.
void add_progress_form(CLI::App& app, std::string& form);

/// A time of a clock.
/// @throws CLI::ConversionError for what is no number, InputError (the option) for one that is not above 0
double parse_seconds(const std::string& text, const std::string& option);

/// Adds an option without a default that fills `value`, a double or an optional one.
template <class T>
CLI::Option* add_number(CLI::App& app, const std::string& option, T& value, const std::string& help) {
    const auto read = [&value, option](const std::string& text) { value = parse_value<double>(text, option); };
    return app.add_option_function<std::string>(option, read, help)->type_name("NUMBER");
}

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
