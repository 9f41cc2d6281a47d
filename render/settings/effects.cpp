#include "render/settings/effects.h"

#include <algorithm>
#include <ranges>

namespace aleph {

static_assert(std::ranges::all_of(effect_list,
                                  [](const EffectName& effect) { return &effect == &describe(effect.id); }),
              "effect_list has the order of Effect");

EffectSet parse_effects(const std::string& text, std::string& unknown) {
    EffectSet effects;
    unknown.clear();
    if (text.find_first_not_of(' ') == std::string::npos) return effects;
    for (const auto part : std::views::split(text, ',')) {
        std::string name(part.begin(), part.end());
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        const auto found = std::ranges::find(effect_list, name, &EffectName::name);
        if (found == effect_list.end()) {
            unknown = name.empty() ? "between commas" : name;
            return effects;
        }
        effects.add(found->id);
    }
    return effects;
}

std::string format_effects(const EffectSet& effects) {
    std::string text;
    for (const EffectName& effect : effect_list) {
        if (effects.contains(effect.id)) text += (text.empty() ? "" : ",") + std::string(effect.name);
    }
    return text;
}

}  // namespace aleph
