// A contact sheet: one frame each of several scenes, or several frames of one scene, with captions.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/frame/sequence.h"
#include "render/output/sheet.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

struct ContactOptions {
    std::vector<std::string> scenes;
    StudyOptions study{.size = "320x240", .picture = "contact.png", .gather = 256, .spp = 4};
    std::vector<std::string> sets;
    double error = 0.0;
    int columns = 4, width = 320;
};

RenderSettings contact_settings(const Scene& scene, const std::string& file, const ContactOptions& options) {
    if (!(options.error > 0.0)) return with_settings(study_settings(scene, file, options.study), options.sets);
    std::vector<std::string> sets = {fmt::format("error={}", options.error)};
    sets.insert(sets.end(), options.sets.begin(), options.sets.end());
    return scene_settings(scene, file, options.study.size, sets);
}

Panel make_panel(const std::string& text, const ContactOptions& options) {
    const FrameOfScene wanted = parse_frame_of_scene(text);
    const Scene scene = load_scene(wanted.file);
    Sequence sequence(scene, contact_settings(scene, wanted.file, options));
    const FrameRange range = sequence.range();
    const std::int64_t frame = wanted.frame.value_or(range.first + (range.last - range.first) / 2);
    std::string caption = scene_name(wanted.file);
    if (wanted.frame) caption += fmt::format(", frame {}", frame);
    return color_panel(caption, sequence.render(frame).shaded.color);
}

void run_contact(const ContactOptions& options) {
    std::vector<Panel> panels;
    Progress progress("contact", static_cast<double>(options.scenes.size()), progress_look(options.study.quiet));
    for (const std::string& text : options.scenes) {
        panels.push_back(make_panel(text, options));
        progress.update(static_cast<double>(panels.size()), panels.back().caption);
    }
    write_sheet(options.study.picture, panels, std::min(options.columns, static_cast<int>(panels.size())),
                options.width);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"Renders one frame of each scene into one picture."};
    aleph::ContactOptions options;
    app.add_option("scenes", options.scenes, "scene files; SCENE@FRAME chooses a frame, else the middle one")
        ->required();
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_value(app, "--error", options.error,
                     "visible error that every picture asks for, in place of --gather and --spp; 0: none");
    aleph::add_set_option(app, options.sets);
    aleph::add_value(app, "--columns", options.columns, "pictures per row");
    aleph::add_value(app, "--width", options.width, "width of each picture in pixels");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_contact(options); });
}
