#include "render/settings/setting_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>

#include "engine/base/errors.h"
#include "perception/vision/vision_model.h"
#include "render/settings/make_setting.h"

namespace aleph {

namespace {

constexpr std::int64_t max_pixels = std::int64_t{1} << 28;

/// The allowed values in words: "a number from 0 to 1", "one of flat, direct".
std::string describe_values(const Setting& setting) {
    switch (setting.type) {
        case SettingType::size:
            return fmt::format("WIDTHxHEIGHT in {}, each from {:.0f} to {:.0f}, such as 640x480", setting.unit,
                               setting.min, setting.max);
        case SettingType::whole_number:
            return fmt::format("a whole number from {:.0f} to {:.0f}", setting.min, setting.max);
        case SettingType::number:
            return fmt::format("a number from {:g} to {:g}", setting.min, setting.max);
        case SettingType::choice:
            return fmt::format("{}{}", setting.choices.size() > 1 ? "one of " : "", fmt::join(setting.choices, ", "));
        case SettingType::names:
            return fmt::format("names separated by commas, of {}", fmt::join(setting.choices, ", "));
        case SettingType::boolean:
            return "true or false";
    }
    return {};
}

using S = RenderSettings;

Setting size_setting() {
    Setting setting = new_setting("size", SettingType::size, "picture size");
    setting.unit = "pixels";
    setting.min = 1;
    setting.max = 65536;
    setting.get = [](const S& s) { return SettingValue(fmt::format("{}x{}", s.picture.width, s.picture.height)); };
    setting.set = [](S& s, const SettingValue& value) {
        const PictureSize size = parse_picture_size(std::get<std::string>(value)).value_or(PictureSize{});
        s.picture.width = size.width;
        s.picture.height = size.height;
    };
    return setting;
}

/// The choice of a model of vision. A program's own model has a name of its own.
Setting vision_setting() {
    Setting setting = new_setting("vision", SettingType::choice, "contrast sensitivity");
    for (const VisionModel* const model : vision_list()) {
        setting.help += fmt::format("{} {} ({})", setting.choices.empty() ? ":" : ",", model->summary(), model->name());
        setting.choices.push_back(model->name());
    }
    setting.get = [](const S& s) {
        return SettingValue(s.perception.vision == nullptr ? std::string() : s.perception.vision->name());
    };
    setting.set = [](S& s, const SettingValue& value) {
        s.perception.vision = find_vision(std::get<std::string>(value));
    };
    return setting;
}

/// All settings; add_vision changes one.
std::vector<Setting>& all_settings() {
    using Perception = PerceptionSettings;
    using G = GuideSettings;
    using C = CacheSettings;
    using L = LightSettings;
    using Samples = SamplingSettings;
    using E = EffectSettings;
    static std::vector<Setting> table{
        size_setting(),
        number_setting<&S::seed>("seed", "seed of all random numbers", 0, 4294967295.0),
        // The model of vision, and how its map becomes accuracy.
        without_scene(choice_setting<&S::perception, &Perception::guide>(
            "guide",
            "what the Aleph map considers: nothing (none), contrast (spatial), contrast and motion (full), or also "
            "where viewers look (saliency)",
            {{"none", Guide::none},
             {"spatial", Guide::spatial},
             {"full", Guide::full},
             {"saliency", Guide::saliency}})),
        choice_setting<&S::guide, &G::estimate>("estimate",
                                                "quick estimate for the model of vision: base colour and emission "
                                                "(flat), or direct light with shadows (direct)",
                                                {{"flat", EstimateKind::flat}, {"direct", EstimateKind::direct}}),
        without_scene(choice_setting<&S::guide, &G::motion>(
            "motion",
            "source of motion: the scene, exact (model) or by rasterized maps of 8 bits (raster); or a comparison of "
            "two quick estimates, by optical flow (flow), a census search that is checked (image), or one as printed "
            "(census)",
            {{"model", MotionSource::model},
             {"raster", MotionSource::raster},
             {"flow", MotionSource::flow},
             {"image", MotionSource::image},
             {"census", MotionSource::census}})),
        without_scene(vision_setting()),
        without_scene(choice_setting<&S::perception, &Perception::bands>(
            "bands",
            "frequencies of the contrast bands: as the thesis prints them (printed), or of these filters (measured)",
            {{"printed", Bands::printed}, {"measured", Bands::measured}})),
        without_scene(choice_setting<&S::perception, &Perception::grid>(
            "grid",
            "resolution at which saliency compares its maps: the picture's (full), or the centre level's, faster",
            {{"full", SaliencyGrid::full}, {"center", SaliencyGrid::center}})),
        rarely_set(without_scene(boolean_setting<&S::perception, &Perception::neutral_opponent>(
            "neutral_opponent", "true makes grey neutral in the opponent colour channels of saliency"))),
        without_scene(choice_setting<&S::guide, &G::adapter>(
            "adapter",
            "how accuracy follows the Aleph map: thesis (6.7) (compress), (6.8) (scale-add), or not at all (none)",
            {{"compress", Adapter::compress}, {"scale-add", Adapter::scale_add}, {"none", Adapter::none}})),
        rarely_set(without_scene(
            number_setting<&S::guide, &G::adapter_k>("adapter_k", "K of the adapter scale-add", 1e-6, 1e12))),
        // The error that is asked for, the cache's accuracy, and how far light goes.
        number_setting<&S::error>(
            "error",
            "largest error that is asked for; sets sampling, adapter, accuracy, gather, light_step, bounces and spp, "
            "which override it when they are given beside it; 0: none is asked for",
            0.0, 1000.0, "just visible differences"),
        without_scene(number_setting<&S::cache, &C::accuracy>(
            "accuracy",
            "ambient accuracy, as RADIANCE names it: the error that irradiance caching may make where the viewer is "
            "strictest, so that smaller is more accurate; 0: rays of every sample's own",
            0.0, 1.0)),
        number_setting<&S::cache, &C::gather>("gather",
                                              "rays over the hemisphere for one irradiance value, up to 8 % "
                                              "fewer where they do not fill rows and columns; 0: what the "
                                              "accuracy needs, or 2 where every sample has its own",
                                              0, 1 << 20, "rays"),
        number_setting<&S::light, &L::bounces>(
            "bounces", "bounces of indirect diffuse light; the quick estimate has at most 1", 0, 1000),
        number_setting<&S::light, &L::path_depth>("path_depth", "longest path of light that mirrors and glass may make",
                                                  1, 10000, "surfaces"),
        number_setting<&S::sampling, &Samples::spp>(
            "spp", "samples per pixel, or the most of them where `sampling` chooses; 1 is the pixel's centre", 1, 65536,
            "samples"),
        choice_setting<&S::sampling, &Samples::rule>(
            "sampling",
            "how many samples each pixel takes: spp (uniform), or at most spp: until two stages differ by less than "
            "the visible threshold (consecutive), until the variance is below it (variance), spp divided by the Aleph "
            "map but at least 16 (protocol), or until the error that is asked for is met (threshold)",
            {{"uniform", Sampling::uniform},
             {"consecutive", Sampling::consecutive},
             {"variance", Sampling::variance},
             {"protocol", Sampling::protocol},
             {"threshold", Sampling::threshold}}),
        rarely_set(choice_setting<&S::sampling, &Samples::stopping>(
            "stopping",
            "which samples tell when a pixel stops, with the sampling consecutive or variance: those of the pixels "
            "around it (neighbourhood), or its own, by their difference or deviation as the thesis prints (6.10) and "
            "(6.12), which makes rarely lit places too dark (pixel); other sampling does not read it",
            {{"neighbourhood", Stopping::neighbourhood}, {"pixel", Stopping::pixel}})),
        choice_setting<&S::picture, &PictureSettings::filter>(
            "filter",
            "how the light around a pixel's centre makes up the pixel: its square (box), or a smooth window 3 pixels "
            "wide (blackman-harris)",
            {{"box", PixelFilter::box}, {"blackman-harris", PixelFilter::blackman_harris}}),
        // The method, and what it costs.
        choice_setting<&S::light, &L::integrator>(
            "integrator",
            "method for the picture's light: an irradiance cache for indirect diffuse light (cache), or path tracing, "
            "unbiased, with the variance of each pixel (path)",
            {{"cache", Integrator::cache}, {"path", Integrator::path}}),
        number_setting<&S::light, &L::light_samples>(
            "light_samples", "samples of direct light per sample of a pixel, shared out among the lights", 1, 65536,
            "samples"),
        rarely_set(number_setting<&S::cache, &C::min_radius_pixels>(
            "min_radius_pixels", "least radius of a cache record, which reaches accuracy times as far", 0.1, 1000.0,
            "pixels")),
        number_setting<&S::cache, &C::light_step>(
            "light_step",
            "frames between the lighting keyframes at which indirect light is computed for the frames around them; 0: "
            "every frame computes its own",
            0, 1000, "frames"),
        number_setting<&S::picture, &PictureSettings::subdivision_level>(
            "subdivision_level",
            "level of every subdivision cage, at most its own max_level; -1: as fine as the pixels need", -1, 10),
        // Which effects are simulated.
        choice_setting<&S::effects, &E::plan>(
            "plan", "whether effects that the scene does not call for, by more than a viewer could see, are left out",
            {{"on", EffectsPlanning::on}, {"off", EffectsPlanning::off}}),
        effects_setting<&S::effects, &E::force>("force", "effects that are simulated whatever the plan says"),
        effects_setting<&S::effects, &E::forbid>("forbid", "effects that are left out whatever that changes"),
    };
    return table;
}

}  // namespace

const std::vector<Setting>& setting_table() {
    return all_settings();
}

void add_vision(const VisionModel& model) {
    add_to_vision_list(model);
    *std::ranges::find(all_settings(), "vision", &Setting::key) = without_scene(vision_setting());
}

std::optional<PictureSize> parse_picture_size(const std::string& text) {
    PictureSize size;
    const char* const end = text.data() + text.size();
    const auto [x, failure] = std::from_chars(text.data(), end, size.width);
    if (failure != std::errc() || x == end || *x != 'x') return std::nullopt;
    const auto [rest, failure_2] = std::from_chars(x + 1, end, size.height);
    if (failure_2 != std::errc() || rest != end) return std::nullopt;
    return size;
}

std::string find_mismatch(const Setting& setting, const SettingValue& value) {
    const double* const number = std::get_if<double>(&value);
    const std::string* const text = std::get_if<std::string>(&value);
    const auto in_range = [&](double v) { return v >= setting.min && v <= setting.max; };  // false for NaN
    switch (setting.type) {
        case SettingType::size: {
            const auto size = text != nullptr ? parse_picture_size(*text) : std::nullopt;
            if (!size || !in_range(size->width) || !in_range(size->height)) break;
            if (std::int64_t{size->width} * size->height <= max_pixels) return {};
            return "more than 2^28 pixels; expected " + describe_values(setting);
        }
        case SettingType::whole_number:
            if (number != nullptr && in_range(*number) && *number == std::floor(*number)) return {};
            break;
        case SettingType::number:
            if (number != nullptr && in_range(*number)) return {};
            break;
        case SettingType::choice:
            if (text != nullptr && std::ranges::find(setting.choices, *text) != setting.choices.end()) return {};
            break;
        case SettingType::names: {
            if (text == nullptr) break;
            std::string unknown;
            parse_effects(*text, unknown);
            if (unknown.empty()) return {};
            return fmt::format("there is no effect {}; known are {}", printable(unknown),
                               fmt::join(setting.choices, ", "));
        }
        case SettingType::boolean:
            if (std::holds_alternative<bool>(value)) return {};
            break;
    }
    const std::string found = text != nullptr ? fmt::format("\"{}\"", printable(*text)) : setting_text(value);
    return fmt::format("expected {}; found {}", describe_values(setting), found);
}

void refuse_settings_of_scenes(const SettingMap& map) {
    for (const auto& [key, value] : map) {
        const auto found = std::ranges::find(setting_table(), key, &Setting::key);
        if (found != setting_table().end() && found->needs_scene)
            throw InputError("", key, "this setting needs a scene");
        const auto* text = std::get_if<std::string>(&value);
        if (key == "motion" && text != nullptr && (*text == "model" || *text == "raster"))
            throw InputError("", key, fmt::format("\"{}\" needs a scene; choose flow, image or census", *text));
    }
}

}  // namespace aleph
