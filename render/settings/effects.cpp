#include "render/settings/effects.h"

#include <algorithm>

namespace aleph {

const std::array<std::string, effect_count>& effect_names() {
    static const std::array<std::string, effect_count> names{
        "direct_light", "area_shadows",    "indirect_diffuse", "more_bounces", "glossy_reflection", "mirror_reflection",
        "refraction",   "caustics",        "environment",      "emission",     "textures",          "normal_maps",
        "alpha",        "motion_blur",     "depth_of_field",   "subdivision",  "deformation",       "motion",
        "saliency",     "cache_carry_over"};
    return names;
}

EffectSet parse_effects(const std::string& text, std::string& unknown) {
    EffectSet effects;
    unknown.clear();
    if (text.find_first_not_of(' ') == std::string::npos) return effects;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find(',', begin), text.size());
        std::string name = text.substr(begin, end - begin);
        begin = end + 1;
        name.erase(0, name.find_first_not_of(' '));
        name.erase(name.find_last_not_of(' ') + 1);
        const auto found = std::ranges::find(effect_names(), name);
        if (found == effect_names().end()) {
            unknown = name.empty() ? "between commas" : name;
            return effects;
        }
        effects.add(static_cast<Effect>(found - effect_names().begin()));
    }
    return effects;
}

std::string format_effects(const EffectSet& effects) {
    std::string text;
    for (std::size_t i = 0; i < effect_count; ++i) {
        if (!effects.contains(static_cast<Effect>(i))) continue;
        text += (text.empty() ? "" : ",") + effect_names()[i];
    }
    return text;
}

}  // namespace aleph
