// The three models of vision side by side: on drifting gratings, whose maps are known, and on frames of scenes.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/study/other_program.h"
#include "scenes/studies/grating.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

constexpr Vision models[] = {Vision::thesis, Vision::laird, Vision::castle};
constexpr const char* model_names[] = {"thesis", "laird", "castle"};
constexpr double velocities[] = {0.0, 1.0, 5.0, 20.0, 80.0};
constexpr double frequencies[] = {16.0, 8.0, 4.0, 2.0, 1.0, 0.5, 0.25};

struct GratingOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0};
    std::vector<std::string> frames;
    std::string plot;
    bool markdown = false;
};

const ViewingConditions viewing;
constexpr FrameRate thirty{30, 1};

void print_checks(bool markdown) {
    const StudyTable table({"model", "bands", "guide", "gratings", "largest relative difference"}, 3, markdown);
    for (std::size_t m = 0; m < std::size(models); ++m) {
        for (const Bands bands : {Bands::printed, Bands::measured}) {
            for (const Guide guide : {Guide::spatial, Guide::full}) {
                PerceptionSettings settings;
                settings.guide = guide;
                settings.vision = models[m];
                settings.bands = bands;
                double worst = 0.0;
                int count = 0;
                for (const double rho : {0.3, 0.5, 1.0, 2.0, 4.0, 8.0, 15.0}) {
                    for (const double velocity : velocities) {
                        for (const double luminance : {1.0, 10.0, 50.0}) {
                            worst = std::max(
                                worst, check_grating({rho, velocity, luminance, 0.5}, settings, viewing, thirty).aleph);
                            ++count;
                        }
                    }
                }
                table.add({model_names[m], bands == Bands::printed ? "printed" : "measured",
                           guide == Guide::full ? "full" : "spatial", fmt::format("{}", count),
                           fmt::format("{:.1e}", worst)});
            }
        }
    }
    fmt::print("\n");
}

double elevation_of(Vision vision, double rho, double velocity) {
    return known_elevation(vision, Guide::full, rho, {rho, velocity, 100.0, 0.5}, 100.0, viewing, thirty);
}

/// f of each model, and how it compares with the thesis's.
void print_elevations(bool markdown) {
    std::vector<std::string> columns = {"cycles per degree"};
    for (const double velocity : velocities) columns.push_back(fmt::format("{:g} deg/s", velocity));
    const StudyTable table(columns, 1, markdown);
    for (const double rho : frequencies) {
        std::vector<std::string> cells = {fmt::format("{:g}", rho)};
        for (const double velocity : velocities) {
            std::string text;
            for (const Vision vision : models) {
                text += fmt::format("{}{:.3g}", text.empty() ? "" : " / ", elevation_of(vision, rho, velocity));
            }
            cells.push_back(text);
        }
        table.add(cells);
    }
    fmt::print("\n");
}

/// The maps of a frame: the same estimate and motion for all models.
struct ModelMaps {
    std::vector<Image<float>> aleph, threshold;  ///< by model
    Image<float> velocity;
};

ModelMaps compute_model_maps(const std::string& text, const GratingOptions& options) {
    const FrameOfScene which = parse_frame_of_scene(text);
    const Scene scene = load_scene(which.file);
    ModelMaps maps;
    for (const Vision vision : models) {
        RenderSettings settings = scene_settings(scene, which.file, options.study.size, {});
        settings.perception.guide = Guide::saliency;
        settings.perception.vision = vision;
        FrameRequest request;
        request.frame = false;
        FrameOutput out = Sequence(scene, settings).render(which.frame.value_or(0), request);
        maps.aleph.push_back(std::move(out.perception.aleph));
        maps.threshold.push_back(std::move(out.threshold));
        maps.velocity = std::move(out.velocity);
    }
    return maps;
}

double quantile(std::vector<double>& values, double q) {
    const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, at);
    return *at;
}

/// Ranks, equal values with their mean rank.
std::vector<double> rank(const std::vector<float>& values) {
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
    std::ranges::sort(order, {}, [&](std::size_t i) { return values[i]; });
    std::vector<double> ranks(values.size());
    for (std::size_t i = 0; i < order.size();) {
        std::size_t end = i;
        while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
        for (std::size_t j = i; j < end; ++j) ranks[order[j]] = 0.5 * static_cast<double>(i + end - 1);
        i = end;
    }
    return ranks;
}

/// Spearman's correlation.
double correlate_ranks(const Image<float>& a, const Image<float>& b) {
    const std::vector<double> x = rank(a.pixels), y = rank(b.pixels);
    const double mean = 0.5 * static_cast<double>(x.size() - 1);
    double xy = 0.0, xx = 0.0, yy = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) {
        xy += (x[i] - mean) * (y[i] - mean);
        xx += (x[i] - mean) * (x[i] - mean);
        yy += (y[i] - mean) * (y[i] - mean);
    }
    return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

