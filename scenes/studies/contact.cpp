// A contact sheet: one frame each of many scenes, or many frames of one, side by side with their names.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct ContactOptions {
    std::vector<std::string> scenes;
    StudyOptions study{.size = "320x240", .picture = "contact.png", .gather = 256, .spp = 4};
    int columns = 4, width = 320;
    bool quiet = false;
};

/// "scene.json@20" is frame 20, without a number the middle of the scene's range.
struct Wanted {
    std::string file;
    std::optional<std::int64_t> frame;
};

Wanted parse_wanted(const std::string& text) {
    const std::size_t at = text.rfind('@');
    if (at == std::string::npos) return {text, std::nullopt};
    std::int64_t frame = 0;
    const char* end = text.data() + text.size();
    const auto [stop, error] = std::from_chars(text.data() + at + 1, end, frame);
    if (error != std::errc() || stop != end)
        throw InputError(text, "", "expected a frame number after the last @, such as scene.json@20");
    return {text.substr(0, at), frame};
}

/// The folder's name for a file that is called scene.json, else the file's own.
std::string name_of(const std::string& file) {
    const std::filesystem::path path = std::filesystem::absolute(file);
    return path.stem() == "scene" ? path.parent_path().filename().string() : path.stem().string();
}

int run_contact(const ContactOptions& options) {
    const ThreadLimit limit(options.study.threads);
    std::vector<Panel> panels;
    Progress progress("contact", static_cast<double>(options.scenes.size()), progress_look(options.quiet));
    for (const std::string& text : options.scenes) {
        const Wanted wanted = parse_wanted(text);
        const Scene scene = load_scene(wanted.file);
        Sequence sequence(scene, study_settings(scene, wanted.file, options.study));
        const FrameRange range = sequence.range();
        const std::int64_t frame = wanted.frame.value_or(range.first + (range.last - range.first) / 2);
        std::string caption = name_of(wanted.file);
        if (wanted.frame) caption += fmt::format(", frame {}", frame);
        panels.push_back(color_panel(caption, sequence.render(frame).shaded.color));
        progress.update(static_cast<double>(panels.size()), name_of(wanted.file));
    }
    write_sheet(options.study.picture, panels, std::min(options.columns, static_cast<int>(panels.size())),
                options.width);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"renders one frame of each scene into one picture; SCENE@FRAME chooses the frame"};
    aleph::ContactOptions options;
    app.add_option("scenes", options.scenes, "scene files; the middle frame where none is chosen")->required();
    aleph::add_study_options(app, options.study);
    aleph::add_value(app, "--columns", options.columns, "pictures in a row");
    aleph::add_value(app, "--width", options.width, "pixels of each on the sheet");
    app.add_flag("-q,--quiet", options.quiet, "no progress");
    return aleph::run_program(
        app, [&] { return aleph::run_contact(options); }, argc, argv, std::cerr);
}
