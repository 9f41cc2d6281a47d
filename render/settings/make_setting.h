#pragma once
// Makes the entries of the table of render settings, by the type of their values.

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "render/settings/setting_table.h"

namespace aleph {

/// Gives a reference to a field of the settings, or to one of a group.
template <class Value>
auto at(Value RenderSettings::*field) {
    return [=](auto& settings) -> auto& {
        return settings.*field;
    };
}
template <class Group, class Value>
auto at(Group RenderSettings::*group, Value Group::*field) {
    return [=](auto& settings) -> auto& {
        return settings.*group.*field;
    };
}
template <class Field>
using ValueOf = std::remove_cvref_t<std::invoke_result_t<Field, RenderSettings&>>;

inline Setting new_setting(std::string key, SettingType type, std::string help) {
    Setting setting;
    setting.key = std::move(key);
    setting.type = type;
    setting.help = std::move(help);
    return setting;
}

/// A number, of a field that at() gives.
template <class Field>
Setting number_setting(std::string key, std::string help, Field field, double min, double max, std::string unit = {}) {
    using Number = ValueOf<Field>;
    constexpr auto type = std::is_integral_v<Number> ? SettingType::whole_number : SettingType::number;
    Setting setting = new_setting(std::move(key), type, std::move(help));
    setting.unit = std::move(unit);
    setting.min = min;
    setting.max = max;
    setting.get = [=](const RenderSettings& s) { return SettingValue(static_cast<double>(field(s))); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) {
        field(s) = static_cast<Number>(std::get<double>(value));
    };
    return setting;
}

/// A choice among names.
template <class Field>
Setting choice_setting(std::string key, std::string help, Field field,
                       std::vector<std::pair<std::string, ValueOf<Field>>> values) {
    Setting setting = new_setting(std::move(key), SettingType::choice, std::move(help));
    for (const auto& [name, value] : values) setting.choices.push_back(name);
    setting.get = [=](const RenderSettings& s) {
        const auto found = std::ranges::find(values, field(s), [](const auto& v) { return v.second; });
        return SettingValue(found == values.end() ? std::string() : found->first);
    };
    setting.set = [=](RenderSettings& s, const SettingValue& chosen) {
        for (const auto& [name, value] : values) {
            if (name == std::get<std::string>(chosen)) field(s) = value;
        }
    };
    return setting;
}

template <class Field>
Setting boolean_setting(std::string key, std::string help, Field field) {
    Setting setting = new_setting(std::move(key), SettingType::boolean, std::move(help));
    setting.get = [=](const RenderSettings& s) { return SettingValue(field(s)); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) { field(s) = std::get<bool>(value); };
    return setting;
}

/// A set of effects, by their names.
template <class Field>
Setting effects_setting(std::string key, std::string help, Field field) {
    Setting setting = new_setting(std::move(key), SettingType::names, std::move(help));
    for (const EffectName& effect : effect_list) setting.choices.push_back(effect.name);
    setting.get = [=](const RenderSettings& s) { return SettingValue(format_effects(field(s))); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) {
        std::string unknown;
        field(s) = parse_effects(std::get<std::string>(value), unknown);
    };
    return setting;
}

/// Changes to an entry.
inline Setting without_scene(Setting setting) {
    setting.needs_scene = false;
    return setting;
}
inline Setting rarely_set(Setting setting) {
    setting.rare = true;
    return setting;
}

}  // namespace aleph
