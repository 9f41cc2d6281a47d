#include "render/settings/scene_numbers.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iterator>

#include "engine/base/errors.h"
#include "engine/json/close_names.h"
#include "render/settings/setting_table.h"

namespace aleph {

namespace {

/// Settings of a scene that are not in the table.
constexpr const char* scene_numbers[] = {"exposure", "viewing.pixels_per_degree", "viewing.display_white",
                                         "viewing.persistence"};

/// @throws InputError (--set)
void refuse_unknown_settings(const SettingMap& settings, const std::string& source) {
    std::vector<std::string> known;
    for (const Setting& setting : setting_table()) known.push_back(setting.key);
    known.insert(known.end(), std::begin(scene_numbers), std::end(scene_numbers));
    for (const auto& [key, value] : settings) {
        if (std::ranges::find(known, key) != known.end()) continue;
        const std::string close = close_suggestion(key, known);
        throw InputError(source, printable(key),
                         fmt::format("there is no such setting{} known are {}", close.empty() ? ";" : close,
                                     fmt::join(known, ", ")));
    }
}

}  // namespace

void set_scene_numbers(Scene& scene, SettingMap& settings, const std::string& source) {
    const auto take = [&](const std::string& key, auto&& apply) {
        const auto found = settings.find(key);
        if (found == settings.end()) return;
        const double* number = std::get_if<double>(&found->second);
        if (number == nullptr || !(*number > 0.0 && *number <= 1e18)) {
            throw InputError(source, key, "expected a number above 0");
        }
        apply(*number);
        settings.erase(found);
    };
    take("exposure", [&](double v) { scene.film.exposure = v; });
    take("viewing.pixels_per_degree", [&](double v) { scene.film.viewing.pixels_per_degree = v; });
    take("viewing.display_white", [&](double v) { scene.film.viewing.display_white = v; });
    take("viewing.persistence", [&](double v) {
        if (v > 1.0) throw InputError(source, "viewing.persistence", "expected a number above 0, at most 1");
        scene.film.viewing.persistence = v;
    });
    refuse_unknown_settings(settings, source);
}

}  // namespace aleph
