#include "render/study/seed_metrics.h"

#include "render/compare/compare_flicker.h"

namespace aleph {

namespace {

LuminanceError difference_of(const std::string& one, const std::string& other) {
    const ChannelImage picture = read_image(one);
    return compute_luminance_error(picture, expose_like(picture, read_image(other)));
}

bool follows(const JudgingFrame& next, const JudgingFrame& frame) {
    return next.scene == frame.scene && next.frame == frame.frame + 1;
}

/// Percent of the pixels, at rest and moving together; nothing if the maps have no motion.
std::optional<double> find_flicker(const LuminanceError& now, const LuminanceError& next, const JudgingFrame& frame,
                                   const JudgingFrame& next_frame) {
    const auto maps = make_flicker_maps(frame.maps);
    if (!maps) return std::nullopt;
    const Image<float>* objects = next_frame.maps.find("objectId.X");
    FlickerSum sum = measure_flicker(now, next, *maps, objects ? *objects : Image<float>());
    sum.rest.add(sum.moving);
    return summarize(sum.rest).percent_beyond();
}

void add_mean(const char* metric, VariantResult& variant) {
    std::vector<double> values;
    for (const FrameResult& frame : variant.frames) {
        const auto found = frame.metrics.find(metric);
        if (found != frame.metrics.end()) values.push_back(found->second.value);
    }
    if (!values.empty()) variant.metrics[metric] = {mean_of(values).value, std::nullopt};
}

}  // namespace

void add_seed_metrics(const std::vector<JudgingFrame>& frames, const std::vector<std::string>& one,
                      const std::vector<std::string>& other, VariantResult& variant) {
    LuminanceError before;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        LuminanceError now = difference_of(one.at(i), other.at(i));
        const ThresholdFigures figures = summarize(measure_error(now, frames[i].thresholds.front()));
        variant.frames.at(i).metrics["seed_difference"] = {figures.percent_beyond(), std::nullopt};
        if (i > 0 && follows(frames[i], frames[i - 1])) {
            if (const auto flicker = find_flicker(before, now, frames[i - 1], frames[i]))
                variant.frames[i - 1].metrics["seed_flicker"] = {*flicker, std::nullopt};
        }
        before = std::move(now);
    }
    add_mean("seed_difference", variant);
    add_mean("seed_flicker", variant);
}

}  // namespace aleph
