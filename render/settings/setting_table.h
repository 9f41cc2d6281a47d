#pragma once
// The table of render settings: the one place for their keys, ranges, units and descriptions. The options of the
// command line come from it; tests compare scenes/scene.schema.json and scenes/AUTHORING.md with it.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/settings/settings.h"

namespace aleph {

enum class SettingType { size, whole_number, number, choice, names, boolean };

/// One render setting.
struct Setting {
    std::string key;  ///< in scene files and for --set; the option's name has '-' in place of '_'
    SettingType type = SettingType::number;
    std::string help;                  ///< one line, without values and unit
    std::string unit;                  ///< of numbers; empty: none
    double min = 0.0, max = 0.0;       ///< of numbers, and of both sides of a size; inclusive
    std::vector<std::string> choices;  ///< of a choice, and the names
    bool needs_scene = true;           ///< false: `aleph maps --images` takes it as well
    bool rare = false;                 ///< true: its default suits nearly every picture, and only --help-all shows it

    std::function<SettingValue(const RenderSettings&)> get;
    std::function<void(RenderSettings&, const SettingValue&)> set;  ///< of a value without a mismatch
};

/// All settings, in the order in which help shows them.
const std::vector<Setting>& setting_table();

/// Adds a model of vision of a program's own: the setting `vision` takes its name. As add_to_vision_list.
/// @throws InputError
void add_vision(const VisionModel& model);

struct PictureSize {
    int width = 0, height = 0;  ///< pixels
};

/// "640x480": two numbers of any range.
std::optional<PictureSize> parse_picture_size(const std::string& text);

/// Why the setting cannot have this value; empty if it can.
std::string find_mismatch(const Setting& setting, const SettingValue& value);

/// Refuses what is of no use to pictures without a scene. Keys that do not exist are reported by apply_settings.
/// @throws InputError naming the key
void refuse_settings_of_scenes(const SettingMap& map);

}  // namespace aleph
