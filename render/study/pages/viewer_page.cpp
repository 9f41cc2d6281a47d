#include "render/study/pages/viewer_page.h"

#include <OpenImageIO/strutil.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "engine/base/errors.h"
#include "engine/base/files.h"
#include "render/compare/compare_luminance.h"
#include "render/study/pages/script_json.h"

namespace aleph {

namespace {

using Json = nlohmann::ordered_json;

/// A picture as the data of a PNG file in a link; for a moment that file stands beside it.
std::string picture_link(const std::filesystem::path& picture) {
    std::filesystem::path file = picture;
    file += ".png";
    write_png(file, linear_colour(read_image(picture)));
    const Bytes bytes = read_regular_file(file, file.string(), "");
    std::filesystem::remove(file);
    return "data:image/png;base64," +
           OIIO::Strutil::base64_encode({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

/// The first setting that is swept over numbers; null if there is none.
const StudyAxis* find_level_axis(const Study& study) {
    const auto found = std::ranges::find_if(study.sweep, [](const StudyAxis& axis) {
        return std::ranges::all_of(axis.values,
                                   [](const SettingValue& value) { return std::holds_alternative<double>(value); });
    });
    return found == study.sweep.end() ? nullptr : &*found;
}

Json level_of(const VariantResult& variant, const StudyAxis* axis) {
    if (axis == nullptr) return nullptr;
    const auto found = variant.settings.find(axis->setting);
    const double* value = found == variant.settings.end() ? nullptr : std::get_if<double>(&found->second);
    return value == nullptr ? Json(nullptr) : Json(*value);
}

Json describe_level(const StudyAxis* axis) {
    if (axis == nullptr) return nullptr;
    const bool positive =
        std::ranges::all_of(axis->values, [](const SettingValue& value) { return std::get<double>(value) > 0.0; });
    return {{"title", axis->setting == "error" ? "asked error" : axis->setting},
            {"unit", axis->setting == "error" ? "visible thresholds" : ""},
            {"log", positive}};
}

}  // namespace

std::string make_viewer_test(std::string_view page, const PreparedStudy& prepared, const StudyResults& results,
                             const StudyContext& context) {
    constexpr std::string_view place = "<!-- TEST DATA -->";
    const Scene& scene = prepared.scenes.front().scene;
    const RenderSettings settings = with_settings_of(prepared.scenes.front(), prepared.study, {}).settings;
    const std::string& name = prepared.scenes.front().name;
    const StudyAxis* axis = find_level_axis(prepared.study);
    Json json{{"schema_version", 1},
              {"title", prepared.study.title},
              {"date", context.date},
              {"width", settings.picture.width},
              {"height", settings.picture.height},
              {"frames_per_second", scene.film.frame_rate.per_second()},
              {"pixels_per_degree", scene.film.viewing.pixels_per_degree},
              {"display_white", scene.film.viewing.display_white},
              {"level", describe_level(axis)},
              {"reference", {{"frames", Json::array()}}},
              {"tests", Json::array()}};
    for (const JudgingFrame& frame : results.frames) {
        if (frame.scene == name) json["reference"]["frames"].push_back(picture_link(frame.reference));
    }
    for (const VariantResult& variant : results.variants) {
        if (std::ranges::find(variant.frames, name, &FrameResult::scene) == variant.frames.end()) continue;
        Json& test = json["tests"].emplace_back();
        test = {{"id", variant.name}, {"level", level_of(variant, axis)}, {"frames", Json::array()}};
        for (const FrameResult& frame : variant.frames) {
            if (frame.scene == name) test["frames"].push_back(picture_link(frame.picture));
        }
    }
    std::string text(page);
    const std::size_t at = text.find(place);
    ALEPH_CHECK(at != std::string::npos, std::string(place));
    return text.replace(at, place.size(),
                        "<script id=\"test\" type=\"application/json\">" + script_json(json) + "</script>");
}

}  // namespace aleph
