#include "scenes/studies/study_options.h"

#include <OpenImageIO/strutil.h>
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/options.h"
#include "render/settings/setting_table.h"

namespace aleph {

void add_scene_option(CLI::App& app, StudyOptions& options) {
    app.add_option("scene", options.scene, "a scene file")->required();
}

void add_study_options(CLI::App& app, StudyOptions& options) {
    app.add_option("--size", options.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    if (!options.picture.empty())
        app.add_option("-o,--output", options.picture, "file of the picture, .png or .jpg")->capture_default_str();
    add_value(app, "--gather", options.gather, "rays per irradiance value; 0: as many as the accuracy needs");
    if (options.spp > 0) add_value(app, "--spp", options.spp, "samples per pixel");
    add_value(app, "-t,--threads", options.threads, "number of threads; 0: all");
}

void add_quiet_option(CLI::App& app, StudyOptions& options) {
    app.add_flag("-q,--quiet", options.quiet, "do not show progress");
}

std::string scene_name(const std::string& file) {
    const std::filesystem::path path = std::filesystem::absolute(file);
    return path.stem() == "scene" ? path.parent_path().filename().string() : path.stem().string();
}

std::vector<double> parse_values(const std::vector<std::string>& texts, const char* option) {
    std::vector<double> values;
    for (const std::string& text : texts) values.push_back(parse_value<double>(text, option));
    return values;
}

bool has_setting(const std::string& key) {
    return std::ranges::any_of(setting_table(), [&](const Setting& setting) { return setting.key == key; });
}

std::string hash_text(const std::string& text) {
    return fmt::format("{:016x}", OIIO::Strutil::strhash(text));
}

std::string hash_file(const std::string& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return hash_text(bytes.str());
}

void add_accuracy_option(CLI::App& app, double& accuracy) {
    add_value(app, "--accuracy", accuracy, "ambient accuracy, 0 to 1; smaller is more accurate");
}

void add_set_option(CLI::App& app, std::vector<std::string>& sets) {
    app.add_option("--set", sets, "KEY=VALUE: a setting of every rendering");
}

RenderSettings scene_settings(const Scene& scene, const std::string& file, const std::string& size,
                              const std::vector<std::string>& sets) {
    RenderSettings settings;
    apply_settings(settings, scene.settings, file);
    parse_size(size, "--size", settings.width, settings.height);
    settings = with_settings(settings, sets);
    validate(settings);
    return settings;
}

RenderSettings with_settings(RenderSettings settings, const std::vector<std::string>& texts) {
    SettingMap map;
    for (const std::string& text : texts) parse_setting(text, map);
    apply_settings(settings, map, "--set");
    return settings;
}

RenderSettings study_settings(const Scene& scene, const std::string& file, const StudyOptions& options) {
    RenderSettings settings = scene_settings(scene, file, options.size, {});
    settings.gather = options.gather;
    settings.light_step = 0;  // every frame by itself, so that its counts have all of its work
    settings.spp = std::max(1, options.spp);
    return settings;
}

RenderSettings with_choice(RenderSettings settings, const std::string& key, const std::string& value) {
    apply_settings(settings, {{key, value}}, "--" + key);
    return settings;
}

FrameOfScene parse_frame_of_scene(const std::string& text) {
    const std::size_t at = text.rfind('@');
    if (at == std::string::npos) return {text, std::nullopt};
    std::int64_t frame = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + at + 1, end, frame);
    if (error != std::errc() || stop != end)
        throw InputError(text, "", "expected a frame number after the last @, such as scene.json@20");
    return {text.substr(0, at), frame};
}

int run_study(CLI::App& app, const StudyOptions& options, int argc, const char* const* argv,
              const std::function<void()>& study) {
    const auto run = [&] {
        const ThreadLimit limit(options.threads);
        study();
        return static_cast<int>(exit_done);
    };
    return run_program(app, run, argc, argv, std::cerr);
}

}  // namespace aleph
