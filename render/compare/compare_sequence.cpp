#include "render/compare/compare_sequence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "engine/base/errors.h"
#include "render/compare/compare_luminance.h"

namespace aleph {

SequenceComparison::SequenceComparison(CompareSettings settings, std::vector<std::int64_t> cuts, ReceiveVisible receive)
    : settings_(std::move(settings)), cuts_(std::move(cuts)), receive_(std::move(receive)) {}

void SequenceComparison::add(std::int64_t frame, const ChannelImage& a, const ChannelImage& b,
                             const SequenceMaps& maps) {
    ALEPH_CHECK(frames_.empty() || frames_.back().frame < frame, fmt::format("frame {}", frame));
    FrameComparison comparison{frame, compare_images(a, b, settings_, maps.threshold), std::nullopt, false};
    comparison.same = comparison.result.same();
    if (maps.threshold) threshold_.add(compute_luminance_error(a, b), *maps.threshold->find("threshold.Y"));
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
        if (summary.frames == 0 || result.all.max_abs > summary.max_abs) {
            summary.max_abs = result.all.max_abs;
            summary.worst_frame = frame.frame;
        }
        ++summary.frames;
        summary.different += !frame.same;
        summary.pixels += result.pixels();
        summary.beyond += result.counted;
        summary.a.nan += result.a.nan;
        summary.a.inf += result.a.inf;
        summary.b.nan += result.b.nan;
        summary.b.inf += result.b.inf;
        const auto count = static_cast<double>(result.pixels() * result.channels.size());
        values += count;
        squares += result.all.rms * result.all.rms * count;
        if (result.threshold) summary.threshold = {summarize(threshold_), result.threshold->display_white};
    }
    if (values > 0.0) summary.rms = std::sqrt(squares / values);
    if (visible_count_.pixels() > 0) summary.visible = visible_count_.shares();
    return summary;
}

void VisibleCount::add(const VisibleMaps& maps, const Image<float>* saliency) {
    const auto count = [](const Image<float>& units) {
        return static_cast<std::size_t>(std::ranges::count_if(units.pixels, [](float value) { return value >= 1.0f; }));
    };
    pixels_ += maps.seen.size();
    seen_ += count(maps.seen);
    flicker_ += count(maps.flicker);
    lasting_ += count(maps.lasting);
    has_saliency_ = has_saliency_ && saliency && same_size(*saliency, maps.seen);
    if (!has_saliency_) return;
    for (std::size_t i = 0; i < maps.seen.size(); ++i) {
        looked_ += saliency->pixels[i];
        if (maps.seen.pixels[i] >= 1.0f) noticed_ += saliency->pixels[i];
    }
}

VisibleShares VisibleCount::shares() const {
    const auto percent = [&](std::size_t count) { return percent_of(static_cast<double>(count), pixels_); };
    VisibleShares shares{percent(seen_), percent(flicker_), percent(lasting_)};
    if (has_saliency_ && looked_ > 0.0) shares.noticed = 100.0 * noticed_ / looked_;
    return shares;
}

PicturePair read_pair(const ChannelImage& a, const ChannelImage& b) {
    PicturePair pair{linear_colour(a), linear_colour(b), read_noise(b)};
    if (pair.picture.empty() || pair.reference.empty())
        throw InputError("", "colour", "needs pictures with R, G and B");
    return pair;
}

}  // namespace aleph
