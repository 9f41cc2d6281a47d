// Frames of a scene, rendered guided and unguided with the same settings: a table of rays and seconds, and a picture of
// the last frame with its maps.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/frame/sequence.h"
#include "render/output/sheet.h"
#include "render/settings/frame_list.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

struct DemoOptions {
    StudyOptions study{.picture = "demo.png"};
    std::string frames = "20";
    double accuracy = 0.1;
};

std::vector<Panel> make_panels(const FrameOutput& guided, const FrameOutput& unguided,
                               const ViewingConditions& viewing) {
    const Image<Rgb>&a = guided.shaded.color, &b = unguided.shaded.color;
    Image<float> difference(a.width, a.height);
    for (std::size_t i = 0; i < difference.size(); ++i) {
        const float change = std::abs(luminance(a.pixels[i]) - luminance(b.pixels[i]));
        difference.pixels[i] =
            static_cast<float>(viewing.display_white) * change / std::max(guided.threshold.pixels[i], 1e-6f);
    }
    return {color_panel(fmt::format("guided: {} irradiance values", guided.statistics.counts.records), a),
            color_panel(fmt::format("unguided: {} irradiance values", unguided.statistics.counts.records), b),
            map_panel("difference over what a viewer tolerates", difference, {}),
            map_panel("Aleph map (log): error that goes unseen", guided.perception.aleph, {1.0, 250.0, true}),
            records_panel("guided: where irradiance was computed", guided.shaded.records),
            records_panel("unguided: where irradiance was computed", unguided.shaded.records),
            map_panel("saliency: where one looks", guided.perception.saliency, {}),
            map_panel("image velocity, deg/s", guided.velocity, {0.0, 10.0})};
}

/// Statistics of one frame, rendered in both ways.
struct Pair {
    FrameStatistics guided, unguided;
};

/// Renders the frames in both ways and draws the picture of the last one.
std::vector<Pair> render_pairs(const Scene& scene, RenderSettings settings, const std::vector<int>& frames,
                               const StudyOptions& study) {
    settings.perception.guide = Guide::saliency;
    Sequence guided_sequence(scene, settings);
    settings.perception.guide = Guide::none;
    Sequence unguided_sequence(scene, settings);
    Progress progress("demo", static_cast<double>(2 * frames.size()), progress_look(study.quiet));
    double done = 0.0;
    const auto render = [&](Sequence& sequence, const char* guide, int frame) {
        FrameRequest request;
        request.progress = [&](double fraction, const char* stage) {
            progress.update(done + fraction, fmt::format("frame {}, {}: {}", frame, guide, stage));
        };
        FrameOutput output = sequence.render(frame, request);
        progress.update(++done);
        return output;
    };
    std::vector<Pair> pairs;
    for (const int frame : frames) {
        const FrameOutput guided = render(guided_sequence, "guided", frame);
        const FrameOutput unguided = render(unguided_sequence, "unguided", frame);
        pairs.push_back({guided.statistics, unguided.statistics});
        if (frame == frames.back()) write_sheet(study.picture, make_panels(guided, unguided, scene.viewing), 4, 480);
    }
    return pairs;
}

void print_row(const std::string& name, const FrameStatistics& s) {
    fmt::print("{:>5}  {:<9} {:>12} {:>9}", s.frame, name, s.counts.rays.gather, s.counts.records);
    for (const auto& [stage, seconds] : list_stages(s.seconds)) fmt::print(" {:>10.3f}", seconds);
    fmt::print("\n");
}

void print_table(const std::vector<Pair>& pairs) {
    fmt::print("{:>5}  {:<9} {:>12} {:>9}", "frame", "guide", "gather rays", "records");
    for (const auto& [stage, unused] : list_stages({})) fmt::print(" {:>10}", stage);
    fmt::print("\n");
    const auto ratio = [](std::uint64_t unguided, std::uint64_t guided) {
        return static_cast<double>(unguided) / static_cast<double>(std::max<std::uint64_t>(guided, 1));
    };
    for (const auto& [guided, unguided] : pairs) {
        print_row("saliency", guided);
        print_row("none", unguided);
        fmt::print("       ratio: gather rays {:.2f}, records {:.2f}, seconds {:.2f}\n",
                   ratio(unguided.counts.rays.gather, guided.counts.rays.gather),
                   ratio(unguided.counts.records, guided.counts.records),
                   unguided.seconds.total / guided.seconds.total);
    }
}

void run_demo(const DemoOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    settings.accuracy = options.accuracy;
    validate(settings);
    const std::vector<Pair> pairs = render_pairs(scene, settings, parse_frame_list(options.frames), study);
    fmt::print("\n{}, {}, accuracy {:g}, {} rays per irradiance value, samples per pixel {}; seconds by stage\n\n",
               study.scene, study.size, options.accuracy, study.gather, study.spp);
    print_table(pairs);
    fmt::print("\nThe picture: {}\n", study.picture);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{"Renders frames guided and unguided, and shows what guidance saves."};
    aleph::DemoOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    aleph::add_accuracy_option(app, options.accuracy);
    app.add_option("--frames", options.frames, "frame numbers, such as 20,60 or 0-89x10")->capture_default_str();
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_demo(options); });
}
