#include "scenes/studies/study_options.h"

#include <charconv>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "render/cli/support/options.h"

namespace aleph {

RenderSettings scene_settings(const Scene& scene, const std::string& file, const StudyOptions& options) {
    RenderSettings settings;
    apply_settings(settings, scene.source.settings, file);
    apply_settings(settings, {{"size", options.size}}, "");
    settings = with_settings(settings, options.sets);
    validate(settings);
    return settings;
}

RenderSettings with_settings(RenderSettings settings, const std::vector<std::string>& texts) {
    SettingMap map;
    for (const std::string& text : texts) parse_setting(text, map);
    apply_settings(settings, map, "--set");
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

int run_study_program(CLI::App& app, StudyOptions& options, int argc, const char* const* argv,
                      const std::function<int()>& program) {
    app.add_option("--size", options.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    app.add_option("--set", options.sets, "KEY=VALUE: a setting of every rendering")->allow_extra_args(false);
    add_value(app, "-t,--threads", options.threads, "number of threads; 0: all");
    app.add_flag("--markdown", options.markdown, "print tables as Markdown");
    const auto run = [&] {
        const ThreadLimit limit(options.threads);
        return program();
    };
    return run_program(app, run, argc, argv, std::cerr);
}

}  // namespace aleph
