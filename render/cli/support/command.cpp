#include "render/cli/support/command.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "render/cli/support/options.h"
#include "render/cli/support/render_signals.h"

namespace aleph {

namespace {

/// Writes one line without control characters. @return the code
int report(std::ostream& errors, const std::string& message, int code) {
    errors << "aleph: error: " << printable(message, 4000) << "\n" << std::flush;
    return code;
}

/// Ends the program as its reader has ended, such as `head` that has read enough, if some of what was printed is lost.
/// @throws OutputError where it is lost for another reason
void flush_results() {
    const bool printed = static_cast<bool>(std::cout.flush());
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && printed) return;
    pollfd output{STDOUT_FILENO, 0, 0};
    if (::poll(&output, 1, 0) == 1 && (output.revents & POLLERR) != 0) {
        std::signal(SIGPIPE, SIG_DFL);
        std::raise(SIGPIPE);
    }
    throw OutputError("standard output", "cannot write the results");
}

/// Refuses an empty value, as of a variable of a script that was never set. CLI11 takes whatever follows an option for
/// its value, so that a forgotten file name would make a file "--aovs".
/// @throws CLI::ValidationError naming the option
void refuse_missing_values(const CLI::App& app) {
    for (const CLI::Option* option : app.get_options()) {
        for (const std::string& value : option->results()) {
            if (value.empty()) throw CLI::ValidationError(option_label(*option), "its value is empty");
            // Negative numbers are values.
            const bool is_option =
                value.starts_with("--") || (value.starts_with("-") && app.get_option_no_throw(value) != nullptr);
            if (option->get_positional() || !is_option) continue;
            throw CLI::ValidationError(option_label(*option),
                                       fmt::format("a value is missing before {} (a file of that name is ./{})",
                                                   printable(value), printable(value)));
        }
    }
    for (const CLI::App* subcommand : app.get_subcommands()) refuse_missing_values(*subcommand);
}

/// The subcommand that was given, or that of a subcommand; else the program.
const CLI::App& chosen_app(const CLI::App& app) {
    const auto chosen = app.get_subcommands();
    return chosen.empty() ? app : chosen_app(*chosen.front());
}

/// "aleph farm slurm"
std::string words_of(const CLI::App& app) {
    return app.get_parent() == nullptr ? "aleph" : words_of(*app.get_parent()) + " " + app.get_name();
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
    std::vector<std::string> names;
    for (const CLI::App* each : app.get_subcommands({})) names.push_back(each->get_name());
    return names;
}

std::string where_to_look(const CLI::App& app) {
    const std::string words = words_of(chosen_app(app));
    const std::vector<std::string> names = subcommand_names(chosen_app(app));
    if (names.empty()) return fmt::format("{} --help lists the options", words);
    return fmt::format("commands: {}; {} --help describes them", fmt::join(names, ", "), words);
}

/// Describes the first argument that no option takes, and suggests what may have been meant.
std::string describe_unexpected(const CLI::App& app) {
    const CLI::App& chosen = chosen_app(app);
    const std::vector<std::string> arguments = app.remaining(true);
    const auto option = std::ranges::find_if(arguments, [](const auto& text) { return text.starts_with("-"); });
    if (option != arguments.end()) {
        std::vector<std::string> known;
        const std::string name = option->substr(0, option->find('='));
        for (const CLI::Option* each : chosen.get_options()) {
            for (const std::string& long_name : each->get_lnames()) known.push_back("--" + long_name);
        }
        return fmt::format("there is no option {}{}", printable(name), close_suggestion(name, known));
    }
    const std::string text = arguments.empty() ? "" : arguments.front();
    const std::vector<std::string> known = subcommand_names(chosen);
    if (known.empty()) return fmt::format("'{}' is one argument too many", printable(text));
    return fmt::format("there is no command {}{}", printable(text), close_suggestion(text, known));
}

void let_last_value_count(CLI::App& app) {
    for (CLI::Option* option : app.get_options()) {
        if (!option->get_positional() && option->get_expected_max() == 1) option->take_last();
    }
    for (CLI::App* subcommand : app.get_subcommands({})) let_last_value_count(*subcommand);
}

}  // namespace

std::string count_text(std::size_t count, const std::string& what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

void print_warnings(const std::vector<std::string>& warnings) {
    for (const std::string& warning : warnings) std::cerr << "aleph: warning: " << printable(warning, 400) << "\n";
}

int run_command(const Command& command, std::ostream& errors) {
    try {
        const int code = command();
        flush_results();
        return code;
    } catch (const Stopped& e) {
        errors << "aleph: " << e.what() << "\n" << std::flush;
        return e.exit_code();
    } catch (const InputError& e) {
        return report(errors, e.what(), exit_bad_input);
    } catch (const CLI::Error& e) {
        return report(errors, e.what(), exit_bad_input);
    } catch (const std::bad_alloc&) {
        return report(errors, "out of memory", exit_failed);
    } catch (const std::exception& e) {
        return report(errors, e.what(), exit_failed);
    }
}

int run_program(CLI::App& app, const Command& command, int argc, const char* const* argv, std::ostream& errors) {
    const auto refuse = [&](const std::string& reason) {
        return report(errors, fmt::format("{} ({})", reason, where_to_look(app)), exit_bad_input);
    };
    let_last_value_count(app);
    try {
        app.parse(argc, argv);
        refuse_missing_values(app);
    } catch (const CLI::Success& e) {  // --help, --version
        const int code = app.exit(e);
        return run_command([code] { return code; }, errors);
    } catch (const CLI::ExtrasError&) {
        return refuse(describe_unexpected(app));
    } catch (const CLI::ParseError& e) {
        return refuse(e.what());
    } catch (const InputError& e) {
        return refuse(e.what());
    }
    if (!command) return refuse("a command is missing");
    return run_command(command, errors);
}

}  // namespace aleph
