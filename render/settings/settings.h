#pragma once
// Settings of a render, in groups. The scene file's "settings", the command line and C++ programs fill this one struct.
// setting_table.h has the key, range and description of each: keys have the names of the fields, without the groups.

#include <cstdint>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "perception/perception_settings.h"
#include "render/settings/effects.h"

namespace aleph {

class AccuracyAdapter;
class StoppingRule;

/// Reconstruction filters: how the light around a pixel's centre makes up the pixel.
enum class PixelFilter {
    box,              ///< the pixel's square
    blackman_harris,  ///< smooth, 3 pixels wide; less aliasing than the box at edges and fine detail
};

/// The quick estimate of a frame that the model of vision takes as its input.
enum class EstimateKind {
    flat,    ///< base colour plus emission under constant white, no shadow rays
    direct,  ///< direct light with shadows, from a fixed pattern of light points: without noise
};

/// Where a frame's motion comes from.
enum class MotionSource {
    model,   ///< exact, from the scene (thesis 5.1.2)
    raster,  ///< from the scene, as rasterized maps of 8 bits tell it (5.1.2)
    flow,    ///< from the quick estimates of two frames alone: optical flow
    image,   ///< the same: census search, checked
    census,  ///< the same: census search as printed (5.1.1)
};

/// From the model of vision to the ambient accuracy of each pixel.
enum class Adapter {
    compress,   ///< (6.7)
    scale_add,  ///< (6.8)
    none,       ///< the accuracy that is set, everywhere
};

/// How a pixel's light is computed.
enum class Integrator {
    cache,  ///< indirect diffuse light from an irradiance cache, everything else by sampling
    path,   ///< path tracing: unbiased
};

/// How many samples each pixel takes (stopping_rule.h).
enum class Sampling {
    uniform,      ///< all the same
    consecutive,  ///< until two stages in a row differ by less than the threshold (6.10)
    variance,     ///< until their standard error is below it (6.12)
    protocol,     ///< as many as the Aleph map says beforehand (6.13)
    threshold,    ///< until 99 % of the pixels are about within the error that is asked for
};

/// Whose samples tell Sampling::consecutive and Sampling::variance when a pixel stops. Other rules do not read it.
enum class Stopping {
    neighbourhood,  ///< those of the pixels around it: the picture is unbiased
    pixel,          ///< its own, by their difference or deviation, as (6.10) and (6.12) are printed: it is too dark
};

/// The choice of planning a frame's effects, or not (effects_plan.h).
enum class EffectsPlanning { on, off };

/// The picture, and how finely surfaces are divided for it.
struct PictureSettings {
    int width = 640, height = 480;  ///< key "size": "640x480"
    PixelFilter filter = PixelFilter::blackman_harris;
    int subdivision_level = -1;  ///< of every subdivision cage; -1: as fine as the pixels need (cage_level.h)

    bool operator==(const PictureSettings&) const = default;
};

/// The input of the model of vision, and the way from its map to ambient accuracy.
struct GuideSettings {
    EstimateKind estimate = EstimateKind::direct;
    MotionSource motion = MotionSource::model;
    Adapter adapter = Adapter::compress;
    double adapter_k = 100.0;  ///< K of (6.8)
    /// In place of `adapter`: a program's own (guide/accuracy_map.h). Has no key.
    const AccuracyAdapter* own_adapter = nullptr;

    bool operator==(const GuideSettings&) const = default;
};

/// The irradiance cache.
struct CacheSettings {
    double accuracy = 0.15;  ///< ambient accuracy alpha_Acc: smaller is exacter; 0: every sample has rays of its own
    int gather = 0;  ///< rays over the hemisphere, of a record; 0: what the accuracy needs (choose_rays), 2 of a sample
    double min_radius_pixels = 12.0;  ///< least R of a record (irradiance_record.h), pixels
    int light_step = 10;  ///< frames between lighting keyframes of indirect light; 0: every frame computes its own

    bool operator==(const CacheSettings&) const = default;
};

/// The transport of light.
struct LightSettings {
    Integrator integrator = Integrator::cache;
    int bounces = 1;        ///< of indirect diffuse light
    int path_depth = 32;    ///< longest path: surfaces that scatter, of all kinds
    int light_samples = 4;  ///< samples of direct light, per sample of a pixel; shared out among the lights

