#pragma once
// Options that read numbers the same way in every locale. Only files that add options include CLI11, which takes long
// to compile.

#include <CLI/CLI.hpp>
#include <string>
#include <string_view>

#include "render/cli/support/command.h"

namespace aleph {

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

}  // namespace aleph
