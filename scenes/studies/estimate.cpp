// What the quick estimate is worth: the thresholds that it gives against those of the finished frame, with and without
// indirect light in the estimate, and the time that each part of it takes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/base/parallel.h"
#include "engine/load/load_scene.h"
#include "perception/sanitize.h"
#include "perception/threshold.h"
#include "render/cli/options.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_tools.h"

namespace aleph {

namespace {

struct EstimateOptions {
    StudyOptions study;
    double accuracy = 0.1;
    int frame = 0, repetitions = 3;
};

/// The estimate and its maps, with the shortest time of several.
FrameOutput run_estimate(const Scene& scene, RenderSettings settings, const EstimateOptions& options, int bounces) {
    settings.bounces = bounces;
    Sequence sequence(scene, settings);
    FrameRequest request;
    request.frame = false;
    FrameOutput out;
    double seconds = 1e30;
    for (int i = 0; i < options.repetitions; ++i) {
        out = sequence.render(options.frame, request);
        seconds = std::min(seconds, out.statistics.seconds.estimate);
    }
    out.statistics.seconds.estimate = seconds;
    return out;
}

/// Thresholds of a picture that moves as `out` does.
Image<float> find_threshold(Image<Rgb> picture, const FrameOutput& out, const Scene& scene,
                            const PerceptionSettings& settings) {
    sanitize_estimate(picture);
    const PerceptionMaps maps = compute_perception(picture, out.velocity, scene.viewing, scene.frame_rate, settings);
    return compute_threshold(maps.aleph, compute_adaptation_luminance(picture, scene.viewing), settings.vision);
}

void print_row(const char* name, const FrameOutput& out, const Image<float>& reference) {
    std::vector<double> logs(reference.size());
    for (std::size_t i = 0; i < logs.size(); ++i) {
        logs[i] = std::abs(std::log2(out.threshold.pixels[i] / reference.pixels[i]));
    }
    std::sort(logs.begin(), logs.end());
    const auto beyond = std::ssize(logs) - (std::lower_bound(logs.begin(), logs.end(), 1.0) - logs.begin());
    const auto quantile = [&](double q) { return std::exp2(logs[static_cast<std::size_t>(q * (logs.size() - 1.0))]); };
    const RayCounts& rays = out.statistics.counts.rays;
    fmt::print("| {} | {:.1f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name,
               1e3 * out.statistics.seconds.estimate, 1e-6 * static_cast<double>(rays.shadow),
               1e-6 * static_cast<double>(rays.gather),
               100.0 * static_cast<double>(beyond) / static_cast<double>(logs.size()), quantile(0.5), quantile(0.9),
               quantile(0.99));
}

void run_estimates(const EstimateOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    const RenderSettings settings = study_settings(scene, study.scene, study);
    const FrameOutput direct = run_estimate(scene, settings, options, 0);
    const FrameOutput all = run_estimate(scene, settings, options, 1);
    RenderSettings careful = settings;
    careful.perception.guide = Guide::saliency;
    careful.accuracy = options.accuracy;
    const FrameOutput finished = Sequence(scene, careful).render(options.frame);
    const Image<float> reference = find_threshold(finished.shaded.color, all, scene, settings.perception);
    fmt::print("{}, frame {}, {}, finished with accuracy {}, gather {}, samples per pixel {}, {} threads\n\n",
               study.scene, options.frame, study.size, options.accuracy, study.gather, study.spp, thread_count());
    fmt::print(
        "| estimate | ms | shadow rays (M) | gather rays (M) | beyond a factor of 2 (%) | median | 90 % | 99 % |\n");
    fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    print_row("direct light", direct, reference);
    print_row("and indirect", all, reference);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares the thresholds that the quick estimate gives with those of the finished frame. Prints times, and "
        "the factors between them: the share of pixels beyond 2, median and quantiles."};
    aleph::EstimateOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_study_options(app, options.study);
    aleph::add_accuracy_option(app, options.accuracy);
    aleph::add_value(app, "--frame", options.frame, "frame number");
    aleph::add_value(app, "--repetitions", options.repetitions, "estimates, of which the quickest is printed");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_estimates(options); });
}
