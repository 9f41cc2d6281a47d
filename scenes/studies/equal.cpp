// What guidance saves at equal visibility: for each adapter from the Aleph map to accuracy, the rays at which a given
// share of the pixels is beyond the viewer's threshold, or beyond a part of it, against the rays of the best uniform
// accuracy with the same share. Indirect light at pixel centres, against dense gathers with random numbers of their
// own.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>

#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/guide/accuracy_map.h"
#include "render/settings/setting_table.h"
#include "scenes/studies/cached_light.h"
#include "scenes/studies/cost_curve.h"
#include "scenes/studies/reference_light.h"
#include "scenes/studies/saving.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

std::vector<std::string> list_adapters() {
    for (const Setting& setting : setting_table()) {
        if (setting.key == "adapter") return setting.choices;
    }
    return {};
}

struct EqualOptions {
    StudyOptions study{.size = "240x180", .gather = 0, .spp = 0};
    ReferenceOptions reference{.strata = 4096, .grid = {2}};
    std::vector<std::string> frames;
    std::vector<std::string> accuracies{};  ///< empty: a ladder from 1 downwards, as far as needed
    std::vector<std::string> adapters = list_adapters(), visions = {"thesis", "castle"}, percents = {"1", ".1"};
    std::vector<std::string> multiples = {"1", ".5", ".25"};
    double most_rays = 20.0;  ///< million, of one run
    std::string guide = "saliency";
    bool markdown = false;
};

/// One run of a variant.
struct Run {
    double rays = 0.0, seconds = 0.0;
    LightError error;
};

/// A way to choose accuracies; no adapter: uniform.
struct Variant {
    std::string vision, adapter;
    std::vector<Run> runs;

    std::string name() const { return adapter.empty() ? "uniform" : adapter; }
    /// The share of pixels beyond so many thresholds against what it costs.
    std::vector<CostPoint> points(double thresholds) const {
        std::vector<CostPoint> points;
        for (const Run& run : runs) points.push_back({run.error.percent_beyond(thresholds), run.rays, run.seconds});
        return points;
    }
};

struct Judged {
    std::string name;
    FrameVision maps;
};

/// The variants of one frame, with a point for each accuracy.
class FrameStudy {
  public:
    FrameStudy(const EqualOptions& options, const Scene& scene, const FrameOfScene& which)
        : options_(options),
          settings_(study_settings(scene, which.file, options.study)),
          sequence_(scene, with_choice(settings_, "guide", "none")),
          number_(which.frame.value_or(sequence_.range().first)),
          name_(fmt::format("{} {}", scene_name(which.file), number_)),
          frame_(sequence_, settings_, number_),
          reference_(load_or_gather_reference(frame_, settings_, which.file, options.reference, options.study.quiet)) {
        const Guide guide = with_choice(settings_, "guide", options.guide).perception.guide;
        for (const std::string& name : options.visions) {
            const VisionModel* const vision = with_choice(settings_, "vision", name).perception.vision;
            Sequence viewer = make_vision_sequence(scene, settings_, guide, vision);
            judges_.push_back({name, compute_vision(viewer, number_)});
            print_noise(judges_.back());
        }
    }

    void run(const StudyTable& table) {
        run_uniform(table);
        for (const Judged& judge : judges_) {
            for (const std::string& adapter : options_.adapters) {
                Variant variant{judge.name, adapter, {}};
                climb([&](double accuracy) {
                    add_run(table, variant, accuracy, render(accuracy, adapter, judge), judge);
                    return is_done(variant);
                });
                variants_.push_back(variant);
            }
        }
    }

