// The cost model of `aleph render --budget`: fits its exponents to frames of some scenes, and checks what it predicts
// for frames of others.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cost_pilot.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct CostOptions {
    StudyOptions study{.size = "160x120", .gather = 0, .spp = 0, .threads = 1};
    std::vector<std::string> fit, check, errors = {"4", "2", "1", ".5"};
    bool markdown = false;
};

/// One frame at several errors, of which the largest is first.
struct MeasuredFrame {
    std::string name;
    std::vector<PilotRun> full, pilot;
    CostRatios ratios;
};

/// Seconds of a processor: the clock's of every part, scaled to the processor time of all.
PilotRun measure(const Scene& scene, const RenderSettings& settings, std::int64_t frame, double scale) {
    const double before = processor_seconds();
    Pilot pilot = render_pilot(scene, settings, "", {frame}, scale);
    const double clock = pilot.run.seconds.sum() + pilot.run.start;
    const double factor = (processor_seconds() - before) / std::max(clock, 1e-9);
    CostParts& parts = pilot.run.seconds;
    for (double* part : {&parts.constant, &parts.pixels, &parts.fill, &parts.moments, &parts.shade, &pilot.run.start}) {
        *part *= factor;
    }
    return pilot.run;
}

MeasuredFrame measure_frame(const std::string& text, const CostOptions& options) {
    const FrameOfScene which = parse_frame_of_scene(text);
    const Scene scene = load_scene(which.file);
    const std::int64_t number = which.frame.value_or(0);
    MeasuredFrame frame;
    frame.name = fmt::format("{} {}", scene_name(which.file), number);
    const RenderSettings settings = scene_settings(scene, which.file, options.study.size, {});
    const double scale = find_pilot_scale(settings.width);
    frame.ratios = find_cost_ratios(scene, settings, {static_cast<int>(number)}, {number}, 1, scale);
    for (const std::string& error : options.errors) {
        const RenderSettings asked = with_settings(settings, {"error=" + error});
        frame.pilot.push_back(measure(scene, asked, number, scale));
        frame.full.push_back(measure(scene, asked, number, 1.0));
    }
    return frame;
}

/// A mean of exponents, weighted by the seconds that they explain.
struct MeanExponent {
    double sum = 0.0, weight = 0.0;

    /// Of seconds that grow from `low` to `high` while what they depend on grows by `ratio`.
    void add(double low, double high, double ratio, double total) {
        if (low <= 0.0 || high <= 0.0) return;
        sum += high / total * std::log(high / low) / std::log(ratio);
        weight += high / total;
    }
    double value() const { return weight > 0.0 ? sum / weight : 0.0; }
};

CostCoefficients fit(const std::vector<MeasuredFrame>& frames) {
    const auto fit_part = [&](double CostParts::*part, CostCoefficients& fitted) {
        MeanExponent size, error;
        for (const MeasuredFrame& frame : frames) {
            for (std::size_t i = 0; i < frame.full.size(); ++i) {
                const CostParts& full = frame.full[i].seconds;
                size.add(frame.pilot[i].seconds.*part, full.*part, frame.ratios.pixels, full.sum());
                if (i == 0) continue;
                error.add(frame.pilot[i - 1].seconds.*part, frame.pilot[i].seconds.*part,
                          frame.pilot[i - 1].error / frame.pilot[i].error, frame.pilot[i].seconds.sum());
            }
        }
        fitted.size.*part = size.value();
        fitted.error.*part = std::max(0.0, error.value());
    };
    CostCoefficients fitted{};
    for (double CostParts::*part : {&CostParts::pixels, &CostParts::fill, &CostParts::moments, &CostParts::shade}) {
        fit_part(part, fitted);
    }
    fitted.error.pixels = 0.0;
    return fitted;
}

void print_fit(const CostCoefficients& fitted, bool markdown) {
    const StudyTable table({"exponent", "pixels", "fill", "moments", "shade"}, 1, markdown);
    const auto add = [&](const char* name, const CostParts& parts) {
        table.add({name, fmt::format("{:.2f}", parts.pixels), fmt::format("{:.2f}", parts.fill),
                   fmt::format("{:.2f}", parts.moments), fmt::format("{:.2f}", parts.shade)});
    };
    add("of pixels", fitted.size);
    add("of 1 / error", fitted.error);
    fmt::print("\n");
}

