#include "render/settings/setting_table.h"

#include <fmt/format.h>

#include "perception/vision/vision_model.h"
#include "render/settings/make_setting.h"

namespace aleph {

namespace {

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
        number_setting("seed", "seed of all random numbers", at(&S::seed), 0, 4294967295.0),
        // The model of vision, and how its map becomes accuracy.
        without_scene(choice_setting("guide",
                                     "what the Aleph map considers: nothing (none), contrast (spatial), contrast and "
                                     "motion (full), or also where viewers look (saliency)",
                                     at(&S::perception, &Perception::guide),
                                     {{"none", Guide::none},
                                      {"spatial", Guide::spatial},
                                      {"full", Guide::full},
                                      {"saliency", Guide::saliency}})),
        choice_setting("estimate",
                       "quick estimate for the model of vision: base colour and emission (flat), or direct light with "
                       "shadows (direct)",
                       at(&S::guide, &G::estimate), {{"flat", EstimateKind::flat}, {"direct", EstimateKind::direct}}),
        without_scene(choice_setting("motion",
                                     "source of motion: the scene, exact (model) or by rasterized maps of 8 bits "
                                     "(raster); or a comparison of two quick estimates, by optical flow (flow), a "
                                     "census search that is checked (image), or one as printed (census)",
                                     at(&S::guide, &G::motion),
                                     {{"model", MotionSource::model},
                                      {"raster", MotionSource::raster},
                                      {"flow", MotionSource::flow},
                                      {"image", MotionSource::image},
                                      {"census", MotionSource::census}})),
        without_scene(vision_setting()),
        without_scene(choice_setting(
            "bands",
            "frequencies of the contrast bands: as the thesis prints them (printed), or of these filters (measured)",
            at(&S::perception, &Perception::bands), {{"printed", Bands::printed}, {"measured", Bands::measured}})),
        without_scene(choice_setting(
            "grid",
            "resolution at which saliency compares its maps: the picture's (full), or the centre level's, faster",
            at(&S::perception, &Perception::grid), {{"full", SaliencyGrid::full}, {"center", SaliencyGrid::center}})),
        rarely_set(without_scene(boolean_setting("neutral_opponent",
                                                 "true makes grey neutral in the opponent colour channels of saliency",
                                                 at(&S::perception, &Perception::neutral_opponent)))),
        without_scene(choice_setting(
            "adapter",
            "how accuracy follows the Aleph map: thesis (6.7) (compress), (6.8) (scale-add), or not at all (none)",
            at(&S::guide, &G::adapter),
            {{"compress", Adapter::compress}, {"scale-add", Adapter::scale_add}, {"none", Adapter::none}})),
        rarely_set(without_scene(
            number_setting("adapter_k", "K of the adapter scale-add", at(&S::guide, &G::adapter_k), 1e-6, 1e12))),
        // The error that is asked for, the cache's accuracy, and how far light goes.
        number_setting("error",
                       "largest error that is asked for; sets sampling, adapter, accuracy, gather, light_step, bounces "
                       "and spp, which override it when they are given beside it; 0: none is asked for",
                       at(&S::error), 0.0, 1000.0, "just visible differences"),
        without_scene(
            number_setting("accuracy",
                           "ambient accuracy, as RADIANCE names it: the error that irradiance caching may make where "
                           "the viewer is strictest, so that smaller is more accurate; 0: rays of every sample's own",
                           at(&S::cache, &C::accuracy), 0.0, 1.0)),
        number_setting("gather",
                       "rays over the hemisphere for one irradiance value; 0: what the accuracy needs, or 2 where "
                       "every sample has its own",
                       at(&S::cache, &C::gather), 0, 1 << 20, "rays"),
        number_setting("bounces", "bounces of indirect diffuse light; the quick estimate has at most 1",
                       at(&S::light, &L::bounces), 0, 1000),
        number_setting("path_depth", "longest path of light that mirrors and glass may make",
                       at(&S::light, &L::path_depth), 1, 10000, "surfaces"),
        number_setting("spp",
                       "samples per pixel, or the most of them where `sampling` chooses; 1 is the pixel's centre",
                       at(&S::sampling, &Samples::spp), 1, 65536, "samples"),
        choice_setting(
            "sampling",
            "how many samples each pixel takes: spp (uniform), or at most spp: until two stages differ by less than "
            "the visible threshold (consecutive), until the variance is below it (variance), spp divided by the Aleph "
            "map but at least 16 (protocol), or until the error that is asked for is met (threshold)",
            at(&S::sampling, &Samples::rule),
            {{"uniform", Sampling::uniform},
             {"consecutive", Sampling::consecutive},
             {"variance", Sampling::variance},
             {"protocol", Sampling::protocol},
             {"threshold", Sampling::threshold}}),
        rarely_set(choice_setting(
            "stopping",
            "which samples tell when a pixel stops, with the sampling consecutive or variance: those of the pixels "
            "around it (neighbourhood), or its own, by their difference or deviation as the thesis prints (6.10) and "
            "(6.12), which makes rarely lit places too dark (pixel); other sampling does not read it",
            at(&S::sampling, &Samples::stopping),
            {{"neighbourhood", Stopping::neighbourhood}, {"pixel", Stopping::pixel}})),
        choice_setting("filter",
                       "how the light around a pixel's centre makes up the pixel: its square (box), or a smooth window "
                       "3 pixels wide (blackman-harris)",
                       at(&S::picture, &PictureSettings::filter),
                       {{"box", PixelFilter::box}, {"blackman-harris", PixelFilter::blackman_harris}}),
        // The method, and what it costs.
        choice_setting("integrator",
                       "method for the picture's light: an irradiance cache for indirect diffuse light (cache), or "
                       "path tracing, unbiased, with the variance of each pixel (path)",
                       at(&S::light, &L::integrator), {{"cache", Integrator::cache}, {"path", Integrator::path}}),
        number_setting("light_samples", "samples of direct light per sample of a pixel, shared out among the lights",
                       at(&S::light, &L::light_samples), 1, 65536, "samples"),
        rarely_set(number_setting("min_radius_pixels",
                                  "least radius of a cache record, which reaches accuracy times as far",
                                  at(&S::cache, &C::min_radius_pixels), 0.1, 1000.0, "pixels")),
        number_setting("light_step",
                       "frames between the lighting keyframes at which indirect light is computed for the frames "
                       "around them; 0: every frame computes its own",
                       at(&S::cache, &C::light_step), 0, 1000, "frames"),
        number_setting("subdivision_level",
                       "level of every subdivision cage, at most its own max_level; -1: as fine as the pixels need",
                       at(&S::picture, &PictureSettings::subdivision_level), -1, 10),
        // Which effects are simulated.
        choice_setting(
            "plan", "whether effects that the scene does not call for, by more than a viewer could see, are left out",
            at(&S::effects, &E::plan), {{"on", EffectsPlanning::on}, {"off", EffectsPlanning::off}}),
        effects_setting("force", "effects that are simulated whatever the plan says", at(&S::effects, &E::force)),
        effects_setting("forbid", "effects that are left out whatever that changes", at(&S::effects, &E::forbid)),
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

}  // namespace aleph
