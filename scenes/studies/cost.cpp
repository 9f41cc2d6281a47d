// The cost model of `aleph render --budget`: fits its coefficients to frames of some scenes, and checks what it
// predicts for frames of others.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/budget/cost_pilot.h"
#include "render/cli/study_output.h"
#include "render/cli/support/options.h"
#include "render/frame/sequence.h"
#include "render/settings/measure.h"
#include "render/study/prepared_study.h"
#include "scenes/studies/study_options.h"

namespace aleph {

namespace {

struct CostOptions {
    StudyOptions study{.threads = 1};
    std::vector<std::string> fit, check, errors = {"10", "2", "1", ".5"};
};

/// One frame at several errors, of which the largest is first.
struct MeasuredFrame {
    std::string name;
    PilotSeconds pilot;            ///< its parts are of the same errors
    double pilot_took = 0.0;       ///< s
    std::vector<CostParts> whole;  ///< by error
};

CostParts measure_whole(const Scene& scene, const RenderSettings& settings, std::int64_t number) {
    CostParts parts;
    StageClock clock;
    Sequence sequence(scene, settings);
    clock.add_to(parts.start);
    double seconds = 0.0;
    const FrameStatistics stats = sequence.render(number).statistics;
    clock.add_to(seconds);
    parts.fill = stats.seconds.fill;
    parts.shade = stats.seconds.shade;
    for (const KeyframeStatistics& moment : stats.keyframes) parts.keyframes += moment.seconds;
    parts.before = seconds - parts.fill - parts.shade - parts.keyframes;
    return parts;
}

MeasuredFrame measure_frame(const std::string& text, const CostOptions& options) {
    const FrameOfScene which = parse_frame_of_scene(text);
    const Scene scene = load_scene(which.file);
    const std::int64_t number = which.frame.value_or(0);
    const RenderSettings settings = scene_settings(scene, which.file, options.study);
    MeasuredFrame frame;
    frame.name = fmt::format("{} {}", name_scene(which.file), number);
    PilotRequest request{scene, "", {number}, {}, [](const PilotSeconds&, double) { return true; }};
    for (const std::string& error : options.errors) {
        request.settings.push_back(with_settings(settings, {"error=" + error}));
    }
    StageClock clock;
    frame.pilot = run_pilot(request).seconds;
    clock.add_to(frame.pilot_took);
    for (const RenderSettings& asked : request.settings) frame.whole.push_back(measure_whole(scene, asked, number));
    return frame;
}

constexpr double least_growth = 0.02;  // of a frame's seconds: less is noise

struct WeightedMean {
    double sum = 0.0, weight = 0.0;

    void add(double value, double w) {
        sum += w * value;
        weight += w;
    }
    double value_or(double fallback) const { return weight > 0.0 ? sum / weight : fallback; }
};

struct Fit {
    WeightedMean shade, overlap, fill, keyframes, shade_exponent, light_exponent;

    void add(const MeasuredFrame& frame, std::size_t i) {
        const PilotSeconds& pilot = frame.pilot;
        const CostParts &whole = frame.whole[i], &loosest = frame.whole.front();
        const double all = whole.sum();
        if (pilot.keyframes > 0.0) {
            shade.add(pilot.parts[i].shade / pilot.share / whole.shade, whole.shade / all);
        }
        const double light = (pilot.parts[i].fill - pilot.parts.front().fill) / pilot.share;
        if (light < least_growth * all) return;
        if (pilot.keyframes > 0.0) {
            fill.add((whole.fill - loosest.fill) / light, light / all);
            keyframes.add((whole.keyframes - loosest.keyframes) / (pilot.keyframes * light), light / all);
        } else {
            overlap.add(light / std::max(whole.fill - loosest.fill, least_growth * light), light / all);
        }
    }