/// Predictions from a pilot at the error itself, and from one that ends `skipped` errors before it.
void print_check(const std::vector<MeasuredFrame>& frames, const CostCoefficients& fitted, bool markdown) {
    const StudyTable table({"frame", "error", "pilot", "measured", "predicted", "ratio", "from the error before",
                            "ratio", "from two before", "ratio"},
                           1, markdown);
    for (const MeasuredFrame& frame : frames) {
        for (std::size_t i = 0; i < frame.full.size(); ++i) {
            const double measured = frame.full[i].seconds.sum() + frame.full[i].start;
            std::vector<std::string> cells = {
                frame.name, fmt::format("{:g}", frame.full[i].error),
                fmt::format("{:.3f}", frame.pilot[i].seconds.sum() + frame.pilot[i].start),
                fmt::format("{:.2f}", measured)};
            for (std::size_t skipped = 0; skipped < 3; ++skipped) {
                if (skipped > i) {
                    cells.insert(cells.end(), {"", ""});
                    continue;
                }
                const std::vector<PilotRun> runs(
                    frame.pilot.begin(),
                    frame.pilot.end() - static_cast<std::ptrdiff_t>(frame.pilot.size() - 1 - i + skipped));
                const double predicted = predict_seconds(runs, frame.ratios, fitted, frame.full[i].error);
                cells.push_back(fmt::format("{:.2f}", predicted));
                cells.push_back(fmt::format("{:.2f}", predicted / measured));
            }
            table.add(cells);
        }
    }
    fmt::print("\n");
}

void print_parts(const std::vector<MeasuredFrame>& frames, bool markdown) {
    const StudyTable table({"frame", "picture", "error", "start", "constant", "pixels", "fill", "moments", "shade"}, 2,
                           markdown);
    for (const MeasuredFrame& frame : frames) {
        const auto add = [&](const char* picture, const PilotRun& run) {
            std::vector<std::string> cells = {frame.name, picture};
            for (const double value : {run.error, run.start, run.seconds.constant, run.seconds.pixels, run.seconds.fill,
                                       run.seconds.moments, run.seconds.shade}) {
                cells.push_back(fmt::format("{:.3g}", value));
            }
            table.add(cells);
        };
        for (const PilotRun& run : frame.pilot) add("pilot", run);
        for (const PilotRun& run : frame.full) add("full", run);
    }
    fmt::print("\n");
}

void run_cost(const CostOptions& options) {
    std::vector<MeasuredFrame> fit_frames, check_frames;
    for (const std::string& text : options.fit) fit_frames.push_back(measure_frame(text, options));
    for (const std::string& text : options.check) check_frames.push_back(measure_frame(text, options));
    const CostCoefficients fitted = fit_frames.empty() ? fitted_coefficients() : fit(fit_frames);
    fmt::print("Seconds of a processor by part:\n\n");
    print_parts(fit_frames, options.markdown);
    print_parts(check_frames, options.markdown);
    fmt::print("Exponents:\n\n");
    print_fit(fitted, options.markdown);
    fmt::print("Seconds of the frames that were fitted:\n\n");
    print_check(fit_frames, fitted, options.markdown);
    fmt::print("Seconds of the others:\n\n");
    print_check(check_frames, fitted, options.markdown);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Fits the cost model of `aleph render --budget` and checks it on frames that it was not fitted to: seconds of "
        "a processor, measured and predicted from a small picture at the error itself or at larger ones."};
    aleph::CostOptions options;
    app.add_option("frames", options.fit, "SCENE@FRAME to fit; none: the exponents of the program are checked");
    app.add_option("--check", options.check, "SCENE@FRAME to predict")->delimiter(',');
    app.add_option("--errors", options.errors, "errors to ask for, the largest first")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    app.add_flag("--markdown", options.markdown, "print the tables as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_cost(options); });
}
