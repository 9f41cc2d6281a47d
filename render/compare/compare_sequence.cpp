#include "render/compare/compare_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

SequenceComparison::SequenceComparison(CompareSettings settings, std::vector<std::int64_t> cuts)
    : settings_(std::move(settings)), cuts_(std::move(cuts)) {}

FrameComparison SequenceComparison::add(std::int64_t frame, const ChannelImage& a, const ChannelImage& b,
                                        const ChannelImage* maps) {
    ALEPH_CHECK(!last_ || last_->frame < frame, fmt::format("frame {}", frame));
    FrameComparison comparison{frame, compare_images(a, b, settings_, maps), std::nullopt, false};
    if (maps) {
        LuminanceError error = compute_luminance_error(a, b);
        threshold_.add(measure_error(error, *maps->find("threshold.Y")));
        std::optional<FlickerMaps> motion = make_flicker_maps(*maps);
        comparison.flicker = follow(frame, error, motion);
        last_.reset();
        if (motion) last_ = Last{frame, std::move(error), std::move(*motion)};
    }
    comparison.same =
        comparison.result.same && (!comparison.flicker || comparison.flicker->percent_beyond() <= settings_.share);
    add_to_summary(comparison);
    return comparison;
}

std::optional<FlickerFigures> SequenceComparison::follow(std::int64_t frame, const LuminanceError& error,
                                                         const std::optional<FlickerMaps>& maps) {
    const bool cut = std::ranges::find(cuts_, frame) != cuts_.end();
    if (!last_ || last_->frame + 1 != frame || cut) return std::nullopt;
    const FlickerSum sum = measure_flicker(last_->error, error, last_->maps, maps ? maps->object : Image<float>{});
    flicker_.add(sum);
    own_threshold_ = own_threshold_ && last_->maps.own_threshold;
    ++summary_.flicker_pairs;
    return summarize(sum, last_->maps.own_threshold);
}

void SequenceComparison::add_to_summary(const FrameComparison& comparison) {
    const CompareResult& result = comparison.result;
    if (summary_.frames == 0 || result.all.max_abs > summary_.max_abs) {
        summary_.max_abs = result.all.max_abs;
        summary_.worst_frame = comparison.frame;
    }
    ++summary_.frames;
    summary_.different += !comparison.same;
    summary_.pixels += result.pixels();
    summary_.beyond += result.beyond;
    summary_.a.nan += result.a.nan;
    summary_.a.inf += result.a.inf;
    summary_.b.nan += result.b.nan;
    summary_.b.inf += result.b.inf;
    const std::size_t values = result.pixels() * result.channels.size();
    values_ += values;
    squares_ += result.all.rms * result.all.rms * static_cast<double>(values);
    if (result.threshold) {
        if (!summary_.threshold) summary_.threshold.emplace();
        summary_.threshold->display_white = result.threshold->display_white;
    }
}

SequenceSummary SequenceComparison::summary() const {
    SequenceSummary summary = summary_;
    if (values_ > 0) summary.rms = std::sqrt(squares_ / static_cast<double>(values_));
    if (summary.threshold) *summary.threshold = {summarize(threshold_), summary.threshold->display_white};
    if (summary.flicker_pairs > 0) summary.flicker = summarize(flicker_, own_threshold_);
    return summary;
}

}  // namespace aleph