    /// Rows of the rays at each percentage, and the ratio to those of the uniform accuracy.
    void summarize(const StudyTable& table, std::vector<Saving>& savings) const {
        const double least = 50.0 / static_cast<double>(pixels_);  // half a pixel
        for (const std::string& multiple : options_.multiples) {
            const double thresholds = parse_value<double>(multiple, "--multiples");
            for (const Variant& variant : variants_) {
                const auto uniform = std::ranges::find_if(
                    variants_, [&](const Variant& v) { return v.adapter.empty() && v.vision == variant.vision; });
                const std::vector<CostPoint> points = variant.points(thresholds);
                std::vector<std::string> cells = {name_, variant.vision, multiple, variant.name()};
                for (const std::string& text : options_.percents) {
                    const double percent = parse_value<double>(text, "--percents");
                    const auto cost = cost_at(points, percent, least);
                    const auto base = cost_at(uniform->points(thresholds), percent, least);
                    cells.push_back(cost ? fmt::format("{:.3f}", 1e-6 * cost->rays)
                                         : describe_missing(points, percent));
                    cells.push_back(cost && base ? fmt::format("{:.2f}", base->rays / cost->rays) : "-");
                    cells.push_back(cost && base ? fmt::format("{:.2f}", base->seconds / cost->seconds) : "-");
                    if (cost && base && !variant.adapter.empty()) {
                        savings.push_back({variant.vision, multiple, variant.name(), text, base->rays / cost->rays});
                    }
                }
                table.add(cells);
            }
        }
    }

  private:
    /// One run for each accuracy, from the loosest on. Without a list each is 1 / sqrt 2 of the one before.
    /// @param run  returns true if no tighter accuracy is needed
    void climb(const std::function<bool(double accuracy)>& run) const {
        constexpr double tightest = 0.01;
        if (!options_.accuracies.empty()) {
            for (const double accuracy : parse_values(options_.accuracies, "--accuracies")) run(accuracy);
            return;
        }
        for (double accuracy = 1.0; accuracy > tightest && !run(accuracy); accuracy *= std::sqrt(0.5)) {
        }
    }

    /// Whether the last run reaches the least percentage of the least multiple, or is the dearest allowed.
    bool is_done(const Variant& variant) const {
        const Run& last = variant.runs.back();
        const double percent = std::ranges::min(parse_values(options_.percents, "--percents"));
        const double thresholds = std::ranges::min(parse_values(options_.multiples, "--multiples"));
        return last.error.percent_beyond(thresholds) <= percent || last.rays > 1e6 * options_.most_rays;
    }

    /// One light for all judges.
    void run_uniform(const StudyTable& table) {
        for (const Judged& judge : judges_) variants_.push_back({judge.name, "", {}});
        climb([&](double accuracy) {
            const CachedLight light = render(accuracy, "", judges_.front());
            bool done = true;
            for (std::size_t i = 0; i < judges_.size(); ++i) {
                add_run(table, variants_[i], accuracy, light, judges_[i]);
                done = done && is_done(variants_[i]);
            }
            return done;
        });
    }

    CachedLight render(double accuracy, const std::string& adapter, const Judged& judge) const {
        RenderSettings settings = settings_;
        settings.accuracy = accuracy;
        settings.perception.guide = Guide::none;
        if (!adapter.empty()) {
            settings = with_choice(with_choice(settings, "adapter", adapter), "guide", options_.guide);
        }
        validate(settings);
        return compute_cached_light(frame_, settings,
                                    compute_accuracy_map(judge.maps.aleph, judge.maps.tolerance, settings));
    }

    void add_run(const StudyTable& table, Variant& variant, double accuracy, const CachedLight& light,
                 const Judged& judge) {
        variant.runs.push_back({light.rays(), light.seconds(),
                                measure_light(light.light, reference_, options_.reference.grid, judge.maps.threshold)});
        const LightError& error = variant.runs.back().error;
        pixels_ = error.pixels;
        table.add({name_, variant.vision, variant.name(), fmt::format("{:.3g}", accuracy),
                   fmt::format("{}", light.record_count),
                   fmt::format("{:.3f}", 1e-6 * static_cast<double>(light.gather_rays)),
                   fmt::format("{:.3f}", 1e-6 * light.rays()), fmt::format("{:.2f}", light.seconds()),
                   fmt::format("{:.2e}", error.relative_mse - error.noise_mse),
                   fmt::format("{:.3f}", error.percent_beyond(1.0)), fmt::format("{:.3f}", error.percent_beyond(0.25)),
                   fmt::format("{:.1f}", error.worst())});
    }

