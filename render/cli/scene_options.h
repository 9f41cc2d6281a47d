#pragma once
// Options of the commands that make frames of a scene, and the scene with its settings as these options ask for.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "engine/base/picture_area.h"
#include "engine/json/load_limits.h"
#include "render/cli/support/command.h"
#include "render/settings/settings.h"

namespace aleph {

class SceneWatch;

struct SceneOptions {
    std::string scene, frames, fps, output, camera, stats, crop;
    std::string film;     ///< that the files of --output become (choose_film); empty: none
    SettingMap settings;  ///< from options and --set
    int threads = 0;
    LoadLimits limits;
    bool quiet = false;
    std::string progress = "auto";
    double checkpoint = 0.0;      ///< s between two states of an unfinished frame; 0: none is kept
    double time_limit = 0.0;      ///< s until the command stops and keeps the state of its frame; 0: none
    bool resume = false;          ///< frames that are finished are kept
    bool has_resume = true;       ///< the command has --resume
    bool keeps_to_error = false;  ///< without a setting that chooses the work, an error of 1 is asked for
    bool strict = false;          ///< frames that err by more than was asked for end `render` with exit_beyond
    bool importance = false;      ///< `maps` writes this picture in place of the maps
    SceneWatch* watch = nullptr;  ///< of the files that the scene is loaded from; null: they may change
};

/// Adds --KEY for every setting of the table, --set, and --help-all, which shows settings that are rarely changed too.
/// @param settings  filled once the command line has been read
void add_setting_options(CLI::App& app, SettingMap& settings);

/// Adds the scene argument and the options of all commands that make frames: --frames, --output, --camera and others.
void add_shot_options(CLI::App& app, SceneOptions& options, const std::string& output_help);

/// Adds these, and the options that `render` and `maps` share: one per setting, --set for any.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// @throws InputError (--threads) for a number outside 0 to 4096
void check_threads(int threads);

/// The threads that --threads means: 0 is the number that Slurm has given to this task, if it has.
int find_threads(int given);

/// Adds --load-memory.
void add_load_limits(CLI::App& app, LoadLimits& limits);

/// Adds the scene file, which is required.
void add_scene_argument(CLI::App& app, std::string& scene);

/// "30", "29.97" or "30000/1001".
/// @throws InputError (--fps)
FrameRate parse_fps(const std::string& text);

/// "X0,X1,Y0,Y1": a part of a picture, without X1 and Y1.
/// @throws InputError (--crop) where it is empty or not within the picture
PictureArea parse_crop(const std::string& text, const PictureSettings& picture);

/// Behind the name of files of maps, to keep them apart from the pictures in the same folder.
inline constexpr const char* maps_suffix = "-maps";

/// Runs a check of settings of the command line. @throws its InputError, naming the option in place of the key
void check_as_options(const std::function<void()>& check);

/// Applies settings of the command line.
/// @throws InputError naming the option of a setting
void apply_given(RenderSettings& settings, const SettingMap& given);

/// The defaults, overwritten by the scene file's settings, overwritten by the command line's. Numbers of the scene
/// among these are set there.
/// @param keeps_to_error  as SceneOptions has it
/// @throws InputError
RenderSettings join_settings(Scene& scene, SettingMap given, bool keeps_to_error);

/// Prints a warning of the first frame that lies outside of the shot.
/// @param option  begins the warning
void warn_of_frames_outside(const std::vector<int>& frames, const FrameRange& range, const char* option = "");

/// The frames that --cuts names, which begin a new shot; none for empty text. Prints a warning as
/// warn_of_frames_outside, unless `quiet`.
/// @throws InputError (place "--cuts") as parse_frame_list
std::vector<std::int64_t> read_cuts(const std::string& text, const FrameRange& range, bool quiet);

/// A scene with its settings.
struct PreparedScene {
    Scene scene;
    RenderSettings settings;
    std::vector<int> frames;
    std::optional<PictureArea> window;        ///< --crop
    std::string name;                         ///< of the output files
    std::vector<std::filesystem::path> read;  ///< the scene file and all that it uses, or the pictures
};

/// Loads the scene and checks all options, before anything is computed. Prints the scene's warnings on standard error.
/// @throws InputError
PreparedScene prepare_scene(const SceneOptions& options);

}  // namespace aleph