    /// How the part's growth follows the error, from one error to the next.
    void add_growth(const MeasuredFrame& frame, std::size_t i) {
        const std::vector<PartSeconds>& parts = frame.pilot.parts;
        const double step = std::log(parts[i - 1].error / parts[i].error), all = frame.whole[i].sum();
        const auto add = [&](WeightedMean& exponent, double PartSeconds::*seconds) {
            const double before = parts[i - 1].*seconds - parts[0].*seconds,
                         now = parts[i].*seconds - parts[0].*seconds;
            if (before / frame.pilot.share < least_growth * all || now < before) return;
            exponent.add(std::log(now / before) / step, now / frame.pilot.share / all);
        };
        add(shade_exponent, &PartSeconds::shade);
        add(light_exponent, &PartSeconds::fill);
    }
};

/// Means of what each frame and error tells, weighted by the share of the frame's seconds that it explains.
CostCoefficients fit_coefficients(const std::vector<MeasuredFrame>& frames) {
    Fit fit;
    for (const MeasuredFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.whole.size(); ++i) {
            fit.add(frame, i);
            if (i > 1) fit.add_growth(frame, i);
        }
    }
    const CostCoefficients usual = fitted_coefficients();
    return {.shade = fit.shade.value_or(usual.shade),
            .overlap = fit.overlap.value_or(usual.overlap),
            .fill = fit.fill.value_or(usual.fill),
            .keyframes = fit.keyframes.value_or(usual.keyframes),
            .shade_exponent = fit.shade_exponent.value_or(usual.shade_exponent),
            .light_exponent = fit.light_exponent.value_or(usual.light_exponent)};
}

PilotSeconds end_pilot(PilotSeconds pilot, std::size_t last) {
    pilot.parts.resize(last + 1);
    return pilot;
}

/// Predictions from pilots that end at the error itself, and at the one before.
void print_check(const std::vector<MeasuredFrame>& frames, const CostCoefficients& fitted, bool markdown) {
    std::vector<TableRow> rows{{"frame", "error", "measured", "predicted", "ratio", "from the error before", "ratio"}};
    double worst = 1.0, worst_before = 1.0;
    for (const MeasuredFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.whole.size(); ++i) {
            const double measured = frame.whole[i].sum(), error = frame.pilot.parts[i].error;
            std::vector<std::string> cells = {frame.name, fmt::format("{:g}", error), fmt::format("{:.2f}", measured)};
            const auto add = [&](std::size_t last, double& largest) {
                const double predicted = predict_seconds(end_pilot(frame.pilot, last), {}, fitted, error).sum();
                const double ratio = predicted / measured;
                largest = std::max({largest, ratio, 1.0 / ratio});
                cells.push_back(fmt::format("{:.2f}", predicted));
                cells.push_back(fmt::format("{:.2f}", ratio));
            };
            add(i, worst);
            if (i >= 2) {
                add(i - 1, worst_before);
            } else {
                cells.insert(cells.end(), {"", ""});
            }
            rows.push_back(std::move(cells));
        }
    }
    print_rows(rows, markdown, std::cout);
    fmt::print("\nLargest factor between prediction and measurement: {:.2f}; from the error before: {:.2f}.\n\n", worst,
               worst_before);
}

/// By what takes the seconds: measured, and predicted.
void print_parts(const std::vector<MeasuredFrame>& frames, const CostCoefficients& fitted, bool markdown) {
    std::vector<TableRow> rows{{"frame", "error", "start", "before light", "fill", "keyframes", "shade", "pilot"}};
    for (const MeasuredFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.whole.size(); ++i) {
            const double error = frame.pilot.parts[i].error;
            const CostParts predicted = predict_seconds(end_pilot(frame.pilot, i), {}, fitted, error);
            std::vector<std::string> cells = {frame.name, fmt::format("{:g}", error)};
            for (double CostParts::*part :
                 {&CostParts::start, &CostParts::before, &CostParts::fill, &CostParts::keyframes, &CostParts::shade}) {
                cells.push_back(fmt::format("{:.3f} / {:.3f}", frame.whole[i].*part, predicted.*part));
            }
            cells.push_back(i == 0 ? fmt::format("{:.2f}", frame.pilot_took) : "");
            rows.push_back(std::move(cells));
        }
    }
    print_rows(rows, markdown, std::cout);
    fmt::print("\n");
}

int run_cost(const CostOptions& options) {
    std::vector<MeasuredFrame> fit_frames, check_frames;
    if (options.fit.empty() && options.check.empty()) throw InputError("", "--check", "name frames to fit or to check");
    for (const std::string& text : options.fit) fit_frames.push_back(measure_frame(text, options));
    for (const std::string& text : options.check) check_frames.push_back(measure_frame(text, options));
    const CostCoefficients fitted = fit_frames.empty() ? fitted_coefficients() : fit_coefficients(fit_frames);
    fmt::print(
        "Coefficients: shade {:.2f}, overlap {:.2f}, fill {:.2f}, keyframes {:.2f}, exponents of samples {:.2f} and of "
        "light {:.2f}\n\n",
        fitted.shade, fitted.overlap, fitted.fill, fitted.keyframes, fitted.shade_exponent, fitted.light_exponent);
    for (const auto& [frames, title] :
         {std::pair{&fit_frames, "frames that were fitted"}, std::pair{&check_frames, "others"}}) {
        if (frames->empty()) continue;
        fmt::print("Seconds of the {}, measured / predicted:\n\n", title);
        print_parts(*frames, fitted, options.study.markdown);
        print_check(*frames, fitted, options.study.markdown);
    }
    return exit_done;
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Fits the cost model of `aleph render --budget` and checks it on frames that it was not fitted to: seconds of "
        "a clock for a frame rendered whole, and predicted from a part of its pixels and two small pictures. Let "
        "nothing else run beside it."};
    aleph::CostOptions options;
    app.add_option("frames", options.fit, "SCENE@FRAME to fit; none: the coefficients of the program are checked");
    app.add_option("--check", options.check, "SCENE@FRAME to predict")->delimiter(',');
    app.add_option("--errors", options.errors, "errors to ask for, the largest first")
        ->delimiter(',')
        ->capture_default_str();
    return aleph::run_study_program(app, options.study, argc, argv, [&] { return aleph::run_cost(options); });
}
