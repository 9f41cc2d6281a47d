// The three models of vision on moving gratings, whose answers are known; how they differ by frequency and velocity;
// and what their maps differ in for frames of scenes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "engine/base/errors.h"
#include "perception/castle.h"
#include "perception/kelly.h"
#include "perception/vision_model.h"
#include "render/cli/options.h"
#include "render/study/study_plot.h"
#include "scenes/studies/elevation_chart.h"
#include "scenes/studies/grating_run.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"
#include "scenes/studies/vision_formulas.h"
#include "scenes/studies/vision_frames.h"
#include "scenes/studies/vision_maps.h"

namespace aleph {

namespace {

struct GratingsOptions {
    StudyOptions study{.size = "320x240", .threads = 1};
    std::vector<std::string> scenes;
    std::string picture;
    int step = 5;
    bool markdown = false;
};

constexpr std::array band_rho = {16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25};  // cycles per degree
constexpr std::array velocities = {0.15, 1.0, 5.0, 20.0, 80.0};         // deg/s
constexpr std::array vision_names = {"thesis", "laird", "castle"};      // of all_visions

/// The largest errors of every velocity and of the frequencies from `highest` down to `lowest`.
GratingErrors run_all(GratingRun run, double highest, double lowest, int step) {
    GratingErrors errors;
    for (const double rho : band_rho) {
        if (rho > highest || rho < lowest) continue;
        run.grating.half_cycles = nearest_half_cycles(rho, run.viewing.pixels_per_degree);
        for (const double velocity : velocities) {
            run.velocity = velocity;
            errors.merge(run_grating(run, step));
        }
    }
    return errors;
}

/// The largest errors of both guides, in bright and in dim light.
GratingErrors run_lights(const VisionModel* vision, Bands bands, double highest, double lowest, int step) {
    GratingErrors errors;
    for (const Guide guide : {Guide::spatial, Guide::full}) {
        for (const auto& [mean, contrast] : {std::pair{0.5, 0.8}, std::pair{0.02, 0.5}}) {
            GratingRun run;
            run.grating = {.mean = mean, .contrast = contrast};
            run.perception = {.guide = guide, .vision = vision, .bands = bands};
            errors.merge(run_all(run, highest, lowest, step));
        }
    }
    return errors;
}

void print_gratings(const GratingsOptions& options) {
    fmt::print(
        "Gratings of 50 and 2 cd/m2, contrast .8 and .5, that move at .15 to 80 deg/s, guides spatial and full: the "
        "largest difference from the known answer, absolute of R, relative of the others.\n\n");
    const StudyTable table({"vision", "bands", "c/deg", "R", "aleph, by formulas", "aleph, by double functions",
                            "adaptation", "aleph from", "to", "pixels"},
                           3, options.markdown);
    for (std::size_t v = 0; v < all_visions.size(); ++v) {
        for (const Bands bands : {Bands::printed, Bands::measured}) {
            for (const auto& [highest, lowest] : {std::pair{16.0, 1.0}, std::pair{0.5, 0.25}}) {
                const GratingErrors e = run_lights(all_visions[v], bands, highest, lowest, options.step);
                table.add({vision_names[v], bands == Bands::printed ? "printed" : "measured",
                           fmt::format("{:g} to {:g}", highest, lowest), fmt::format("{:.1e}", e.response),
                           fmt::format("{:.1e}", e.aleph_written), fmt::format("{:.1e}", e.aleph_scalar),
                           all_visions[v] == &castle_vision() ? fmt::format("{:.1e}", e.adaptation) : "-",
                           fmt::format("{:.2f}", e.aleph_lowest), fmt::format("{:.1f}", e.aleph_highest),
                           fmt::format("{}", e.compared)});
            }
        }
    }
    fmt::print("\n");
}

/// The velocity in [low, high] at which csf_max is highest, deg/s, by golden sections.
double find_best_velocity(const KellyModel& model, double low, double high) {
    const double shrink = (std::sqrt(5.0) - 1.0) / 2.0;
    for (int i = 0; i < 60; ++i) {
        const double a = high - shrink * (high - low), b = low + shrink * (high - low);
        (csf_max(a, model) < csf_max(b, model) ? low : high) = csf_max(a, model) < csf_max(b, model) ? a : b;
    }
    return 0.5 * (low + high);
}

/// The largest relative difference of rho_peak (v + 2 / c2) from its constant, over velocities.
double find_scaling_error(const KellyModel& model) {
    const double product = csf_rho_numerator / (2.0 * std::numbers::pi * model.c1 * model.c2);
    double worst = 0.0;
    for (double v = model.min_velocity; v < 1e3; v *= 1.1)
        worst = std::max(worst, std::abs(csf_peak_frequency(v, model) * (v + 2.0 / model.c2) / product - 1.0));
    return worst;
}

void print_models(const GratingsOptions& options) {
    fmt::print("The models themselves:\n\n");
    const StudyTable table({"model", "at rest: peak, c/deg", "sensitivity", "written out", "highest", "at deg/s",
                            "peak (v + 2 / c2): largest relative difference"},
                           1, options.markdown);
    const auto add = [&](const char* name, const KellyModel& model, double (*written)(double, double)) {
        const double rest = model.min_velocity, peak = csf_peak_frequency(rest, model);
        const double best = find_best_velocity(model, rest, 20.0);
        table.add({name, fmt::format("{:.3f}", peak), fmt::format("{:.3f}", csf_max(rest, model)),
                   fmt::format("{:.3f}", written(peak, rest)), fmt::format("{:.3f}", csf_max(best, model)),
                   fmt::format("{:.3f}", best), fmt::format("{:.1e}", find_scaling_error(model))});
    };
    add("thesis, rest is .15 deg/s", daly_1998, written_thesis_sensitivity);
    add("laird, rest is .3 deg/s", laird_2006, written_laird_sensitivity);
    double worst = 0.0;
    int values = 0;
    for (const PublishedCastle& row : published_castle()) {
        for (std::size_t i = 0; i < row.sensitivity.size(); ++i) {
            const double rho = std::ldexp(0.25, static_cast<int>(i));
            const double found = castle_sensitivity(rho, rho * row.velocity, 100.0);
            worst = std::max(worst, std::abs(found - row.sensitivity[i]));
            ++values;
        }
    }
    fmt::print(
        "\ncastle: at most {:.1e} from {} sensitivities of the authors' program, which prints 4 decimals; peak at rest "
        "and 100 cd/m2 {:.4f}, written out {:.4f}\n\n",
        worst, values, castle_peak(100.0), written_castle_peak(100.0));
}

/// f of the thesis, and of laird and castle over it. @param follows  whether the eye follows .82 of the velocity
void print_ratios(const char* title, bool follows, bool markdown) {
    fmt::print("{}\n\n", title);
    std::vector<std::string> columns = {"c/deg"};
    for (const double v : velocities) columns.push_back(fmt::format("{:g} deg/s", v));
    const StudyTable table(columns, 1, markdown);
    for (const double rho : band_rho) {
        std::vector<std::string> cells = {fmt::format("{:g}", rho)};
        for (const double v : velocities) {
            const Stimulus seen{.frequency = rho,
                                .retinal = follows ? retinal_velocity(v, tracking_efficiency) : v,
                                .tracked = follows ? tracked_velocity(v, tracking_efficiency) : 0.0};
            const double thesis = thesis_vision().elevation(seen, {}), laird = laird_vision().elevation(seen, {}),
                         castle = castle_vision().elevation(seen, {});
            cells.push_back(fmt::format("{:.3g}; {:.2f} / {:.2f}", thesis, laird / thesis, castle / thesis));
        }
        table.add(cells);
    }
    fmt::print("\n");
}

void run_gratings(const GratingsOptions& options) {
    if (options.step < 1) throw InputError("", "--step", "expected at least 1");
    if (!options.picture.empty() && !options.picture.ends_with(".png")) {
        throw InputError(options.picture, "", "expected a name that ends with .png");
    }
    if (!options.scenes.empty()) {
        print_vision_frames(options.scenes, options.study, options.markdown);
    } else {
        print_gratings(options);
        print_models(options);
        print_ratios("By retinal velocity, when the eye follows nothing: f of the thesis; laird / castle over it.",
                     false, options.markdown);
        print_ratios("By image velocity, of which the eye follows .82: f of the thesis; laird / castle over it.", true,
                     options.markdown);
    }
    if (options.picture.empty()) return;
    if (draw_with_gnuplot(options.picture, elevation_chart_program())) {
        fmt::print("The chart: {}\n", options.picture);
    } else {
        fmt::print("No chart: gnuplot is not installed, or failed\n");
    }
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares the three models of vision (thesis, laird, castle). Without scenes: shows them sinusoidal gratings "
        "that move, whose Aleph values are known in closed form, and prints the largest differences, known values of "
        "the models, and how their elevations f differ by frequency and velocity (castle at 100 cd/m2). With --scenes: "
        "what their maps of real frames differ in, for pixels below 1, from 1 to 10, and above 10 deg/s; nothing is "
        "rendered but the quick estimate.\n\n"
        "  build/study_gratings --markdown -o gratings.png\n"
        "  build/study_gratings --scenes pool@20,art-gallery@205"};
    aleph::GratingsOptions options;
    app.add_option("--scenes", options.scenes,
                   "frames to compare maps of: SCENE@FRAME, a scene file or the name of a folder in scenes/")
        ->delimiter(',');
    app.add_option("-o,--output", options.picture, "file of a chart of f over velocity, .png; needs gnuplot");
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    aleph::add_value(app, "--step", options.step, "compare every so many pixels of a grating");
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    app.add_flag("--markdown", options.markdown, "print the tables as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_gratings(options); });
}
