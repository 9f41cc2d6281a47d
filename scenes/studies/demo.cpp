// The main job, shown: frames of a scene rendered guided and unguided at the same settings, a table of what that saved
// and what it cost, and one picture that shows why.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <iostream>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "render/cli/frame_list.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct DemoOptions {
    std::string scene, frames = "20";
    StudyOptions study{.picture = "demo.png"};
    double accuracy = 0.1;
    bool quiet = false;
};

void print_row(const std::string& name, const FrameStatistics& s) {
    fmt::print("{:>5}  {:<9} {:>12} {:>9}", s.frame, name, s.rays.gather, s.records);
    for (const auto& [stage, seconds] : list_stages(s.seconds)) fmt::print(" {:>10.3f}", seconds);
    fmt::print("\n");
}

std::vector<Panel> make_panels(const FrameOutput& guided, const FrameOutput& unguided) {
    const Image<Rgb>&a = guided.shaded.color, &b = unguided.shaded.color;
    Image<float> difference(a.width, a.height);
    for (std::size_t i = 0; i < difference.size(); ++i) {
        difference.pixels[i] = 100.0f * std::abs(luminance(a.pixels[i]) - luminance(b.pixels[i])) /
                               std::max(guided.threshold.pixels[i], 1e-6f);
    }
    return {color_panel(fmt::format("guided: {} irradiance values", guided.statistics.records), a),
            color_panel(fmt::format("unguided: {} irradiance values", unguided.statistics.records), b),
            map_panel("difference over what a viewer tolerates, 0 to 1", difference, 0.0, 1.0),
            map_panel("Aleph map, 1 to 250 (log): error that goes unseen", guided.perception.aleph, 1.0, 250.0, true),
            records_panel("guided: where irradiance was computed", guided.shaded.records),
            records_panel("unguided: where irradiance was computed", unguided.shaded.records),
            map_panel("saliency, 0 to 1: where one looks", guided.perception.saliency, 0.0, 1.0),
            map_panel("image velocity, 0 to 10 deg/s", guided.velocity, 0.0, 10.0)};
}

int run_demo(const DemoOptions& options) {
    const Scene scene = load_scene(options.scene);
    RenderSettings settings = study_settings(scene, options.scene, options.study);
    settings.accuracy = options.accuracy;
    validate(settings);
    const std::vector<int> frames = parse_frame_list(options.frames);
    const ThreadLimit limit(options.study.threads);
    settings.perception.guide = Guide::saliency;
    Sequence guided_sequence(scene, settings);
    settings.perception.guide = Guide::none;
    Sequence unguided_sequence(scene, settings);
    std::vector<FrameStatistics> guided_rows, unguided_rows;
    {
        Progress progress("demo", static_cast<double>(2 * frames.size()), progress_look(options.quiet));
        double done = 0.0;
        const auto request = [&](const char* guide, int frame) {
            FrameRequest asked;
            asked.progress = [&progress, done, guide, frame](double fraction, const char* stage) {
                progress.update(done + fraction, fmt::format("frame {}, {}: {}", frame, guide, stage));
            };
            return asked;
        };
        for (const int frame : frames) {
            const FrameOutput guided = guided_sequence.render(frame, request("guided", frame));
            progress.update(++done);
            const FrameOutput unguided = unguided_sequence.render(frame, request("unguided", frame));
            progress.update(++done);
            guided_rows.push_back(guided.statistics);
            unguided_rows.push_back(unguided.statistics);
            if (frame == frames.back()) write_sheet(options.study.picture, make_panels(guided, unguided), 4, 480);
        }
    }
    fmt::print("\n{}, {}, accuracy {:g}, {} rays per irradiance value, samples per pixel {}; seconds by stage\n\n",
               options.scene, options.study.size, options.accuracy, options.study.gather, options.study.spp);
    fmt::print("{:>5}  {:<9} {:>12} {:>9}", "frame", "guide", "gather rays", "records");
    for (const auto& [stage, unused] : list_stages({})) fmt::print(" {:>10}", stage);
    fmt::print("\n");
    for (std::size_t i = 0; i < frames.size(); ++i) {
        const FrameStatistics &g = guided_rows[i], &u = unguided_rows[i];
        print_row("saliency", g);
        print_row("none", u);
        fmt::print("       ratio: gather rays {:.2f}, records {:.2f}, seconds {:.2f}\n",
                   static_cast<double>(u.rays.gather) / static_cast<double>(std::max<std::uint64_t>(g.rays.gather, 1)),
                   static_cast<double>(u.records) / static_cast<double>(std::max<std::uint64_t>(g.records, 1)),
                   u.seconds.total / g.seconds.total);
    }
    fmt::print("\nThe picture: {}\n", options.study.picture);
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"renders frames guided and unguided, and shows what guidance saved and what it cost"};
    aleph::DemoOptions options;
    app.add_option("scene", options.scene, "a scene file")->required();
    aleph::add_study_options(app, options.study);
    app.add_option("--frames", options.frames, "frames")->capture_default_str();
    aleph::add_value(app, "--accuracy", options.accuracy, "ambient accuracy");
    app.add_flag("-q,--quiet", options.quiet, "no progress");
    return aleph::run_program(
        app, [&] { return aleph::run_demo(options); }, argc, argv, std::cerr);
}
