#include "render/compare/compare_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"

namespace aleph {

namespace {

void add_to_summary(const FrameComparison& comparison, SequenceSummary& summary) {
    const CompareResult& result = comparison.result;
    if (summary.frames == 0 || result.all.max_abs > summary.max_abs) {
        summary.max_abs = result.all.max_abs;
        summary.worst_frame = comparison.frame;
    }
    ++summary.frames;
    summary.different += !comparison.same;
    summary.pixels += result.pixels();
    summary.beyond += result.beyond;
    summary.a.nan += result.a.nan;
    summary.a.inf += result.a.inf;
    summary.b.nan += result.b.nan;
    summary.b.inf += result.b.inf;
}

}  // namespace

SequenceComparison::SequenceComparison(CompareSettings settings, std::vector<std::int64_t> cuts, ReceiveVisible receive)
    : settings_(std::move(settings)), cuts_(std::move(cuts)), receive_(std::move(receive)) {}

void SequenceComparison::add(std::int64_t frame, const ChannelImage& a, const ChannelImage& b,
                             const SequenceMaps& maps) {
    ALEPH_CHECK(frames_.empty() || frames_.back().frame < frame, fmt::format("frame {}", frame));
    FrameComparison comparison{frame, compare_images(a, b, settings_, maps.threshold), std::nullopt, false};
    comparison.same = comparison.result.same;
    if (maps.threshold)
        threshold_.add(measure_error(compute_luminance_error(a, b), *maps.threshold->find("threshold.Y")));
    frames_.push_back(std::move(comparison));
    if (!maps.visible) return;
    if (!visible_) visible_.emplace(read_viewing(*maps.visible));
    const Image<float>* saliency = maps.visible->find("saliency.Y");
    saliency_[frame] = saliency ? *saliency : Image<float>{};
    const bool cut = std::ranges::find(cuts_, frame) != cuts_.end();
    take(visible_->add(frame, read_pair(a, b), read_motion(*maps.visible), cut));
}

void SequenceComparison::finish() {
    if (visible_) take(visible_->finish());
}

void SequenceComparison::take(const std::vector<VisibleMaps>& finished) {
    for (const VisibleMaps& maps : finished) {
        FrameComparison& frame = *std::ranges::find(frames_, maps.frame, &FrameComparison::frame);
        const auto saliency = saliency_.extract(maps.frame);
        VisibleCount count;
        for (VisibleCount* sum : {&count, &visible_count_})
            sum->add(maps, saliency.mapped().empty() ? nullptr : &saliency.mapped());
        frame.visible = count.shares();
        frame.same = frame.same && frame.visible->seen <= settings_.share;
        if (receive_) receive_(maps);
    }
}

SequenceSummary SequenceComparison::summary() const {
    SequenceSummary summary;
    double squares = 0.0, values = 0.0;
    for (const FrameComparison& frame : frames_) {
        const CompareResult& result = frame.result;
        add_to_summary(frame, summary);
        const auto count = static_cast<double>(result.pixels() * result.channels.size());
        values += count;
        squares += result.all.rms * result.all.rms * count;
        if (result.threshold) summary.threshold = {summarize(threshold_), result.threshold->display_white};
    }
    if (values > 0.0) summary.rms = std::sqrt(squares / values);
    if (visible_count_.pixels() > 0) summary.visible = visible_count_.shares();
    return summary;
}

}  // namespace aleph
