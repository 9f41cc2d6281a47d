#include "render/frame/static_spans.h"
#include <algorithm>

#include "render/settings/measure.h"
#include "render/time/shutter.h"

namespace aleph {

namespace {

/// When a frame is looked at, from the opening of the shutter to its closing, s.
struct TimeSpan {
    double from = 0.0, to = 0.0;
};

TimeSpan find_time_span(const Scene& scene, const glm::dvec2& relative, std::int64_t frame) {
    const double center = find_shutter_center(scene, relative, frame);
    const std::optional<ShutterInterval> shutter = find_shutter(scene, relative, frame);
    if (!shutter) return {center, center};
    const double per_second = scene.film.frame_rate.per_second();
    return {std::min(center, shutter->open / per_second), std::max(center, shutter->close / per_second)};
}

}  // namespace

StaticSpans::StaticSpans(const Scene& scene, const PosePlan& plan, const std::vector<CameraShot>& shots,
                         std::function<glm::dvec2(std::int64_t frame)> shutter)
    : scene_(scene), shots_(shots), shutter_(std::move(shutter)), range_(frame_range(scene)), spans_(scene, plan) {}

/// Returns whether nothing changes from one frame to another, and no cut lies between them.
bool StaticSpans::is_static(std::int64_t first, std::int64_t last) const {
    const auto lies_between = [&](std::int64_t cut) { return first < cut && cut <= last; };
    if (std::ranges::any_of(scene_.film.cuts, lies_between)) return false;
    if (spans_.is_always_steady()) return true;
    const TimeSpan a = find_time_span(scene_, shutter_(first), first), b = find_time_span(scene_, shutter_(last), last);
    return spans_.is_steady(camera_at(shots_, first), std::min(a.from, b.from), std::max(a.to, b.to));
}

/// The earliest frame from which on nothing changes up to `end`, if nothing does from `frame` to it.
/// @param limit  holds do not reach beyond it
std::int64_t StaticSpans::search_first(std::int64_t frame, std::int64_t end, std::int64_t limit) const {
    std::int64_t known = frame, step = 1;  // `known` is in the static span
    while (known > limit && is_static(std::max(limit, known - step), end)) {
        known = std::max(limit, known - step);
        step *= 2;
    }
    for (; step > 0; step /= 2) {
        if (known - step >= limit && is_static(known - step, end)) known -= step;
    }
    return known;
}

std::int64_t StaticSpans::find_first(std::int64_t frame) {
    if (spans_.is_always_steady() && scene_.film.cuts.empty()) return range_.first;
    if (frame < range_.first) return frame;
    // The frame with which this one has its motion; the last frame of a range has it with the one before it.
    const bool is_last = frame == range_.last && range_.last > range_.first;
    const std::int64_t begin = is_last ? frame - 1 : frame, end = begin + 1;
    if (first_ <= begin && end <= last_) return first_;
    if (!is_static(begin, end)) return frame;
    const std::int64_t limit = begin > range_.last ? range_.last + 1 : range_.first;
    const bool goes_on = begin == last_ && first_ < last_ && first_ >= limit;
    if (!goes_on) first_ = search_first(begin, end, limit);
    last_ = end;
    return first_;
}

std::optional<FrameOutput> StaticFrame::copy(std::int64_t first, const FrameRequest& request) const {
    if (!output_ || first_ != first || frame_ != request.frame || maps_ != request.maps ||
        output_->statistics.window != request.window)
        return std::nullopt;
    std::optional<FrameOutput> copy = output_;
    copy->statistics.peak_memory_mib = peak_memory_mib();
    return copy;
}

void StaticFrame::keep(std::int64_t first, const FrameRequest& request, const FrameOutput& output) {
    first_ = first;
    frame_ = request.frame;
    maps_ = request.maps;
    output_ = output;
    FrameStatistics& statistics = output_->statistics;
    statistics.seconds = {};
    statistics.counts = {};
    statistics.traced = {};
    statistics.instances_touched = 0;
    statistics.keyframes.clear();
}

}  // namespace aleph