    static std::string describe_missing(const std::vector<CostPoint>& points, double percent) {
        const auto [least, most] = std::ranges::minmax(points, {}, &CostPoint::rays);
        if (most.percent > percent) return fmt::format("> {:.3f}", 1e-6 * most.rays);
        return fmt::format("< {:.3f}", 1e-6 * least.rays);
    }

    void print_noise(const Judged& judge) const {
        const LightError noise = measure_light(Image<float>(settings_.width, settings_.height), reference_,
                                               options_.reference.grid, judge.maps.threshold);
        fmt::print(
            "{}, {}: {} pixels; noise of the reference: relative MSE {:.1e}, 99 % of the pixels within {:.2g} "
            "thresholds; the maps take {:.2f} s\n",
            name_, judge.name, noise.pixels, noise.noise_mse, noise.noise_percentile_99, judge.maps.seconds);
    }

    const EqualOptions& options_;
    RenderSettings settings_;
    Sequence sequence_;
    std::int64_t number_;
    std::string name_;
    StudyFrame frame_;
    ReferenceLight reference_;
    std::vector<Judged> judges_;
    std::vector<Variant> variants_;
    std::size_t pixels_ = 1;
};

void run_equal(const EqualOptions& options) {
    std::vector<std::unique_ptr<FrameStudy>> studies;
    for (const std::string& text : options.frames) {
        const FrameOfScene which = parse_frame_of_scene(text);
        studies.push_back(std::make_unique<FrameStudy>(options, load_scene(which.file), which));
    }
    fmt::print("\n");
    const StudyTable points({"frame", "vision", "accuracy from", "accuracy", "records", "gather (M)", "rays (M)",
                             "seconds", "relative MSE", "beyond (%)", "beyond .25", "worst"},
                            3, options.markdown);
    for (const auto& study : studies) study->run(points);
    fmt::print("\n");
    std::vector<std::string> columns = {"frame", "vision", "thresholds", "accuracy from"};
    for (const std::string& percent : options.percents) {
        columns.push_back(fmt::format("rays (M) at {} %", percent));
        columns.push_back("times fewer");
        columns.push_back("times faster");
    }
    const StudyTable summary(columns, 4, options.markdown);
    std::vector<Saving> savings;
    for (const auto& study : studies) study->summarize(summary, savings);
    fmt::print("\n");
    print_means(savings, options.markdown);
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Compares guided with uniform accuracies at an equal share of pixels beyond the threshold of a viewer: prints "
        "what each accuracy costs, then the gather and shadow rays at which given percentages are reached, with the "
        "ratio to the best uniform accuracy. Seconds are of a processor, for filling and reading the cache."};
    aleph::EqualOptions options;
    app.add_option("frames", options.frames, "scene files; SCENE@FRAME chooses a frame, else the first")->required();
    aleph::add_study_options(app, options.study);
    aleph::add_quiet_option(app, options.study);
    app.add_option("--accuracies", options.accuracies,
                   "accuracies of every variant, instead of 1 and from there on 1 / sqrt 2 of the one before until the "
                   "least percentage is reached at the least multiple")
        ->delimiter(',');
    app.add_option("--most-rays", options.most_rays, "millions of rays after which no tighter accuracy is tried")
        ->capture_default_str();
    app.add_option("--multiples", options.multiples, "thresholds, or parts of one, that errors are compared with")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--adapters", options.adapters, "adapters to compare with uniform accuracies")
        ->delimiter(',')
        ->capture_default_str();
    app.add_option("--vision", options.visions, "models of vision")->delimiter(',')->capture_default_str();
    app.add_option("--guide", options.guide, "guide of the adapters and of the thresholds")->capture_default_str();
    app.add_option("--percents", options.percents, "percentages of pixels beyond the threshold")
        ->delimiter(',')
        ->capture_default_str();
    aleph::add_reference_options(app, options.reference);
    app.add_flag("--markdown", options.markdown, "print the tables as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_equal(options); });
}
