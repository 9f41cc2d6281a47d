#pragma once
// The options of the commands that work on a scene's frames, and what they make of the scene.

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "engine/base/parallel.h"
#include "engine/json/load_limits.h"
#include "render/cli/options.h"
#include "render/sequence.h"

namespace aleph {

struct SceneOptions {
    std::string scene, frames, fps, output, camera, stats;
    SettingMap settings;  ///< from options and --set, in the order of their keys
    int threads = 0;
    LoadLimits limits;
    bool quiet = false;
};

/// Adds the scene argument and the options that `render` and `maps` share: one per setting, --set for any.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// --load-memory.
void add_load_limits(CLI::App& app, LoadLimits& limits);

/// "30", "29.97" or "30000/1001".
/// @throws InputError (--fps)
FrameRate parse_fps(const std::string& text);

/// The scene file's own numbers that --set may change beside its "settings" (exposure, viewing.*): taken out of the
/// map.
/// @throws InputError (--set)
void set_scene_numbers(Scene& scene, SettingMap& settings);

/// A scene with its settings: defaults, then the scene file's, then the command line's.
struct PreparedScene {
    Scene scene;
    RenderSettings settings;
    std::vector<int> frames;
    std::string name;  ///< for file names
};

/// Loads and checks everything before anything is computed; says the scene's warnings on standard error.
/// @throws InputError
PreparedScene prepare_scene(const SceneOptions& options);

/// Renders or maps every frame and writes it, with progress; then the statistics. What both commands do.
/// @param maps  channels of all maps beside (or, without `frame` in the request, instead of) the picture
void write_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request, bool maps,
                  const std::string& title);

/// The steps of write_frames: checks the output and makes its folder before anything is computed;
void prepare_frames_output(const PreparedScene& prepared, const SceneOptions& options, bool maps);
/// then makes every frame and writes it.
using FrameMaker = std::function<FrameOutput(int frame, const FrameRequest& request)>;
void write_made_frames(const PreparedScene& prepared, const SceneOptions& options, const FrameRequest& request,
                       bool maps, const std::string& title, double exposure, const FrameMaker& make_frame);

}  // namespace aleph
