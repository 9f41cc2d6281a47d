#include "render/settings/setting_table.h"

#include <fmt/format.h>

#include <algorithm>

#include "perception/vision_model.h"
#include "render/settings/setting_check.h"

namespace aleph {

namespace {

Setting new_setting(std::string key, SettingType type, std::string help) {
    Setting setting;
    setting.key = std::move(key);
    setting.type = type;
    setting.help = std::move(help);
    return setting;
}

Setting with_unit(Setting setting, std::string unit) {
    setting.unit = std::move(unit);
    return setting;
}

template <class Number>
Setting number_setting(std::string key, std::string help, Number RenderSettings::*field, double min, double max) {
    constexpr bool whole = std::is_integral_v<Number>;
    Setting setting =
        new_setting(std::move(key), whole ? SettingType::whole_number : SettingType::number, std::move(help));
    setting.min = min;
    setting.max = max;
    setting.get = [field](const RenderSettings& s) { return SettingValue(static_cast<double>(s.*field)); };
    setting.set = [field](RenderSettings& s, const SettingValue& value) {
        s.*field = static_cast<Number>(std::get<double>(value));
    };
    return setting;
}

/// A choice among names.
/// @param field  gives a reference to the value in the settings
template <class Enum, class Field>
Setting choice_setting(std::string key, std::string help, Field field,
                       std::vector<std::pair<std::string, Enum>> values) {
    Setting setting = new_setting(std::move(key), SettingType::choice, std::move(help));
    for (const auto& [name, value] : values) setting.choices.push_back(name);
    setting.get = [=](RenderSettings s) {
        const auto found =
            std::find_if(values.begin(), values.end(), [&](const auto& v) { return v.second == field(s); });
        return SettingValue(found == values.end() ? std::string() : found->first);
    };
    setting.set = [=](RenderSettings& s, const SettingValue& chosen) {
        for (const auto& [name, value] : values) {
            if (name == std::get<std::string>(chosen)) field(s) = value;
        }
    };
    return setting;
}

Setting boolean_setting(std::string key, std::string help, bool PerceptionSettings::*field) {
    Setting setting = new_setting(std::move(key), SettingType::boolean, std::move(help));
    setting.get = [field](const RenderSettings& s) { return SettingValue(s.perception.*field); };
    setting.set = [field](RenderSettings& s, const SettingValue& value) {
        s.perception.*field = std::get<bool>(value);
    };
    return setting;
}

Setting size_setting() {
    Setting setting = with_unit(new_setting("size", SettingType::size, "picture size"), "pixels");
    setting.min = 1;
    setting.max = 65536;
    setting.get = [](const RenderSettings& s) { return SettingValue(fmt::format("{}x{}", s.width, s.height)); };
    setting.set = [](RenderSettings& s, const SettingValue& value) {
        const PictureSize size = parse_picture_size(std::get<std::string>(value)).value_or(PictureSize{});
        s.width = size.width;
        s.height = size.height;
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
    setting.get = [](const RenderSettings& s) {
        return SettingValue(s.perception.vision == nullptr ? std::string() : s.perception.vision->name());
    };
    setting.set = [](RenderSettings& s, const SettingValue& value) {
        s.perception.vision = find_vision(std::get<std::string>(value));
    };
    return setting;
}

Setting without_scene(Setting setting) {
    setting.needs_scene = false;
    return setting;
}

Setting rarely_set(Setting setting) {
    setting.rare = true;
    return setting;
}

/// Settings of the model of vision, and of how its map becomes accuracy.
void add_perception(std::vector<Setting>& table) {
    using S = RenderSettings;
    table.push_back(without_scene(choice_setting<Guide>(
        "guide",
        "what the Aleph map considers: nothing (none), contrast (spatial), contrast and motion (full), or also where "
        "viewers look (saliency)",
        [](S& s) -> Guide& { return s.perception.guide; },
        {{"none", Guide::none}, {"spatial", Guide::spatial}, {"full", Guide::full}, {"saliency", Guide::saliency}})));
    table.push_back(choice_setting<EstimateKind>("estimate",
                                                 "quick estimate for the model of vision: base colour and emission "
                                                 "(flat), or direct light with shadows (direct)",
                                                 [](S& s) -> EstimateKind& { return s.estimate; },
                                                 {{"flat", EstimateKind::flat}, {"direct", EstimateKind::direct}}));
    table.push_back(without_scene(choice_setting<MotionSource>(
        "motion", "source of motion: the scene, exact (model), or a comparison of two quick estimates (image)",
        [](S& s) -> MotionSource& { return s.motion; },
        {{"model", MotionSource::model}, {"image", MotionSource::image}})));
    table.push_back(without_scene(vision_setting()));
    table.push_back(without_scene(choice_setting<Bands>(
        "bands",
        "frequencies of the contrast bands: as the thesis prints them (printed), or of these filters (measured)",
        [](S& s) -> Bands& { return s.perception.bands; },
        {{"printed", Bands::printed}, {"measured", Bands::measured}})));
    table.push_back(without_scene(choice_setting<SaliencyGrid>(
        "grid", "resolution at which saliency compares its maps: the picture's (full), or the centre level's, faster",
        [](S& s) -> SaliencyGrid& { return s.perception.grid; },
        {{"full", SaliencyGrid::full}, {"center", SaliencyGrid::center}})));
    table.push_back(rarely_set(without_scene(
        boolean_setting("neutral_opponent", "true makes grey neutral in the opponent colour channels of saliency",
                        &PerceptionSettings::neutral_opponent))));
    table.push_back(without_scene(choice_setting<Adapter>(
        "adapter",
        "how accuracy follows the Aleph map: thesis (6.7) (compress), (6.8) (scale-add), or the visible threshold "
        "itself "
        "(threshold)",
        [](S& s) -> Adapter& { return s.adapter; },
        {{"compress", Adapter::compress}, {"scale-add", Adapter::scale_add}, {"threshold", Adapter::threshold}})));
    table.push_back(rarely_set(
        without_scene(number_setting("adapter_k", "K of the adapter scale-add", &S::adapter_k, 1e-6, 1e12))));
}

/// A set of effects, by their names.
Setting effects_setting(std::string key, std::string help, EffectSet RenderSettings::*field) {
    Setting setting = new_setting(std::move(key), SettingType::names, std::move(help));
    setting.choices.assign(effect_names().begin(), effect_names().end());
    setting.get = [field](const RenderSettings& s) { return SettingValue(format_effects(s.*field)); };
    setting.set = [field](RenderSettings& s, const SettingValue& value) {
        std::string unknown;
        s.*field = parse_effects(std::get<std::string>(value), unknown);
    };
    return setting;
}

/// Which effects are simulated.
void add_effects(std::vector<Setting>& table) {
    using S = RenderSettings;
    table.push_back(choice_setting<EffectsPlanning>(
        "plan", "whether effects that the scene does not call for, by more than a viewer could see, are left out",
        [](S& s) -> EffectsPlanning& { return s.plan; }, {{"on", EffectsPlanning::on}, {"off", EffectsPlanning::off}}));
    table.push_back(effects_setting("force", "effects that are simulated whatever the plan says", &S::force));
    table.push_back(effects_setting("forbid", "effects that are left out whatever that changes", &S::forbid));
}

/// Settings of the light transport.
void add_light(std::vector<Setting>& table) {
    using S = RenderSettings;
    table.push_back(with_unit(
        number_setting(
            "error",
            "largest error that is asked for; sets sampling, adapter, accuracy, gather and spp, which override it when "
            "they are given beside it; 0: none is asked for",
            &S::error, 0.0, 1000.0),
        "visible thresholds"));
    table.push_back(without_scene(number_setting(
        "accuracy",
        "ambient accuracy, as RADIANCE names it: the error that irradiance caching may make where the viewer is "
        "strictest, so that smaller is more accurate; 0 gathers at every sample",
        &S::accuracy, 0.0, 1.0)));
    table.push_back(with_unit(
        number_setting("gather", "rays over the hemisphere for one irradiance value; 0: what the accuracy needs",
                       &S::gather, 0, 1 << 20),
        "rays"));
    table.push_back(number_setting("bounces", "bounces of indirect diffuse light; the quick estimate has at most 1",
                                   &S::bounces, 0, 1000));
    table.push_back(with_unit(
        number_setting("path_depth", "longest path of light that mirrors and glass may make", &S::path_depth, 1, 10000),
        "surfaces"));
    table.push_back(with_unit(
        number_setting("spp",
                       "samples per pixel, or the most of them where `sampling` chooses; 1 is the pixel's centre",
                       &S::spp, 1, 65536),
        "samples"));
    table.push_back(choice_setting<Sampling>(
        "sampling",
        "how many samples each pixel takes: spp (uniform), or at most spp: until two stages differ by less than the "
        "visible threshold (consecutive), until the variance is below it (variance), spp divided by the Aleph map but "
        "at "
        "least 16 (protocol), or until the error that is asked for is met (threshold)",
        [](S& s) -> Sampling& { return s.sampling; },
        {{"uniform", Sampling::uniform},
         {"consecutive", Sampling::consecutive},
         {"variance", Sampling::variance},
         {"protocol", Sampling::protocol},
         {"threshold", Sampling::threshold}}));
    table.push_back(rarely_set(choice_setting<VarianceTest>(
        "variance_test",
        "what the sampling variance compares with the threshold: the error of the mean (standard-error), or the "
        "deviation "
        "of the samples, as the thesis prints it, which more samples do not lower (deviation)",
        [](S& s) -> VarianceTest& { return s.variance_test; },
        {{"standard-error", VarianceTest::standard_error}, {"deviation", VarianceTest::deviation}})));
    table.push_back(
        choice_setting<PixelFilter>("filter",
                                    "how the light around a pixel's centre makes up the pixel: its square (box), or a "
                                    "smooth window 3 pixels wide (blackman-harris)",
                                    [](S& s) -> PixelFilter& { return s.filter; },
                                    {{"box", PixelFilter::box}, {"blackman-harris", PixelFilter::blackman_harris}}));
    table.push_back(choice_setting<Integrator>(
        "integrator",
        "method for the picture's light: an irradiance cache for indirect diffuse light (cache), or path tracing, "
        "unbiased, with the variance of each pixel (path)",
        [](S& s) -> Integrator& { return s.integrator; }, {{"cache", Integrator::cache}, {"path", Integrator::path}}));
    table.push_back(with_unit(
        number_setting("light_samples", "samples of direct light per pixel and light, shared out among the pixel's spp",
                       &S::light_samples, 1, 65536),
        "samples"));
    table.push_back(rarely_set(with_unit(
        number_setting("min_radius_pixels", "least radius of a cache record, which reaches accuracy times as far",
                       &S::min_radius_pixels, 0.1, 1000.0),
        "pixels")));
    table.push_back(with_unit(
        number_setting("light_step",
                       "frames between the key moments at which indirect light is computed for the frames around them; "
                       "0: every frame computes its own",
                       &S::light_step, 0, 1000),
        "frames"));
    table.push_back(
        number_setting("subdivision_level",
                       "level of every subdivision cage, at most its own max_level; -1: as fine as the pixels need",
                       &S::subdivision_level, -1, 10));
}

std::vector<Setting> make_table() {
    std::vector<Setting> table{
        size_setting(), number_setting("seed", "seed of all random numbers", &RenderSettings::seed, 0, 4294967295.0)};
    add_perception(table);
    add_light(table);
    add_effects(table);
    return table;
}

}  // namespace

const std::vector<Setting>& setting_table() {
    static const std::vector<Setting> table = make_table();
    return table;
}

}  // namespace aleph
