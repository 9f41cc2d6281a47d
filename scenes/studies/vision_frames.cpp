#include "scenes/studies/vision_frames.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "engine/load/load_scene.h"
#include "scenes/studies/study_table.h"
#include "scenes/studies/vision_maps.h"

namespace aleph {

namespace {

/// Values of the pixels of one class in one frame.
struct ClassValues {
    std::string frame, speed;
    double percent = 0.0;         ///< of the frame's pixels
    std::vector<double> retinal;  ///< v_R, deg/s
    std::array<std::vector<double>, all_visions.size()> aleph, threshold;
};

std::vector<ClassValues> collect(const std::vector<std::string>& frames, const StudyOptions& options) {
    std::vector<ClassValues> all;
    for (const std::string& text : frames) {
        FrameOfScene which = parse_frame_of_scene(text);
        if (which.file.find_first_of("./") == std::string::npos) {
            which.file = fmt::format("scenes/{}/scene.json", which.file);
        }
        const Scene scene = load_scene(which.file);
        const std::int64_t number = which.frame.value_or(0);
        const VisionMaps maps = compute_vision_maps(scene, study_settings(scene, which.file, options), number);
        for (const SpeedClass& speed : speed_classes) {
            ClassValues values;
            for (std::size_t v = 0; v < all_visions.size(); ++v) {
                values.aleph[v] = pick_pixels(maps.aleph[v], maps.velocity, speed);
                values.threshold[v] = pick_pixels(maps.threshold[v], maps.velocity, speed);
            }
            if (values.aleph[0].empty()) continue;
            values.retinal = pick_pixels(maps.retinal, maps.velocity, speed);
            values.frame = fmt::format("{} {}", scene_name(which.file), number);
            values.speed = speed.name;
            values.percent =
                100.0 * static_cast<double>(values.aleph[0].size()) / static_cast<double>(maps.velocity.size());
            all.push_back(std::move(values));
        }
    }
    return all;
}

std::string quantiles(const std::vector<double>& values) {
    return fmt::format("{:.3g} / {:.3g} / {:.3g} / {:.3g}", quantile(values, 0.1), quantile(values, 0.5),
                       quantile(values, 0.9), quantile(values, 0.99));
}

std::string percent_below_one(const std::vector<double>& values) {
    const auto below = std::ranges::count_if(values, [](double value) { return value < 1.0; });
    return fmt::format("{:.1f}", 100.0 * static_cast<double>(below) / static_cast<double>(values.size()));
}

}  // namespace

void print_vision_frames(const std::vector<std::string>& frames, const StudyOptions& options, bool markdown) {
    const std::vector<ClassValues> all = collect(frames, options);
    fmt::print(
        "Maps of frames, {}, guide of the scene, by image velocity: slow is below 1, fast from 10 deg/s. Quantiles: 10 "
        "/ 50 / 90 / 99 % of the pixels.\n\naleph:\n\n",
        options.size);
    const StudyTable values({"frame", "pixels", "%", "v_R, deg/s", "thesis", "laird", "castle"}, 2, markdown);
    for (const ClassValues& c : all) {
        values.add({c.frame, c.speed, fmt::format("{:.1f}", c.percent), quantiles(c.retinal), quantiles(c.aleph[0]),
                    quantiles(c.aleph[1]), quantiles(c.aleph[2])});
    }
    fmt::print("\nPixel by pixel, over the thesis. Stricter is below 1:\n\n");
    const StudyTable compared({"frame", "pixels", "aleph, laird", "stricter, %", "rank correlation", "aleph, castle",
                               "stricter, %", "rank correlation", "threshold, castle", "stricter, %"},
                              2, markdown);
    for (const ClassValues& c : all) {
        const std::vector<double> laird = ratios(c.aleph[1], c.aleph[0]), castle = ratios(c.aleph[2], c.aleph[0]);
        const std::vector<double> threshold = ratios(c.threshold[2], c.threshold[0]);
        compared.add({c.frame, c.speed, quantiles(laird), percent_below_one(laird),
                      fmt::format("{:.2f}", rank_correlation(c.aleph[1], c.aleph[0])), quantiles(castle),
                      percent_below_one(castle), fmt::format("{:.2f}", rank_correlation(c.aleph[2], c.aleph[0])),
                      quantiles(threshold), percent_below_one(threshold)});
    }
    fmt::print("\n");
}

}  // namespace aleph
