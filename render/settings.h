#pragma once
// What a user may choose about a render. The scene file's "settings", the command line and the C++ API fill this one
// struct; scene keys, `--set` keys and long options have the same names.

#include <cstdint>
#include <string>
#include <vector>

#include "engine/scene/scene.h"
#include "perception/perception_settings.h"

namespace aleph {

/// The cheap picture that the model of vision looks at.
enum class EstimateKind {
    flat,    ///< base colour plus emission under constant white, no shadow rays
    direct,  ///< direct light with shadows, from a fixed pattern of light points (no noise that would read as detail)
};

/// Where a frame's motion comes from.
enum class MotionSource {
    model,  ///< exact, from the scene (thesis 5.1.2)
    image,  ///< from the quick estimates of two frames alone, as for frames without a scene (5.1.1)
};

/// How the Aleph map becomes a per-pixel ambient accuracy.
enum class Adapter {
    compress,   ///< (6.7)
    scale_add,  ///< (6.8)
};

struct RenderSettings {
    int width = 640, height = 480;  ///< key "size": "640x480"
    std::uint32_t seed = 0;
    EstimateKind estimate = EstimateKind::direct;
    MotionSource motion = MotionSource::model;
    PerceptionSettings perception;  ///< keys guide, bands, grid, neutral_opponent
    Adapter adapter = Adapter::compress;
    double adapter_k = 100.0;        ///< K of (6.8)
    double accuracy = 0.15;          ///< ambient accuracy alpha_Acc; 0 gathers at every sample
    int gather = 1024;               ///< hemisphere samples per irradiance value
    int bounces = 1;                 ///< of indirect diffuse light; 0 or 1 in this version
    int spp = 16;                    ///< samples per pixel; 1 is the pixel's centre
    int light_samples = 16;          ///< direct-light samples per pixel and light, shared out among its spp
    double shade_radius = 1.4;       ///< shading reads records this much farther than filling does
    double min_radius_pixels = 4.0;  ///< a record reaches at least this far at its own accuracy
    int subdivision_level = -1;      ///< of every subdivision cage; -1: what pixels ask for (engine/pose/cage_level.h)

    bool operator==(const RenderSettings&) const = default;
};

/// Every key that apply_settings takes, in the order in which help shows them.
struct SettingKey {
    std::string name;
    std::string help;  ///< one line: meaning, unit, values
};
const std::vector<SettingKey>& setting_keys();

/// Overrides `settings` by what the map holds.
/// @param source  what messages call the origin: a file, "--set"
/// @throws InputError naming the key: unknown, wrong type, out of range, or not in this version
void apply_settings(RenderSettings& settings, const SettingMap& map, const std::string& source);

/// All keys with their values, as a scene file would hold them; apply_settings of it gives back equal settings.
SettingMap setting_map(const RenderSettings& settings);

/// "KEY=VALUE" to a map entry: true and false, numbers (classic locale), else text.
/// @throws InputError if there is no '=' or no key
void parse_setting(const std::string& text, SettingMap& into);

/// Checks what single keys cannot: sizes, ranges. @throws InputError
void validate(const RenderSettings& settings);

}  // namespace aleph
