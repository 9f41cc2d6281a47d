#include "render/settings/settings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "motion/flow.h"
#include "render/settings/setting_table.h"

namespace aleph {

void follow_error(RenderSettings& settings, double error) {
    // Errors of records are smooth and last: they are seen sooner than noise, so they do not grow above 1
    // (allow_noise).
    const double accuracy = 0.07 * std::min(error, 1.0);
    constexpr int most_samples = 4096, all_bounces = 16;
    settings.error = error;
    settings.sampling.rule = Sampling::threshold;
    settings.guide.adapter = Adapter::none;  // light that follows the map flickers
    settings.cache.accuracy = accuracy;
    settings.cache.gather = 128;    // more where noise would be seen (gather_at.h)
    settings.cache.light_step = 0;  // a frame alone takes its own records only; keyframes pay over shots
    settings.light.bounces = all_bounces;
    settings.sampling.spp = most_samples;
}

namespace {

/// Diffuse bounces of a reference: what is left out is at most albedo^16 of the light.
constexpr int full_light_bounces = 16;

std::vector<std::string> list_keys() {
    std::vector<std::string> keys;
    std::ranges::transform(setting_table(), std::back_inserter(keys), &Setting::key);
    return keys;
}

[[noreturn]] void refuse_unknown(const std::string& source, const std::string& key,
                                 const std::vector<std::string>& known) {
    const std::string close = close_suggestion(key, known);
    throw InputError(
        source, printable(key),
        fmt::format("there is no such setting{} known are {}", close.empty() ? ";" : close, fmt::join(known, ", ")));
}

/// Neither of the two could have its way.
void refuse_contradiction(const EffectSettings& effects, const std::string& source) {
    for (const EffectName& effect : effect_list) {
        if (!effects.force.contains(effect.id) || !effects.forbid.contains(effect.id)) continue;
        throw InputError(source, "forbid",
                         fmt::format("the effect {} is named by \"force\" too; leave it out of one", effect.name));
    }
}

bool chooses_work(const SettingMap& settings) {
    constexpr const char* keys[] = {"error", "accuracy", "gather", "spp", "sampling", "light_samples", "integrator"};
    return std::ranges::any_of(keys, [&](const char* key) { return settings.contains(key); });
}

}  // namespace

void add_default_error(const SettingMap& scene, SettingMap& given) {
    if (!chooses_work(scene) && !chooses_work(given)) given["error"] = 1.0;
}

std::vector<SettingOrigin> list_origins(const SettingMap& scene, const SettingMap& given) {
    SettingMap options = given;
    std::erase_if(options, [](const auto& option) {
        return std::ranges::find(setting_table(), option.first, &Setting::key) == setting_table().end();
    });
    const bool has_error = options.contains("error");
    add_default_error(scene, options);
    RenderSettings settings;
    std::map<std::string, std::string> from;
    for (const auto& [map, name] : {std::pair(&scene, "scene"), {&options, "option"}}) {
        const SettingMap before = setting_map(settings);
        apply_settings(settings, *map, "");
        for (const auto& [key, value] : setting_map(settings)) {
            if (map->contains(key)) {
                from[key] = key == "error" && map == &options && !has_error ? "default" : name;
            } else if (value != before.at(key)) {
                from[key] = "error";
            }
        }
    }
    std::vector<SettingOrigin> origins;
    for (const Setting& setting : setting_table()) {
        const auto found = from.find(setting.key);
        origins.push_back({setting.key, setting.get(settings), found == from.end() ? "default" : found->second});
    }
    return origins;
}

RenderSettings traced_reference_settings(const RenderSettings& settings) {
    RenderSettings out;
    out.picture = settings.picture;
    out.light.bounces = std::max(settings.light.bounces, full_light_bounces);
    out.light.path_depth = settings.light.path_depth;
    out.light.integrator = Integrator::path;
    out.guide.estimate = settings.guide.estimate;  // the automatic exposure is that of the estimate
    out.perception.guide = Guide::none;
    return out;
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
        if (found == table.end()) refuse_unknown(source, key, list_keys());
        const std::string mismatch = find_mismatch(*found, value);
        if (!mismatch.empty()) throw InputError(source, key, mismatch);
        found->set(settings, value);
    }
    if (settings.guide.motion == MotionSource::flow && !has_flow())
        throw InputError(source, "motion", "flow needs OpenCV, which this program was built without; choose image");
    refuse_contradiction(settings.effects, source);
}

void set_scene_numbers(Scene& scene, SettingMap& settings, const std::string& source) {
    std::vector<std::string> known = list_keys();
    const auto take = [&](const char* key, auto& number, double most) {
        known.push_back(key);
        const auto found = settings.find(key);
        if (found == settings.end()) return;
        const double* const given = std::get_if<double>(&found->second);
        if (given == nullptr || !(*given > 0.0 && *given <= most))
            throw InputError(source, key, fmt::format("expected a number above 0, at most {:g}", most));
        number = *given;
        settings.erase(found);
    };
    take("exposure", scene.film.exposure, 1e18);
    take("viewing.pixels_per_degree", scene.film.viewing.pixels_per_degree, 1e18);
    take("viewing.display_white", scene.film.viewing.display_white, 1e18);
    take("viewing.persistence", scene.film.viewing.persistence, 1.0);
    for (const auto& [key, value] : settings) {
        if (std::ranges::find(known, key) == known.end()) refuse_unknown(source, key, known);
    }
}

SettingMap setting_map(const RenderSettings& settings) {
    SettingMap map;
    for (const Setting& setting : setting_table()) map[setting.key] = setting.get(settings);
    return map;
}

std::string setting_text(const SettingValue& value) {
    return std::visit([](const auto& v) { return fmt::format("{}", v); }, value);
}

nlohmann::ordered_json setting_json(const SettingValue& value) {
    return std::visit([](const auto& v) { return nlohmann::ordered_json(v); }, value);
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
