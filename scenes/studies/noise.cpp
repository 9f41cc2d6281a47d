// The noise map of Yee 2000, 7.1: a picture plus noise below its own visible threshold, and by which models the
// difference is visible.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/base/sampling.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/compare/yee_metric.h"
#include "render/output/sheet.h"
#include "render/settings/frame_list.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct NoiseOptions {
    StudyOptions study{.size = "320x240", .picture = "noise.png", .gather = 0, .spp = 16};
    std::string frames = "0";
    std::vector<std::string> multiples = {"1", "2", "4"};
    bool markdown = false;
};

/// A frame, and its thresholds by the thesis's model and by castleCSF on a display that holds its frames.
struct Judged {
    Image<Rgb> picture;
    Image<float> thesis, castle, flicker;
    ViewingConditions viewing;
};

Judged judge_frame(const Scene& scene, const RenderSettings& settings, std::int64_t frame) {
    Scene held = scene;
    held.viewing.persistence = 1.0;
    FrameRequest maps;
    maps.frame = false;
    maps.maps = true;
    RenderSettings thesis = settings, castle = settings;
    thesis.perception.vision = &thesis_vision();
    castle.perception.vision = &castle_vision();
    Sequence sequence(scene, thesis);
    FrameOutput of_thesis = sequence.render(frame, maps);
    FrameOutput of_castle = Sequence(held, castle).render(frame, maps);
    return {sequence.render(frame).shaded.color, std::move(of_thesis.threshold), std::move(of_castle.threshold),
            std::move(of_castle.threshold_flicker), scene.viewing};
}

/// Luminance that is added to each pixel, cd/m2: the threshold times a multiple times a random number from 0 to 1.
Image<double> make_noise(const Image<float>& threshold, double multiple, std::int64_t frame) {
    Image<double> noise(threshold.width, threshold.height);
    for (int y = 0; y < noise.height; ++y) {
        for (int x = 0; x < noise.width; ++x) {
            const RandomKey key{0, static_cast<std::uint32_t>(frame), static_cast<std::uint32_t>(y * noise.width + x),
                                0};
            noise(x, y) = multiple * threshold(x, y) * RandomStream(key).at(0);
        }
    }
    return noise;
}

double percent_beyond(const Image<double>& noise, const Image<float>& threshold) {
    std::size_t count = 0;
    for (std::size_t i = 0; i < noise.size(); ++i) count += noise.pixels[i] > threshold.pixels[i] ? 1 : 0;
    return 100.0 * static_cast<double>(count) / static_cast<double>(noise.size());
}

Image<Rgb> add_noise(const Image<Rgb>& picture, const Image<double>& noise, double white) {
    Image<Rgb> noisy = picture;
    for (std::size_t i = 0; i < noisy.size(); ++i) noisy.pixels[i] += static_cast<float>(noise.pixels[i] / white);
    return noisy;
}

void run_noise(const NoiseOptions& options) {
    const Scene scene = load_scene(options.study.scene);
    const RenderSettings settings = study_settings(scene, options.study.scene, options.study);
    const StudyTable table({"frame", "noise up to, thresholds", "beyond: thesis (%)", "castle (%)", "flicker (%)",
                            "Yee and Newman 2004 (%)"},
                           1, options.markdown);
    std::vector<Panel> panels;
    for (const int frame : parse_frame_list(options.frames)) {
        const Judged judged = judge_frame(scene, settings, frame);
        panels.push_back(color_panel(fmt::format("frame {}", frame), judged.picture));
        for (const double multiple : parse_values(options.multiples, "--multiples")) {
            const Image<double> noise = make_noise(judged.thesis, multiple, frame);
            const Image<Rgb> noisy = add_noise(judged.picture, noise, judged.viewing.display_white);
            const double yee = 100.0 *
                               static_cast<double>(count_visible_differences(noisy, judged.picture, judged.viewing)) /
                               static_cast<double>(noisy.size());
            table.add({fmt::format("{}", frame), fmt::format("{:g}", multiple),
                       fmt::format("{:.1f}", percent_beyond(noise, judged.thesis)),
                       fmt::format("{:.1f}", percent_beyond(noise, judged.castle)),
                       fmt::format("{:.1f}", percent_beyond(noise, judged.flicker)), fmt::format("{:.2f}", yee)});
            panels.push_back(color_panel(fmt::format("noise up to {:g} thresholds", multiple), noisy));
        }
    }
    write_sheet(options.study.picture, panels, 2, settings.width);
    fmt::print("\nThe picture: {}\n", options.study.picture);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Adds noise below the visible threshold of the thesis's model to finished frames, and counts the pixels in "
        "which "
        "other models see it: castleCSF on a display that holds its frames, for errors that last and for errors that "
        "are "
        "new in every frame, and the metric of Yee and Newman."};
    aleph::NoiseOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    app.add_option("--frames", options.frames, "frame numbers, such as 60,205")->capture_default_str();
    app.add_option("--multiples", options.multiples, "largest noise, in visible thresholds")
        ->delimiter(',')
        ->capture_default_str();
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_noise(options); });
}