    bool operator==(const LightSettings&) const = default;
};

/// The samples of a pixel.
struct SamplingSettings {
    Sampling rule = Sampling::uniform;  ///< key "sampling"
    int spp = 16;                       ///< samples per pixel, or the most of them; 1 is the pixel's centre
    Stopping stopping = Stopping::neighbourhood;
    /// Decides in place of a rule with stages: a program's own (guide/stopping_rule.h). Has no key.
    const StoppingRule* own_rule = nullptr;

    bool operator==(const SamplingSettings&) const = default;
};

/// The effects that are simulated.
struct EffectSettings {
    EffectsPlanning plan = EffectsPlanning::on;
    EffectSet force;   ///< simulated whatever the plan says
    EffectSet forbid;  ///< left out whatever that changes

    bool operator==(const EffectSettings&) const = default;
};

struct RenderSettings {
    std::uint32_t seed = 0;
    /// Error that is asked for, in visible thresholds; 0: none. Set by follow_error(settings, E), which also sets the
    /// samples and the accuracy that keep to it: the number alone changes neither.
    double error = 0.0;
    PictureSettings picture{};
    PerceptionSettings perception{};
    GuideSettings guide{};
    CacheSettings cache{};
    LightSettings light{};
    SamplingSettings sampling{};
    EffectSettings effects{};

    bool operator==(const RenderSettings&) const = default;
};

/// Overwrites the settings that the map has. An error above 0 first sets how accuracy and samples follow it
/// (follow_error); what else the map has overrides that.
/// @param source  where the map comes from, for messages: a file, "--set"
/// @throws InputError naming the key, if it is unknown, or its value has another type or is out of range. The settings
/// before that key, in alphabetical order, have been overwritten.
void apply_settings(RenderSettings& settings, const SettingMap& map, const std::string& source);

/// Asks for an error of 1 where neither the scene's settings nor those given choose the work.
void add_default_error(const SettingMap& scene, SettingMap& given);

/// A setting, and where its value comes from.
struct SettingOrigin {
    std::string key;
    SettingValue value;
    std::string from;  ///< "scene", "option", "error" if it follows from that, "default"
};

/// All settings in the order of the table, as `aleph render` has them.
/// @param scene  those of the scene file
/// @param given  those of the command line; keys that are no settings do not count
std::vector<SettingOrigin> list_origins(const SettingMap& scene, const SettingMap& given);

/// Settings with which a picture is made to an error in thresholds, above 0: records that leave most of the error to
/// samples, no lighting keyframes, 16 bounces, and as many samples as their noise needs to go unseen, 4,096 at most.
void follow_error(RenderSettings& settings, double error);

/// Settings of a reference that judges pictures with `settings`: traced paths without a guide, with 16 diffuse bounces
/// or, if the settings have more, those. Size, longest path, filter and levels of cages are those of the settings.
RenderSettings traced_reference_settings(const RenderSettings& settings);

/// GGX alpha that lobes have at least where a Lambert layer turned the path; 0: their own. Cached light blurs caustics
/// by it, unless the plan of effects is off or forced to simulate them.
float find_caustic_width(const RenderSettings& settings);

/// As JSON and the command line write it: true, 0.5, saliency.
std::string setting_text(const SettingValue& value);

nlohmann::ordered_json setting_json(const SettingValue& value);

/// All keys with their values, as in a scene file. apply_settings of the map gives equal settings.
SettingMap setting_map(const RenderSettings& settings);

/// Adds "KEY=VALUE" to the map. VALUE becomes a boolean (true, false) or a number (decimal point in every locale) if it
/// reads as one, and text otherwise.
/// @throws InputError if there is no '=' or no key
void parse_setting(const std::string& text, SettingMap& into);

/// Moves exposure and the viewing conditions (viewing.pixels_per_degree, ...) from the map to the scene: --set and
/// studies take them, but they are no render settings.
/// @param source  where the map comes from, for messages: "--set"
/// @throws InputError for a number that is out of range, and for keys that are unknown settings too
void set_scene_numbers(Scene& scene, SettingMap& settings, const std::string& source);

/// @throws InputError naming the first setting that is out of range
void validate(const RenderSettings& settings);

}  // namespace aleph
