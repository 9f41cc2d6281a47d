// Which variants a study has.

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "engine/base/errors.h"
#include "render/settings/settings.h"
#include "render/study/study.h"

namespace aleph {

namespace {

constexpr std::size_t most_variants = 10000;

/// Adds every combination of values of the axes from `axis` on.
void expand(const Study& study, std::size_t axis, SettingMap& settings, std::vector<StudyVariant>& out) {
    if (axis == study.sweep.size()) {
        if (out.size() == most_variants)
            throw InputError("", "sweep", fmt::format("more than {} variants", most_variants));
        out.push_back({name_settings(settings, study.sweep), settings});
        return;
    }
    for (const SettingValue& value : study.sweep[axis].values) {
        settings[study.sweep[axis].setting] = value;
        expand(study, axis + 1, settings, out);
    }
}

}  // namespace

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
    SettingMap settings;
    if (!study.sweep.empty()) expand(study, 0, settings, variants);
    for (const StudyVariant& variant : study.variants) variants.push_back(variant);
    if (variants.empty() && !study.search) throw InputError("", "sweep", "the study has no variants");
    std::set<std::string> names;
    for (const StudyVariant& variant : variants) {
        if (!names.insert(variant.name).second)
            throw InputError("", variant.name, "two variants of the study have this name");
    }
    return variants;
}

}  // namespace aleph
