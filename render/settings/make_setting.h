#pragma once
// Makes the entries of the table of render settings, by the type of their values.

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "engine/scene/place.h"
#include "render/settings/setting_table.h"

namespace aleph {

/// The type of the field at the end of a path of members.
template <auto... path>
using ValueAt = std::remove_cvref_t<decltype(at<path...>(std::declval<RenderSettings&>()))>;

inline Setting new_setting(std::string key, SettingType type, std::string help) {
    Setting setting;
    setting.key = std::move(key);
    setting.type = type;
    setting.help = std::move(help);
    return setting;
}

/// A number. @param path  of members, from the settings to it
template <auto... path>
Setting number_setting(std::string key, std::string help, double min, double max, std::string unit = {}) {
    using Number = ValueAt<path...>;
    constexpr auto type = std::is_integral_v<Number> ? SettingType::whole_number : SettingType::number;
    Setting setting = new_setting(std::move(key), type, std::move(help));
    setting.unit = std::move(unit);
    setting.min = min;
    setting.max = max;
    setting.get = [=](const RenderSettings& s) { return SettingValue(static_cast<double>(at<path...>(s))); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) {
        at<path...>(s) = static_cast<Number>(std::get<double>(value));
    };
    return setting;
}

/// A choice among names.
template <auto... path>
Setting choice_setting(std::string key, std::string help,
                       std::vector<std::pair<std::string, ValueAt<path...>>> values) {
    Setting setting = new_setting(std::move(key), SettingType::choice, std::move(help));
    for (const auto& [name, value] : values) setting.choices.push_back(name);
    setting.get = [=](const RenderSettings& s) {
        const auto found = std::ranges::find(values, at<path...>(s), [](const auto& v) { return v.second; });
        return SettingValue(found == values.end() ? std::string() : found->first);
    };
    setting.set = [=](RenderSettings& s, const SettingValue& chosen) {
        for (const auto& [name, value] : values) {
            if (name == std::get<std::string>(chosen)) at<path...>(s) = value;
        }
    };
    return setting;
}

template <auto... path>
Setting boolean_setting(std::string key, std::string help) {
    Setting setting = new_setting(std::move(key), SettingType::boolean, std::move(help));
    setting.get = [=](const RenderSettings& s) { return SettingValue(at<path...>(s)); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) { at<path...>(s) = std::get<bool>(value); };
    return setting;
}

/// A set of effects, by their names.
template <auto... path>
Setting effects_setting(std::string key, std::string help) {
    Setting setting = new_setting(std::move(key), SettingType::names, std::move(help));
    for (const EffectName& effect : effect_list) setting.choices.push_back(effect.name);
    setting.get = [=](const RenderSettings& s) { return SettingValue(format_effects(at<path...>(s))); };
    setting.set = [=](RenderSettings& s, const SettingValue& value) {
        std::string unknown;
        at<path...>(s) = parse_effects(std::get<std::string>(value), unknown);
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
