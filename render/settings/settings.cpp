#include "render/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/errors.h"
#include "motion/flow.h"
#include "render/settings/setting_table.h"

namespace aleph {

void follow_error(RenderSettings& settings, double error) {
    // Errors of records are smooth and last: they are seen sooner than noise, so they grow less above 1 (allow_noise).
    const double accuracy = 0.05 * std::min(error, std::sqrt(std::sqrt(error)));
    constexpr int most_samples = 4096, all_bounces = 16;
    settings.error = error;
    settings.sampling.rule = Sampling::threshold;
    settings.guide.adapter = Adapter::none;  // light that follows the map flickers
    settings.cache.accuracy = std::min(1.0, accuracy);
    settings.cache.gather = 512;
    settings.cache.light_step = 0;  // the records that pay (record_worth.h) cost less than keyframes
    settings.light.bounces = all_bounces;
    settings.sampling.spp = most_samples;
}

namespace {

/// Neither of the two could have its way.
void refuse_contradiction(const EffectSettings& effects, const std::string& source) {
    for (const EffectName& effect : effect_list) {
        if (!effects.force.contains(effect.id) || !effects.forbid.contains(effect.id)) continue;
        throw InputError(source, "forbid",
                         fmt::format("the effect {} is named by \"force\" too; leave it out of one", effect.name));
    }
}

/// Returns whether settings say how much work a picture takes.
bool chooses_work(const SettingMap& settings) {
    constexpr const char* keys[] = {"error", "accuracy", "gather", "spp", "sampling", "light_samples", "integrator"};
    return std::ranges::any_of(keys, [&](const char* key) { return settings.contains(key); });
}

}  // namespace

void add_default_error(const SettingMap& scene, SettingMap& given) {
    if (!chooses_work(scene) && !chooses_work(given)) given["error"] = 1.0;
}

float find_caustic_width(const RenderSettings& settings) {
    const EffectSettings& effects = settings.effects;
    const bool exact = effects.plan == EffectsPlanning::off || effects.force.contains(Effect::caustics);
    // Measured with mirror balls under a lamp: .1 leaves faint spots, .25 takes 1 to 2 % of the light.
    return exact || settings.light.integrator == Integrator::path ? 0.0f : 0.15f;
}

void apply_settings(RenderSettings& settings, const SettingMap& map, const std::string& source) {
    const std::vector<Setting>& table = setting_table();
    // Refused below, if it is not a number in range.
    if (const auto error = map.find("error"); error != map.end()) {
        const double* const value = std::get_if<double>(&error->second);
        if (value != nullptr && *value > 0.0) follow_error(settings, *value);
    }
    for (const auto& [key, value] : map) {
        const auto found = std::ranges::find(table, key, &Setting::key);
        if (found == table.end()) {
            std::vector<std::string> known;
            for (const Setting& setting : table) known.push_back(setting.key);
            throw InputError(source, printable(key),
                             fmt::format("there is no such setting; known are {}", fmt::join(known, ", ")));
        }
        const std::string mismatch = find_mismatch(*found, value);
        if (!mismatch.empty()) throw InputError(source, key, mismatch);
        found->set(settings, value);
    }
    if (settings.guide.motion == MotionSource::flow && !has_flow())
        throw InputError(source, "motion", "flow needs OpenCV, which this program was built without; choose image");
    refuse_contradiction(settings.effects, source);
}

SettingMap setting_map(const RenderSettings& settings) {
    SettingMap map;
    for (const Setting& setting : setting_table()) map[setting.key] = setting.get(settings);
    return map;
}

std::string setting_text(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

void parse_setting(const std::string& text, SettingMap& into) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos || equals == 0) {
        throw InputError("--set", printable(text), "expected KEY=VALUE");
    }
    const std::string key = text.substr(0, equals), value = text.substr(equals + 1);
    double parsed = 0.0;
    const auto [end, failure] = std::from_chars(value.data(), value.data() + value.size(), parsed);
    if (value == "true" || value == "false") {
        into[key] = value == "true";
    } else if (failure == std::errc() && end == value.data() + value.size()) {
        into[key] = parsed;
    } else {
        into[key] = value;
    }
}

void validate(const RenderSettings& settings) {
    RenderSettings checked;
    SettingMap map = setting_map(settings);
    if (settings.perception.vision != nullptr) map.erase("vision");  // may be a program's own, which has no key
    apply_settings(checked, map, "settings");
}

}  // namespace aleph
