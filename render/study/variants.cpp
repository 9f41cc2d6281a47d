// Which variants a study has.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "render/settings/settings.h"
#include "render/study/study.h"

namespace aleph {

std::vector<SettingMap> list_combinations(const std::vector<StudyAxis>& axes) {
    constexpr std::size_t most = 10000;
    std::vector<SettingMap> all(1);
    for (const StudyAxis& axis : axes) {
        std::vector<SettingMap> longer;
        for (SettingMap& settings : all) {
            for (const SettingValue& value : axis.values) {
                if (longer.size() == most) throw InputError("", "sweep", fmt::format("more than {} variants", most));
                settings[axis.setting] = value;
                longer.push_back(settings);
            }
        }
        all = std::move(longer);
    }
    return all;
}

std::string name_settings(const SettingMap& settings, const std::vector<StudyAxis>& order) {
    std::string name;
    const auto add = [&](const std::string& key, const SettingValue& value) {
        name += fmt::format("{}{}={}", name.empty() ? "" : ",", key, setting_text(value));
    };
    std::set<std::string> done;
    for (const StudyAxis& axis : order) {
        const auto found = settings.find(axis.setting);
        if (found != settings.end() && done.insert(axis.setting).second) add(axis.setting, found->second);
    }
    for (const auto& [key, value] : settings) {
        if (!done.contains(key)) add(key, value);
    }
    return name;
}

std::vector<StudyVariant> list_variants(const Study& study) {
    std::vector<StudyVariant> variants;
    if (!study.sweep.empty()) {
        for (const SettingMap& settings : list_combinations(study.sweep))
            variants.push_back({name_settings(settings, study.sweep), settings});
    }
    std::ranges::copy(study.variants, std::back_inserter(variants));
    if (variants.empty() && !study.search) throw InputError("", "sweep", "the study has no variants");
    std::set<std::string> names;
    for (const StudyVariant& variant : variants) {
        if (!names.insert(variant.name).second)
            throw InputError("", variant.name, "two variants of the study have this name");
    }
    return variants;
}

}  // namespace aleph
