// How much of a picture is chance: consecutive frames, rendered twice with seeds of their own. Differences and their
// change from frame to frame, along the motion of what is shown, in thresholds of the viewer.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <numbers>

#include "engine/base/errors.h"
#include "engine/load/load_scene.h"
#include "render/cli/options.h"
#include "render/cli/progress.h"
#include "render/compare/compare_flicker.h"
#include "render/frame/sequence.h"
#include "render/output/frame_files.h"
#include "render/settings/frame_list.h"
#include "render/study/picture_error.h"
#include "scenes/studies/study_frame.h"
#include "scenes/studies/study_options.h"
#include "scenes/studies/study_table.h"
#include "scenes/studies/threshold_maps.h"

namespace aleph {

namespace {

struct SeedsOptions {
    StudyOptions study{.size = "320x240", .gather = 0, .spp = 0};
    std::string frames = "20-29", error = "1";
    std::vector<std::string> sets;
    bool markdown = false;
};

/// A frame in two renderings, and the maps that say what is seen of their difference.
struct FramePair {
    LuminanceError difference;
    ChannelImage maps;
    double mean_samples = 0.0, seconds = 0.0;  ///< of both renderings: their mean, their sum
};

/// Two pictures differ by sqrt 2 times the noise of one: with so much larger a threshold, a share is that of one
/// picture.
constexpr double of_one = std::numbers::sqrt2;

ThresholdFigures find_differences(const FramePair& frame, double thresholds) {
    return summarize(measure_error(frame.difference, scaled(*frame.maps.find("threshold.Y"), thresholds)));
}

/// Changes of the difference, at rest and moving together.
/// @param threshold  channel of the maps
ThresholdFigures find_changes(const FramePair& now, const FramePair& next, const char* threshold, double thresholds) {
    auto maps = make_flicker_maps(now.maps);
    if (!maps) throw InputError("", "--frames", "the maps of these frames have no motion");
    maps->threshold = scaled(*now.maps.find(threshold), thresholds);
    FlickerSum sum = measure_flicker(now.difference, next.difference, *maps, *next.maps.find("objectId.X"));
    sum.rest.add(sum.moving);
    return summarize(sum.rest);
}

double mean_of(const Image<float>& image) {
    double sum = 0.0;
    for (const float value : image.pixels) sum += value;
    return sum / static_cast<double>(image.size());
}

class TwoSeeds {
  public:
    TwoSeeds(const Scene& scene, RenderSettings settings)
        : settings_(settings), one_(scene, settings), other_(scene, (++settings.seed, settings)) {}

    FramePair render(std::int64_t frame, ChannelImage maps) {
        const double start = processor_seconds();
        const FrameOutput a = one_.render(frame), b = other_.render(frame);
        FramePair pair{{}, std::move(maps), 0.5 * (mean_of(a.shaded.samples) + mean_of(b.shaded.samples)), 0.0};
        pair.seconds = processor_seconds() - start;
        pair.difference = compute_luminance_error(picture(one_, a), picture(other_, b));
        return pair;
    }

  private:
    ChannelImage picture(const Sequence& sequence, const FrameOutput& output) const {
        return make_frame_image(output, false, sequence.scene(), settings_, sequence.exposure());
    }

    RenderSettings settings_;
    Sequence one_, other_;
};

std::vector<FramePair> render_pairs(const Scene& scene, const RenderSettings& settings, const FrameRange& range,
                                    bool quiet) {
    std::vector<ChannelImage> maps = compute_threshold_maps(scene, settings, range);
    TwoSeeds seeds(scene, settings);
    Progress progress("two seeds", static_cast<double>(maps.size()), progress_look(quiet));
    std::vector<FramePair> frames;
    for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
        frames.push_back(seeds.render(frame, std::move(maps[frames.size()])));
        progress.update(static_cast<double>(frames.size()));
    }
    return frames;
}

std::vector<std::string> cells_of(const ThresholdFigures& two, const ThresholdFigures& one) {
    return {fmt::format("{:.3f}", two.percent_beyond()), fmt::format("{:.3f}", one.percent_beyond()),
            fmt::format("{:.2f}", two.percentile_99), fmt::format("{:.1f}", two.worst)};
}

void run_seeds(const SeedsOptions& options) {
    const std::vector<int> list = parse_frame_list(options.frames);
    const FrameRange range{list.front(), list.back()};
    if (static_cast<std::int64_t>(list.size()) != range.last - range.first + 1)
        throw InputError("", "--frames", "expected consecutive frames");
    const Scene scene = load_scene(options.study.scene);
    const double error = parse_value<double>(options.error, "--error");
    const bool asked = has_setting("error") && error > 0.0;
    std::vector<std::string> sets = options.sets;
    if (asked) sets.push_back("error=" + options.error);
    const RenderSettings settings = scene_settings(scene, options.study.scene, options.study.size, sets);
    const double thresholds = error > 0.0 ? error : 1.0;
    const std::vector<FramePair> frames = render_pairs(scene, settings, range, options.study.quiet);

    fmt::print("{}, {}, {}; percent of the pixels beyond {:g} thresholds of {}\n\n", options.study.scene,
               options.study.size, asked ? "error " + options.error : std::string("settings of the scene"), thresholds,
               std::get<std::string>(setting_map(settings).at("vision")));
    const StudyTable table({"frame", "difference", "of one", "99 %", "worst", "flicker", "of one", "99 %", "worst",
                            "change", "samples", "seconds"},
                           0, options.markdown);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        std::vector<std::string> cells = {fmt::format("{}", list[i])};
        const auto add = [&](const std::vector<std::string>& more) {
            cells.insert(cells.end(), more.begin(), more.end());
        };
        add(cells_of(find_differences(frames[i], thresholds), find_differences(frames[i], of_one * thresholds)));
        if (i + 1 < frames.size()) {
            const auto changes = [&](const char* threshold, double of) {
                return find_changes(frames[i], frames[i + 1], threshold, of);
            };
            add(cells_of(changes("threshold.flicker", thresholds), changes("threshold.flicker", of_one * thresholds)));
            add({fmt::format("{:.3f}", changes("threshold.Y", thresholds).percent_beyond())});
        } else {
            add({"-", "-", "-", "-", "-"});
        }
        add({fmt::format("{:.1f}", frames[i].mean_samples), fmt::format("{:.2f}", frames[i].seconds)});
        table.add(cells);
    }
}

}  // namespace
}  // namespace aleph

int main(int argc, char** argv) {
    CLI::App app{
        "Renders consecutive frames twice, with two seeds, and prints the share of pixels whose difference is beyond "
        "the threshold, and whose difference changes by more than the threshold of flicker until the next frame, at "
        "the same point of the surface; column \"change\" compares that with the threshold itself. Columns \"of one\" "
        "compare with sqrt 2 thresholds: the noise of one picture."};
    aleph::SeedsOptions options;
    aleph::add_scene_option(app, options.study);
    app.add_option("--frames", options.frames, "consecutive frames")->capture_default_str();
    app.add_option("--error", options.error, "error to ask for; 0: the settings of the scene")->capture_default_str();
    app.add_option("--size", options.study.size, "WIDTHxHEIGHT of the frames in pixels")->capture_default_str();
    aleph::add_value(app, "-t,--threads", options.study.threads, "number of threads; 0: all");
    aleph::add_quiet_option(app, options.study);
    aleph::add_set_option(app, options.sets);
    app.add_flag("--markdown", options.markdown, "print the table as Markdown");
    return aleph::run_study(app, options.study, argc, argv, [&] { aleph::run_seeds(options); });
}
