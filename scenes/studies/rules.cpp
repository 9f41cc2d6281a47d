// Whether stopping makes a picture wrong on average: every stopping rule, rendered with many seeds, against uniform
// sampling with many samples.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/frame/sequence.h"
#include "render/settings/setting_table.h"
#include "scenes/studies/seed_means.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"

namespace aleph {

namespace {

struct RuleOptions {
    StudyOptions study{.size = "64x48", .gather = 0, .spp = 0};
    std::vector<std::string> rules, errors;
    std::vector<std::string> sets = {"accuracy=0", "gather=8", "light_samples=1"};
    int frame = 0, spp = 256, seeds = 16, reference_spp = 1024, reference_seeds = 8;
    bool markdown = false;
};

/// What all seeds of one rule gave.
struct RuleMeans {
    SeedMean whole, in_thresholds;  ///< mean luminance in cd/m2, mean of luminance over threshold
    std::vector<SeedMean> blocks;
    double samples = 0.0, seconds = 0.0;  ///< per pixel, per picture
};

std::vector<std::string> list_rules() {
    const auto& table = setting_table();
    const auto found = std::ranges::find(table, "sampling", &Setting::key);
    return found == table.end() ? std::vector<std::string>{} : found->choices;
}

class RuleStudy {
  public:
    RuleStudy(const Scene& scene, const RenderSettings& settings, const RuleOptions& options)
        : scene_(scene), settings_(settings), options_(options) {
        Sequence viewer = make_vision_sequence(scene, settings, Guide::saliency, settings.perception.vision);
        per_threshold_ = compute_vision(viewer, options.frame).threshold;
        for (float& value : per_threshold_.pixels) value = 1.0f / std::max(value, 1e-6f);
    }

    RuleMeans render(const std::string& name, RenderSettings settings, int seeds, std::uint32_t first_seed) const {
        Progress progress(name, seeds, progress_look(options_.study.quiet));
        std::vector<PictureSums> sums;
        std::vector<double> whole, in_thresholds;
        RuleMeans out;
        for (int i = 0; i < seeds; ++i) {
            settings.seed = first_seed + static_cast<std::uint32_t>(i);
            Sequence sequence(scene_, settings);
            const double start = processor_seconds();
            const FrameOutput frame = sequence.render(options_.frame);
            out.seconds += (processor_seconds() - start) / seeds;
            out.samples += mean_samples(frame) / seeds;
            Image<double> light(settings.width, settings.height);
            for (std::size_t p = 0; p < light.size(); ++p)
                light.pixels[p] = scene_.viewing.display_white * luminance(frame.shaded.color.pixels[p]);
            sums.push_back(sum_picture(light, {}));
            whole.push_back(sums.back().whole);
            in_thresholds.push_back(sum_picture(light, per_threshold_).whole);
            progress.update(i + 1.0);
        }
        out.whole = mean_of_seeds(whole);
        out.in_thresholds = mean_of_seeds(in_thresholds);
        for (std::size_t block = 0; block < sums.front().blocks.size(); ++block) {
            std::vector<double> values;
            for (const PictureSums& sum : sums) values.push_back(sum.blocks[block]);
            out.blocks.push_back(mean_of_seeds(values));
        }
        return out;
    }

    RuleMeans render_reference() const {
        RenderSettings settings = with_choice(settings_, "sampling", "uniform");
        settings.spp = options_.reference_spp;
        constexpr std::uint32_t reference_seeds = 0x72756c65u;  // apart from those of the rules
        return render("reference", settings, options_.reference_seeds, reference_seeds);
    }

  private:
    static double mean_samples(const FrameOutput& frame) {
        const std::vector<float>& samples = frame.shaded.samples.pixels;
        return std::accumulate(samples.begin(), samples.end(), 0.0) / static_cast<double>(samples.size());
    }