void print_maps(const GratingOptions& options) {
    const StudyTable table({"frame", "pixels", "share (%)", "model", "aleph: 10 %", "50 %", "90 %",
                            "threshold over thesis's: 10 %", "50 %", "90 %", "rank correlation of aleph, all pixels"},
                           2, options.markdown);
    struct Speed {
        const char* name;
        double least, most;
    };
    for (const std::string& text : options.frames) {
        const ModelMaps maps = compute_model_maps(text, options);
        const FrameOfScene which = parse_frame_of_scene(text);
        const std::string name = fmt::format("{} {}", scene_name(which.file), which.frame.value_or(0));
        for (const Speed speed :
             {Speed{"below 1 deg/s", -1.0, 1.0}, Speed{"1 to 10", 1.0, 10.0}, Speed{"above 10", 10.0, 1e30}}) {
            for (std::size_t m = 0; m < std::size(models); ++m) {
                std::vector<double> aleph, ratio;
                for (std::size_t i = 0; i < maps.velocity.size(); ++i) {
                    if (maps.velocity.pixels[i] < speed.least || maps.velocity.pixels[i] >= speed.most) continue;
                    aleph.push_back(maps.aleph[m].pixels[i]);
                    ratio.push_back(static_cast<double>(maps.threshold[m].pixels[i]) / maps.threshold[0].pixels[i]);
                }
                if (aleph.empty()) continue;
                const auto cell = [](std::vector<double>& values, double q) {
                    return fmt::format("{:.3g}", quantile(values, q));
                };
                table.add({name, speed.name,
                           fmt::format("{:.1f}", 100.0 * static_cast<double>(aleph.size()) /
                                                     static_cast<double>(maps.velocity.size())),
                           model_names[m], cell(aleph, 0.1), cell(aleph, 0.5), cell(aleph, 0.9), cell(ratio, 0.1),
                           cell(ratio, 0.5), cell(ratio, 0.9),
                           fmt::format("{:.2f}", correlate_ranks(maps.aleph[m], maps.aleph[0]))});
            }
        }
    }
    fmt::print("\n");
}

/// Elevation over image velocity, for three bands.
void draw_plot(const std::filesystem::path& file) {
    if (!find_program("gnuplot")) {
        fmt::print("No chart: gnuplot is not installed (scenes/setup.sh installs it).\n");
        return;
    }
    std::string data, plot;
    for (const double rho : {16.0, 4.0, 1.0}) {
        for (std::size_t m = 0; m < std::size(models); ++m) {
            const std::string name = fmt::format("$d{}", data.size());
            std::string block = name + " << END\n";
            for (double v = 0.1; v < 200.0; v *= 1.1)
                block += fmt::format("{} {}\n", v, elevation_of(models[m], rho, v));
            data += block + "END\n";
            plot += fmt::format("{}{} with lines lw 2 lc {} dt {} title \"{}, {:g} c/deg\"",
                                plot.empty() ? "plot " : ", ", name, m + 1,
                                rho == 16.0  ? 1
                                : rho == 4.0 ? 2
                                             : 3,
                                model_names[m], rho);
        }
    }
    const TemporaryFolder folder;
    const ProgramOutput done = run_program_in(
        folder.path(), {"gnuplot", "-"},
        "set terminal pngcairo size 900,520 font \"DejaVu Sans,11\"\nset output \"plot.png\"\nset logscale xy\nset "
        "grid\n"
        "set xlabel \"image velocity, deg/s; the eye follows .82 of it\"\n"
        "set ylabel \"threshold over that of the most visible pattern at rest\"\nset key outside right\n" +
            data + plot + "\n");
    if (done.code != 0) throw std::runtime_error("gnuplot failed: " + done.text);
    std::filesystem::copy_file(folder.path() / "plot.png", file, std::filesystem::copy_options::overwrite_existing);
    fmt::print("The chart: {}\n", file.string());
}

void run_gratings(const GratingOptions& options) {
    fmt::print("Maps of drifting gratings against the known ones:\n\n");
    print_checks(options.markdown);
    fmt::print(
        "Elevation f of bands that drift, of which the eye follows .82, at 100 cd/m2: thesis / laird / castle:\n\n");
    print_elevations(options.markdown);
    if (!options.frames.empty()) {
        fmt::print("Maps of frames, by the speed of the pixels:\n\n");
        print_maps(options);
    }
    if (!options.plot.empty()) draw_plot(options.plot);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares the models of vision thesis, laird and castle: their maps of drifting gratings with the known ones, "
        "how far they raise thresholds by frequency and velocity, and their maps of frames of scenes."};
    aleph::GratingOptions options;
    app.add_option("frames", options.frames, "SCENE@FRAME whose maps are compared; none: gratings alone");
    app.add_option("-o,--output", options.plot, "PNG file for a chart of the elevations over velocity");
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    app.add_flag("--markdown", options.markdown, "print the tables as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_gratings(options); });
}
