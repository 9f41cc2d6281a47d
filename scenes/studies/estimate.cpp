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
#include "render/frame/sequence.h"
#include "scenes/studies/study_options.h"

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
    return compute_threshold(maps.aleph, compute_adaptation_luminance(picture, scene.viewing), *settings.vision);
}

/// Largest factor between two thresholds at the pixels, sorted.
std::vector<double> sort_factors(const Image<float>& a, const Image<float>& b) {
    std::vector<double> factors(a.size());
    for (std::size_t i = 0; i < factors.size(); ++i) {
        factors[i] = std::exp2(std::abs(std::log2(static_cast<double>(a.pixels[i]) / b.pixels[i])));
    }
    std::sort(factors.begin(), factors.end());
    return factors;
}

void print_row(const char* name, const FrameOutput& out, const Image<float>& reference) {
    const std::vector<double> factors = sort_factors(out.threshold, reference);
    const double count = static_cast<double>(factors.size());
    const auto within = std::lower_bound(factors.begin(), factors.end(), 2.0) - factors.begin();
    const auto quantile = [&](double q) { return factors[static_cast<std::size_t>(q * (count - 1.0))]; };
    const RayCounts& rays = out.statistics.counts.rays;
    fmt::print("| {} | {:.1f} | {:.3f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", name,
               1e3 * out.statistics.seconds.estimate, 1e-6 * static_cast<double>(rays.shadow),
               1e-6 * static_cast<double>(rays.gather), 100.0 * (1.0 - static_cast<double>(within) / count),
               quantile(0.5), quantile(0.9), quantile(0.99));
}

/// The light of one bounce in the finished frame, with the direct light of the estimate.
Image<Rgb> replace_direct_light(const Image<Rgb>& finished, const Image<Rgb>& finished_direct,
                                const Image<Rgb>& estimate) {
    Image<Rgb> out = finished;
    for (std::size_t i = 0; i < out.size(); ++i) {
        out.pixels[i] = estimate.pixels[i] + glm::max(out.pixels[i] - finished_direct.pixels[i], Rgb(0.0f));
    }
    return out;
}

void print_table(const char* reference_name, const Image<float>& reference, const FrameOutput& direct,
                 const FrameOutput& all) {
    fmt::print("\nAgainst {}:\n\n", reference_name);
    fmt::print(
        "| estimate | ms | shadow rays (M) | gather rays (M) | beyond a factor of 2 (%) | median | 90 % | 99 % |\n");
    fmt::print("| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
    print_row("direct light", direct, reference);
    print_row("and indirect", all, reference);
}

void run_estimates(const EstimateOptions& options) {
    const StudyOptions& study = options.study;
    const Scene scene = load_scene(study.scene);
    RenderSettings settings = study_settings(scene, study.scene, study);
    const FrameOutput direct = run_estimate(scene, settings, options, 0);
    const FrameOutput all = run_estimate(scene, settings, options, 1);
    settings.perception.guide = Guide::none;
    settings.accuracy = options.accuracy;
    const auto finish = [&](int bounces) {
        settings.bounces = bounces;
        return Sequence(scene, settings).render(options.frame).shaded.color;
    };
    const Image<Rgb> finished = finish(1);
    fmt::print("{}, frame {}, {}, finished with accuracy {}, gather {}, samples per pixel {}, {} threads\n",
               study.scene, options.frame, study.size, options.accuracy, study.gather, study.spp, thread_count());
    const auto threshold = [&](Image<Rgb> picture) {
        return find_threshold(std::move(picture), all, scene, settings.perception);
    };
    print_table("the finished frame", threshold(finished), direct, all);
    print_table("its indirect light with the estimate's direct light",
                threshold(replace_direct_light(finished, finish(0), direct.estimate)), direct, all);
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
