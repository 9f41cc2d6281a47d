// What guidance saves at equal visibility: for each adapter from the Aleph map to accuracy, the rays at which a given
// share of the pixels is beyond the viewer's threshold, against the rays of the best uniform accuracy with the same
// share. Indirect light at pixel centres, against dense gathers with random numbers of their own.

#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "engine/load/load_scene.h"
#include "render/accuracy_map.h"
#include "render/cli/options.h"
#include "render/setting_table.h"
#include "scenes/studies/cached_light.h"
#include "scenes/studies/cost_curve.h"
#include "scenes/studies/reference_light.h"
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
    std::vector<std::string> accuracies = {"1", ".7", ".5", ".35", ".25", ".18", ".12", ".08", ".05"};
    std::vector<std::string> adapters = list_adapters(), visions = {"thesis", "castle"}, percents = {"1", ".1"};
    std::string guide = "saliency";
    bool markdown = false;
};

/// A way to choose accuracies; no adapter: uniform.
struct Variant {
    std::string vision, adapter;
    std::vector<CostPoint> points;

    std::string name() const { return adapter.empty() ? "uniform" : adapter; }
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
            const Vision vision = with_choice(settings_, "vision", name).perception.vision;
            Sequence viewer = make_vision_sequence(scene, settings_, guide, vision);
            judges_.push_back({name, compute_vision(viewer, number_)});
            print_noise(judges_.back());
        }
    }

    void run(const StudyTable& table) {
        for (const Judged& judge : judges_) variants_.push_back({judge.name, "", {}});
        for (const std::string& text : options_.accuracies) {
            const CachedLight light = render(text, "", judges_.front());
            for (std::size_t i = 0; i < judges_.size(); ++i) add_point(table, variants_[i], text, light, judges_[i]);
        }
        for (const Judged& judge : judges_) {
            for (const std::string& adapter : options_.adapters) {
                Variant variant{judge.name, adapter, {}};
                for (const std::string& text : options_.accuracies)
                    add_point(table, variant, text, render(text, adapter, judge), judge);
                variants_.push_back(variant);
            }
        }
    }

    /// Rows of the rays at each percentage, and the ratio to those of the uniform accuracy.
    void summarize(const StudyTable& table) const {
        const double least = 50.0 / static_cast<double>(pixels_);  // half a pixel
        for (const Variant& variant : variants_) {
            const auto uniform = std::ranges::find_if(
                variants_, [&](const Variant& v) { return v.adapter.empty() && v.vision == variant.vision; });
            std::vector<std::string> cells = {name_, variant.vision, variant.name()};
            for (const std::string& text : options_.percents) {
                const double percent = parse_value<double>(text, "--percents");
                const auto cost = cost_at(variant.points, percent, least);
                const auto base = cost_at(uniform->points, percent, least);
                cells.push_back(cost ? fmt::format("{:.3f}", 1e-6 * cost->rays) : describe_missing(variant, percent));
                cells.push_back(cost && base ? fmt::format("{:.2f}", base->rays / cost->rays) : "-");
                cells.push_back(cost && base ? fmt::format("{:.2f}", base->seconds / cost->seconds) : "-");
            }
            table.add(cells);
        }
    }

  private:
    CachedLight render(const std::string& accuracy, const std::string& adapter, const Judged& judge) const {
        RenderSettings settings = settings_;
        settings.accuracy = parse_value<double>(accuracy, "--accuracies");
        settings.perception.guide = Guide::none;
        if (!adapter.empty()) {
            settings = with_choice(with_choice(settings, "adapter", adapter), "guide", options_.guide);
        }
        validate(settings);
        return compute_cached_light(frame_, settings,
                                    compute_accuracy_map(judge.maps.aleph, judge.maps.tolerance, settings));
    }

    void add_point(const StudyTable& table, Variant& variant, const std::string& accuracy, const CachedLight& light,
                   const Judged& judge) {
        const LightError error = measure_light(light.light, reference_, options_.reference.grid, judge.maps.threshold);
        variant.points.push_back({error.percent_beyond(1.0), light.rays(), light.seconds()});
        pixels_ = error.pixels;
        table.add({name_, variant.vision, variant.name(), accuracy, fmt::format("{}", light.record_count),
                   fmt::format("{:.3f}", 1e-6 * static_cast<double>(light.gather_rays)),
                   fmt::format("{:.3f}", 1e-6 * light.rays()), fmt::format("{:.2f}", light.seconds()),
                   fmt::format("{:.2e}", error.relative_mse - error.noise_mse),
                   fmt::format("{:.3f}", error.percent_beyond(1.0)), fmt::format("{:.1f}", error.worst())});
    }

    static std::string describe_missing(const Variant& variant, double percent) {
        const auto [least, most] = std::ranges::minmax(variant.points, {}, &CostPoint::rays);
        if (least.percent <= percent) return fmt::format("< {:.3f}", 1e-6 * least.rays);
        return fmt::format("> {:.3f}", 1e-6 * most.rays);
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
                             "seconds", "relative MSE", "beyond (%)", "worst"},
                            3, options.markdown);
    for (const auto& study : studies) study->run(points);
    fmt::print("\n");
    std::vector<std::string> columns = {"frame", "vision", "accuracy from"};
    for (const std::string& percent : options.percents) {
        columns.push_back(fmt::format("rays (M) at {} %", percent));
        columns.push_back("times fewer");
        columns.push_back("times faster");
    }
    const StudyTable summary(columns, 3, options.markdown);
    for (const auto& study : studies) study->summarize(summary);
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
    app.add_option("--accuracies", options.accuracies, "accuracies of every variant")
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