    const Scene& scene_;
    RenderSettings settings_;
    const RuleOptions& options_;
    Image<float> per_threshold_;
};

void add_rule(const StudyTable& table, const std::string& name, const RuleMeans& rule, const RuleMeans& reference) {
    double worst = 0.0;
    int beyond = 0;
    for (std::size_t i = 0; i < rule.blocks.size(); ++i) {
        const double deviation = std::abs(deviation_between(rule.blocks[i], reference.blocks[i]));
        worst = std::max(worst, deviation);
        beyond += deviation > 3.0;
    }
    const double difference = rule.whole.mean - reference.whole.mean;
    table.add(
        {name, fmt::format("{:.1f}", rule.samples), fmt::format("{:.2f}", rule.seconds),
         fmt::format("{:+.3f}", 100.0 * difference / reference.whole.mean),
         fmt::format("{:.3f}", 100.0 * std::hypot(rule.whole.error, reference.whole.error) / reference.whole.mean),
         fmt::format("{:+.2f}", deviation_between(rule.whole, reference.whole)),
         fmt::format("{:+.4f}", rule.in_thresholds.mean - reference.in_thresholds.mean),
         fmt::format("{:+.2f}", deviation_between(rule.in_thresholds, reference.in_thresholds)),
         fmt::format("{:.2f}", worst), fmt::format("{}", beyond)});
}

void run_rules(const RuleOptions& options) {
    if (options.seeds < 2 || options.reference_seeds < 2) throw InputError("", "--seeds", "expected at least 2");
    const Scene scene = load_scene(options.study.scene);
    RenderSettings settings = scene_settings(scene, options.study.scene, options.study.size, options.sets);
    settings.spp = options.spp;
    const RuleStudy study(scene, settings, options);
    const RuleMeans reference = study.render_reference();
    fmt::print("{}, frame {}, {}, {}; {} seeds of each rule, at most {} samples; the reference has {} times {}\n\n",
               options.study.scene, options.frame, options.study.size, fmt::join(options.sets, ", "), options.seeds,
               options.spp, options.reference_seeds, options.reference_spp);
    const StudyTable table({"rule", "samples", "seconds", "bias (%)", "error (%)", "in errors", "in thresholds",
                            "in errors", "worst block", "beyond 3"},
                           1, options.markdown);
    for (const std::string& rule : options.rules.empty() ? list_rules() : options.rules) {
        const RenderSettings chosen = with_choice(settings, "sampling", rule);
        add_rule(table, rule, study.render(rule, chosen, options.seeds, 1), reference);
    }
    for (const std::string& error : has_setting("error") ? options.errors : std::vector<std::string>{}) {
        std::vector<std::string> sets = options.sets;
        sets.push_back("error=" + error);
        const RenderSettings chosen = with_settings(settings, sets);
        add_rule(table, "--error " + error, study.render("--error " + error, chosen, options.seeds, 1), reference);
    }
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Renders a frame with every stopping rule and many seeds, and prints the bias of the mean luminance against "
        "uniform sampling: in percent, in standard errors, in thresholds of the viewer, and of the worst of 4x4 blocks "
        "of the picture in standard errors. By default every sample gathers its indirect light, so that no cache is "
        "in the way."};
    aleph::RuleOptions options;
    aleph::add_scene_option(app, options.study);
    aleph::add_value(app, "--frame", options.frame, "frame number");
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frame in pixels")->capture_default_str();
    app.add_option("--rules", options.rules, "values of the setting sampling; all if none are given")->delimiter(',');
    app.add_option("--errors", options.errors, "values of the setting error, in addition")->delimiter(',');
    aleph::add_value(app, "--spp", options.spp, "samples per pixel of uniform sampling, and the most of every rule");
    aleph::add_value(app, "--seeds", options.seeds, "renderings of every rule");
    aleph::add_value(app, "--reference-spp", options.reference_spp, "samples per pixel of the reference");
    aleph::add_value(app, "--reference-seeds", options.reference_seeds, "renderings of the reference");
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    aleph::add_quiet_option(app, options.study);
    aleph::add_set_option(app, options.sets);
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_rules(options); });
}
