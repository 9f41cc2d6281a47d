#pragma once
// The command line of the study programs.

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "render/settings/settings.h"

namespace aleph {

/// Options that all of them have: --size, --set, --threads, --markdown.
struct StudyOptions {
    std::string size = "320x240";  ///< of the frames, WIDTHxHEIGHT in pixels
    std::vector<std::string> sets{};
    int threads = 0;
    bool markdown = false;
};

/// The settings of a scene (`file` in errors) at the size of the options, with those of --set in their places.
/// @throws InputError for a setting that is unknown or out of range
RenderSettings scene_settings(const Scene& scene, const std::string& file, const StudyOptions& options);

/// With the settings of texts "KEY=VALUE", all at once: what `error` sets, the others override.
/// @throws InputError for an unknown key, or a value that is out of range
RenderSettings with_settings(RenderSettings settings, const std::vector<std::string>& texts);

struct FrameOfScene {
    std::string file;
    std::optional<std::int64_t> frame;
};

/// "scene.json@20" is frame 20 of a scene; "scene.json" leaves the frame open.
/// @throws InputError if no number follows the last @
FrameOfScene parse_frame_of_scene(const std::string& text);

/// Reads the command line, with these options too, and calls the program on the number of threads that they ask for.
/// @param program  returns the exit code
int run_study_program(CLI::App& app, StudyOptions& options, int argc, const char* const* argv,
                      const std::function<int()>& program);

}  // namespace aleph
