#pragma once
// The command line of the studies.

#include <CLI/CLI.hpp>
#include <functional>
#include <optional>
#include <string>

#include "render/settings/settings.h"

namespace aleph {

struct StudyOptions {
    std::string scene{};           ///< a scene file
    std::string size = "640x480";  ///< of the frames, WIDTHxHEIGHT in pixels
    std::string picture{};         ///< .png or .jpg; empty: the study draws none
    int gather = 1024;             ///< rays per irradiance value
    int spp = 1;                   ///< 0: the study takes pixel centres and has no option for it
    int threads = 0;
    bool quiet = false;
};

/// SCENE, the one positional argument of most studies.
void add_scene_option(CLI::App& app, StudyOptions& options);
/// --size, --gather, --threads; --spp where there are samples, --output where there is a picture.
void add_study_options(CLI::App& app, StudyOptions& options);
/// -q, --quiet.
void add_quiet_option(CLI::App& app, StudyOptions& options);
/// The name of the folder for a file called scene.json, else the name of the file.
std::string scene_name(const std::string& file);

/// The numbers of a list.
/// @throws CLI::ConversionError naming the option
std::vector<double> parse_values(const std::vector<std::string>& texts, const char* option);

/// Whether there is a setting of this name in this version.
bool has_setting(const std::string& key);

/// Hexadecimal digits that tell texts apart; a number for the bytes of a file.
std::string hash_text(const std::string& text);
std::string hash_file(const std::string& file);

/// --set.
void add_set_option(CLI::App& app, std::vector<std::string>& sets);

/// --accuracy.
void add_accuracy_option(CLI::App& app, double& accuracy);

/// The settings of a scene, with those of the options in their places.
/// @param file  of the scene, for errors
/// @throws InputError for a setting that is out of range
RenderSettings study_settings(const Scene& scene, const std::string& file, const StudyOptions& options);

/// The settings of a scene for a size, WIDTHxHEIGHT, with those of "KEY=VALUE" texts in their places.
/// @param file  of the scene, for errors
/// @throws InputError for a setting that is out of range
RenderSettings scene_settings(const Scene& scene, const std::string& file, const std::string& size,
                              const std::vector<std::string>& sets);

/// With the settings of texts "KEY=VALUE", all at once: what `error` sets, the others override.
/// @throws InputError for an unknown key, or a value that is out of range
RenderSettings with_settings(RenderSettings settings, const std::vector<std::string>& texts);

/// With a setting that is a choice, by the names of the scene file.
/// @throws InputError for an unknown name
RenderSettings with_choice(RenderSettings settings, const std::string& key, const std::string& value);

struct FrameOfScene {
    std::string file;
    std::optional<std::int64_t> frame;
};

/// "scene.json@20" is frame 20 of a scene; "scene.json" leaves the frame open.
/// @throws InputError if no number follows the last @
FrameOfScene parse_frame_of_scene(const std::string& text);

/// Reads the command line and runs a study on the number of threads that the options ask for.
/// @return the exit code
int run_study(CLI::App& app, const StudyOptions& options, int argc, const char* const* argv,
              const std::function<void()>& study);

}  // namespace aleph
