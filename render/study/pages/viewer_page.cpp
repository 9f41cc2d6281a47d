#include "render/study/pages/pages.h"

#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/files.h"
#include "render/compare/compare_luminance.h"
#include "render/study/reference_picture.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

/// A picture as the data of a PNG file in a link; for a moment that file stands beside it.
std::string picture_link(const std::filesystem::path& picture) {
    std::filesystem::path file = picture;
    file += ".png";
    write_png(file, linear_colour(read_image(picture)));
    const std::string bytes = read_text(file);
    std::filesystem::remove(file);
    return "data:image/png;base64," + OIIO::Strutil::base64_encode(bytes);
}

/// The first setting that is swept over numbers; null if there is none.
const StudyAxis* find_level_axis(const Study& study) {
    const auto found = std::ranges::find_if(study.sweep, [](const StudyAxis& axis) {
        return std::ranges::all_of(axis.values,
                                   [](const SettingValue& value) { return std::holds_alternative<double>(value); });
    });
    return found == study.sweep.end() ? nullptr : &*found;
}

/// Levels that belong to one psychometric function: of a setting that is swept, or of noise.
struct LevelSeries {
    std::string key, title, unit;
};

std::optional<double> level_of(const VariantResult& variant, const LevelSeries& series) {
    const auto found = variant.settings.find(series.key);
    const double* value = found == variant.settings.end() ? nullptr : std::get_if<double>(&found->second);
    return value == nullptr ? std::nullopt : std::optional(*value);
}

/// Those of which there are variants.
std::vector<LevelSeries> list_series(const Study& study, const StudyResults& results) {
    std::vector<LevelSeries> series{{noise_key, "noise", "times the threshold"},
                                    {zero_mean_noise_key, "noise without brightening", "times the threshold"}};
    const StudyAxis* axis = find_level_axis(study);
    if (axis != nullptr && axis->setting == "error")
        series.push_back({"error", "asked error", "visible thresholds"});
    else if (axis != nullptr && axis->setting != noise_key && axis->setting != zero_mean_noise_key)
        series.push_back({axis->setting, axis->setting, ""});
    std::erase_if(series, [&](const LevelSeries& one) {
        return std::ranges::none_of(results.variants, [&](const auto& v) { return level_of(v, one).has_value(); });
    });
    return series;
}

Json describe_tests(const StudyResults& results, const std::string& scene, const std::vector<LevelSeries>& series) {
    Json tests = Json::array();
    for (const VariantResult& variant : results.variants) {
        if (std::ranges::find(variant.frames, scene, &FrameResult::scene) == variant.frames.end()) continue;
        Json& test = tests.emplace_back();
        test = {{"id", variant.name}, {"series", nullptr}, {"level", nullptr}, {"frames", Json::array()}};
        for (const LevelSeries& one : series) {
            const std::optional<double> level = level_of(variant, one);
            if (!level) continue;
            test["series"] = one.key;
            test["level"] = *level;
        }
        for (const FrameResult& frame : variant.frames) {
            if (frame.scene == scene) test["frames"].push_back(picture_link(frame.picture));
        }
    }
    return tests;
}

}  // namespace

std::string make_viewer_test(std::string_view page, const PreparedStudy& prepared, const StudyResults& results,
                             const StudyContext& context) {
    const RenderSettings settings = with_settings_of(prepared.scenes.front(), prepared.study, {}).settings;
    Json json{{"schema_version", 2},
              {"title", prepared.study.title},
              {"date", context.date},
              {"width", settings.picture.width},
              {"height", settings.picture.height},
              {"series", Json::array()},
              {"scenes", Json::array()}};
    const std::vector<LevelSeries> series = list_series(prepared.study, results);
    for (const LevelSeries& one : series)
        json["series"].push_back({{"id", one.key}, {"title", one.title}, {"unit", one.unit}});
    for (const PreparedStudyScene& prepared_scene : prepared.scenes) {
        const Film film = with_settings_of(prepared_scene, prepared.study, {}).scene.film;
        Json& scene = json["scenes"].emplace_back();
        scene = {{"name", prepared_scene.name},
                 {"frames_per_second", film.frame_rate.per_second()},
                 {"pixels_per_degree", film.viewing.pixels_per_degree},
                 {"display_white", film.viewing.display_white},
                 {"reference", Json::array()},
                 {"tests", describe_tests(results, prepared_scene.name, series)}};
        for (const JudgingFrame& frame : results.frames) {
            if (frame.scene == prepared_scene.name) scene["reference"].push_back(picture_link(frame.reference));
        }
    }
    std::string text(page);
    insert(text, "<!-- TEST DATA -->", script_json("test", json));
    return text;
}

}  // namespace aleph
