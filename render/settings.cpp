#include "render/settings.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <functional>

#include "engine/base/errors.h"

namespace aleph {

namespace {

struct Entry {
    SettingKey key;
    std::function<SettingValue(const RenderSettings&)> get;
    std::function<void(RenderSettings&, const SettingValue&)> set;  ///< throws std::string: what was expected
};

double number(const SettingValue& value, double low, double high, bool whole) {
    const double* found = std::get_if<double>(&value);
    if (found == nullptr || !(*found >= low && *found <= high) || (whole && *found != std::floor(*found))) {
        throw whole ? fmt::format("expected a whole number from {:.0f} to {:.0f}", low, high)
                    : fmt::format("expected a number from {:g} to {:g}", low, high);
    }
    return *found;
}

template <class Number>
Entry number_entry(std::string name, std::string help, Number RenderSettings::*field, double low, double high) {
    return {{std::move(name), std::move(help)},
            [field](const RenderSettings& s) { return SettingValue(static_cast<double>(s.*field)); },
            [=](RenderSettings& s, const SettingValue& v) {
                s.*field = static_cast<Number>(number(v, low, high, std::is_integral_v<Number>));
            }};
}

/// A choice among names; `field` gives a reference into the settings.
template <class Enum, class Field>
Entry choice_entry(std::string name, std::string help, Field field, std::vector<std::pair<std::string, Enum>> choices) {
    const auto get = [=](const RenderSettings& s) {
        RenderSettings copy = s;  // `field` gives a reference to write through
        for (const auto& [text, value] : choices) {
            if (value == field(copy)) return SettingValue(text);
        }
        return SettingValue(std::string());
    };
    const auto set = [=](RenderSettings& s, const SettingValue& v) {
        const std::string* found = std::get_if<std::string>(&v);
        std::string names;
        for (const auto& [text, value] : choices) {
            if (found != nullptr && *found == text) {
                field(s) = value;
                return;
            }
            names += (names.empty() ? "" : ", ") + text;
        }
        throw "expected one of " + names;
    };
    return {{std::move(name), std::move(help)}, get, set};
}

/// A choice of which only one is built yet: known names of later versions are refused by name.
Entry fixed_entry(std::string name, std::string help, std::string only, std::vector<std::string> later) {
    return {{std::move(name), std::move(help)},
            [only](const RenderSettings&) { return SettingValue(only); },
            [=](RenderSettings&, const SettingValue& v) {
                const std::string* found = std::get_if<std::string>(&v);
                if (found != nullptr && *found == only) return;
                for (const std::string& name_later : later) {
                    if (found != nullptr && *found == name_later) throw "not in this version; use " + only;
                }
                throw "expected " + only;
            }};
}

void set_size(RenderSettings& s, const SettingValue& v) {
    const std::string* text = std::get_if<std::string>(&v);
    const std::string expected = "expected WIDTHxHEIGHT in pixels, each from 1 to 65536, such as 640x480";
    if (text == nullptr) throw expected;
    int size[2] = {0, 0};
    const char* at = text->data();
    const char* end = at + text->size();
    for (int k = 0; k < 2; ++k) {
        const auto [next, failure] = std::from_chars(at, end, size[k]);
        if (failure != std::errc() || size[k] < 1 || size[k] > 65536) throw expected;
        if (k == 0 ? (next == end || *next != 'x') : next != end) throw expected;
        at = next + 1;
    }
    if (std::int64_t{size[0]} * size[1] > (std::int64_t{1} << 28)) throw "more than 2^28 pixels; " + expected;
    s.width = size[0];
    s.height = size[1];
}

std::vector<Entry> make_entries() {
    using S = RenderSettings;
    std::vector<Entry> e;
    e.push_back({{"size", "WIDTHxHEIGHT in pixels"},
                 [](const S& s) { return SettingValue(fmt::format("{}x{}", s.width, s.height)); },
                 set_size});
    e.push_back(number_entry("seed", "random seed, a whole number", &S::seed, 0, 4294967295.0));
    e.push_back(choice_entry<Guide>(
        "guide", "who looks at the frame: none, spatial, full, saliency",
        [](S& s) -> Guide& { return s.perception.guide; },
        {{"none", Guide::none}, {"spatial", Guide::spatial}, {"full", Guide::full}, {"saliency", Guide::saliency}}));
    e.push_back(choice_entry<EstimateKind>("estimate", "the cheap picture the model looks at: flat, direct",
                                           [](S& s) -> EstimateKind& { return s.estimate; },
                                           {{"flat", EstimateKind::flat}, {"direct", EstimateKind::direct}}));
    e.push_back(choice_entry<MotionSource>("motion",
                                           "where motion comes from: model (the scene), image (the quick estimates)",
                                           [](S& s) -> MotionSource& { return s.motion; },
                                           {{"model", MotionSource::model}, {"image", MotionSource::image}}));
    e.push_back(choice_entry<Bands>("bands", "band frequencies: printed, measured",
                                    [](S& s) -> Bands& { return s.perception.bands; },
                                    {{"printed", Bands::printed}, {"measured", Bands::measured}}));
    e.push_back(choice_entry<SaliencyGrid>("grid", "where saliency's maps are compared: full, center (cheaper)",
                                           [](S& s) -> SaliencyGrid& { return s.perception.grid; },
                                           {{"full", SaliencyGrid::full}, {"center", SaliencyGrid::center}}));
    e.push_back({{"neutral_opponent", "true: grey is neutral in the opponent channels"},
                 [](const S& s) { return SettingValue(s.perception.neutral_opponent); },
                 [](S& s, const SettingValue& v) {
                     const bool* found = std::get_if<bool>(&v);
                     if (found == nullptr) throw std::string("expected true or false");
                     s.perception.neutral_opponent = *found;
                 }});
    e.push_back(choice_entry<Adapter>("adapter", "map to accuracy: compress (6.7), scale-add (6.8)",
                                      [](S& s) -> Adapter& { return s.adapter; },
                                      {{"compress", Adapter::compress}, {"scale-add", Adapter::scale_add}}));
    e.push_back(number_entry("adapter_k", "K of scale-add, a number above 0", &S::adapter_k, 1e-6, 1e12));
    e.push_back(number_entry("accuracy", "ambient accuracy, 0 (gather everywhere) to 1", &S::accuracy, 0.0, 1.0));
    e.push_back(number_entry("gather", "hemisphere samples per irradiance value", &S::gather, 4, 1 << 20));
    e.push_back(
        number_entry("bounces", "bounces of indirect diffuse light, 0 or 1 in this version", &S::bounces, 0, 1));
    e.push_back(number_entry("spp", "samples per pixel; 1 is the pixel's centre", &S::spp, 1, 65536));
    e.push_back(
        fixed_entry("sampling", "samples per pixel: uniform", "uniform", {"consecutive", "variance", "protocol"}));
    e.push_back(fixed_entry("integrator", "how light is gathered: cache", "cache", {"path"}));
    e.push_back(number_entry("light_samples", "direct-light samples per pixel and light", &S::light_samples, 1, 65536));
    e.push_back(number_entry("shade_radius", "shading reads records this much farther than filling, 1 to 2",
                             &S::shade_radius, 1.0, 2.0));
    e.push_back(number_entry("min_radius_pixels", "a record reaches at least this far, pixels", &S::min_radius_pixels,
                             0.1, 1000.0));
    e.push_back(number_entry("subdivision_level",
                             "of every subdivision cage, 0 to 10, at most its own max_level; -1: as pixels ask for",
                             &S::subdivision_level, -1, 10));
    return e;
}

const std::vector<Entry>& entries() {
    static const std::vector<Entry> all = make_entries();
    return all;
}

}  // namespace

const std::vector<SettingKey>& setting_keys() {
    static const std::vector<SettingKey> keys = [] {
        std::vector<SettingKey> k;
        for (const Entry& entry : entries()) k.push_back(entry.key);
        return k;
    }();
    return keys;
}

void apply_settings(RenderSettings& settings, const SettingMap& map, const std::string& source) {
    for (const auto& [key, value] : map) {
        const Entry* found = nullptr;
        for (const Entry& entry : entries()) {
            if (entry.key.name == key) found = &entry;
        }
        if (found == nullptr) {
            std::string known;
            for (const Entry& entry : entries()) known += (known.empty() ? "" : ", ") + entry.key.name;
            throw InputError(source, printable(key), "there is no such setting; known are " + known);
        }
        try {
            found->set(settings, value);
        } catch (const std::string& expected) {
            throw InputError(source, key, expected);
        }
    }
}

SettingMap setting_map(const RenderSettings& settings) {
    SettingMap map;
    for (const Entry& entry : entries()) map[entry.key.name] = entry.get(settings);
    return map;
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
    apply_settings(checked, setting_map(settings), "settings");
}

}  // namespace aleph
