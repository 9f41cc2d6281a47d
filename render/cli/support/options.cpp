#include "render/cli/support/options.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>

#include "engine/base/errors.h"

namespace aleph {

namespace {

template <class T>
const char* kind_of() {
    if constexpr (std::is_floating_point_v<T>) return "a number";
    if constexpr (std::is_unsigned_v<T>) return "a whole number of at least 0";
    return "a whole number";
}

}  // namespace

std::string option_label(const CLI::Option& option) {
    if (!option.get_lnames().empty()) return "--" + option.get_lnames().front();
    return option.get_snames().empty() ? option.get_name(true) : "-" + option.get_snames().front();
}

template <class T>
T parse_value(std::string_view text, const std::string& option) {
    T value{};
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    bool good = error == std::errc{} && end == text.data() + text.size();
    if constexpr (std::is_floating_point_v<T>) good = good && std::isfinite(value);
    if (!good) {
        const char* reason = error == std::errc::result_out_of_range ? " in range" : "";
        throw CLI::ConversionError(fmt::format("{}: '{}' is not {}{}", option, printable(text), kind_of<T>(), reason));
    }
    return value;
}

template int parse_value<int>(std::string_view, const std::string&);
template std::uint32_t parse_value<std::uint32_t>(std::string_view, const std::string&);
template double parse_value<double>(std::string_view, const std::string&);

template <class T>
CLI::Option* add_value(CLI::App& app, const std::string& option, T& value, const std::string& help) {
    const auto read = [&value, option](const std::string& text) { value = parse_value<T>(text, option); };
    return app.add_option_function<std::string>(option, read, help)
        ->type_name(std::is_floating_point_v<T> ? "NUMBER" : "N")
        ->default_str(fmt::format("{}", value));
}

template CLI::Option* add_value<int>(CLI::App&, const std::string&, int&, const std::string&);
template CLI::Option* add_value<std::uint32_t>(CLI::App&, const std::string&, std::uint32_t&, const std::string&);
template CLI::Option* add_value<double>(CLI::App&, const std::string&, double&, const std::string&);

void add_progress_form(CLI::App& app, std::string& form) {
    add_text(app, "--progress", "auto|json", form,
             "how progress is shown on standard error: a bar or lines (auto), or an object of JSON a line, for other "
             "programs: progress, share (0 to 1), elapsed and remaining (seconds), what (json)")
        ->check(CLI::IsMember({"auto", "json"}))
        ->capture_default_str();
}

double parse_seconds(const std::string& text, const std::string& option) {
    const double seconds = parse_value<double>(text, option);
    if (!(seconds > 0.0)) throw InputError(option, printable(text), "expected seconds above 0");
    return seconds;
}

}  // namespace aleph
