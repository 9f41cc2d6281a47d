// Which values a setting may have.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/errors.h"
#include "render/settings/setting_table.h"

namespace aleph {

std::optional<PictureSize> parse_picture_size(const std::string& text) {
    PictureSize size;
    const char* const end = text.data() + text.size();
    const auto [x, failure] = std::from_chars(text.data(), end, size.width);
    if (failure != std::errc() || x == end || *x != 'x') return std::nullopt;
    const auto [rest, failure_2] = std::from_chars(x + 1, end, size.height);
    if (failure_2 != std::errc() || rest != end) return std::nullopt;
    return size;
}

namespace {

constexpr std::int64_t max_pixels = std::int64_t{1} << 28;

/// The allowed values in words: "a number from 0 to 1", "one of flat, direct".
std::string describe_values(const Setting& setting) {
    switch (setting.type) {
        case SettingType::size:
            return fmt::format("WIDTHxHEIGHT in {}, each from {:.0f} to {:.0f}, such as 640x480", setting.unit,
                               setting.min, setting.max);
        case SettingType::whole_number:
            return fmt::format("a whole number from {:.0f} to {:.0f}", setting.min, setting.max);
        case SettingType::number:
            return fmt::format("a number from {:g} to {:g}", setting.min, setting.max);
        case SettingType::choice:
            return fmt::format("{}{}", setting.choices.size() > 1 ? "one of " : "", fmt::join(setting.choices, ", "));
        case SettingType::names:
            return fmt::format("names separated by commas, of {}", fmt::join(setting.choices, ", "));
        case SettingType::boolean:
            return "true or false";
    }
    return {};
}

}  // namespace

std::string find_mismatch(const Setting& setting, const SettingValue& value) {
    const double* const number = std::get_if<double>(&value);
    const std::string* const text = std::get_if<std::string>(&value);
    const auto in_range = [&](double v) { return v >= setting.min && v <= setting.max; };  // false for NaN
    switch (setting.type) {
        case SettingType::size: {
            const auto size = text != nullptr ? parse_picture_size(*text) : std::nullopt;
            if (!size || !in_range(size->width) || !in_range(size->height)) break;
            if (std::int64_t{size->width} * size->height <= max_pixels) return {};
            return "more than 2^28 pixels; expected " + describe_values(setting);
        }
        case SettingType::whole_number:
            if (number != nullptr && in_range(*number) && *number == std::floor(*number)) return {};
            break;
        case SettingType::number:
            if (number != nullptr && in_range(*number)) return {};
            break;
        case SettingType::choice:
            if (text != nullptr && std::ranges::find(setting.choices, *text) != setting.choices.end()) return {};
            break;
        case SettingType::names: {
            if (text == nullptr) break;
            std::string unknown;
            parse_effects(*text, unknown);
            if (unknown.empty()) return {};
            return fmt::format("there is no effect {}; known are {}", printable(unknown),
                               fmt::join(setting.choices, ", "));
        }
        case SettingType::boolean:
            if (std::holds_alternative<bool>(value)) return {};
            break;
    }
    return "expected " + describe_values(setting);
}

}  // namespace aleph
