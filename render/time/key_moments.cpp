#include "render/time/key_moments.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr std::int64_t base_span = 10;  // steps, that share a base moment

/// a / b towards minus infinity, for b > 0.
std::int64_t divide_down(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

bool is_start(const KeyMoments& moments, std::int64_t frame) {
    return frame == moments.range.first || std::ranges::find(moments.cuts, frame) != moments.cuts.end();
}

/// Whether frame + 1 has another camera or lies outside of the range.
bool is_end(const KeyMoments& moments, std::int64_t frame) {
    return frame == moments.range.last || std::ranges::find(moments.cuts, frame + 1) != moments.cuts.end();
}

}  // namespace

MomentPair find_moments(const KeyMoments& moments, std::int64_t frame) {
    const std::int64_t first = moments.range.first, step = moments.step;
    MomentPair pair;
    pair.before = first + divide_down(frame - first, step) * step;
    pair.after = pair.before == frame ? frame : pair.before + step;
    const auto add = [&](std::int64_t moment) {
        if (moment <= frame) pair.before = std::max(pair.before, moment);
        if (moment >= frame) pair.after = std::min(pair.after, moment);
    };
    add(moments.range.last);
    for (const std::int64_t cut : moments.cuts) {
        add(cut - 1);
        add(cut);
    }
    if (moments.breaks && pair.after > pair.before + 1) {
        for (const std::int64_t jump : moments.breaks(pair.before, pair.after)) {
            add(jump - 1);
            add(jump);
        }
    }
    if (pair.after > pair.before) {
        pair.weight = static_cast<double>(frame - pair.before) / static_cast<double>(pair.after - pair.before);
    }
    return pair;
}

std::vector<std::int64_t> find_moment_views(const KeyMoments& moments, std::int64_t moment) {
    std::vector<std::int64_t> views{moment};
    if (!is_start(moments, moment)) views.push_back(find_moments(moments, moment - 1).before);
    if (!is_end(moments, moment)) views.push_back(find_moments(moments, moment + 1).after);
    return views;
}

std::int64_t find_base_moment(const KeyMoments& moments, std::int64_t moment) {
    const std::int64_t frame = std::clamp(moment, moments.range.first, moments.range.last);
    std::int64_t first = moments.range.first, end = moments.range.last + 1;
    for (const std::int64_t cut : moments.cuts) {
        if (cut <= frame) first = std::max(first, cut);
        if (cut > frame) end = std::min(end, cut);
    }
    const std::int64_t span = base_span * moments.step, parts = (end - first + span - 1) / span;
    const double part = static_cast<double>(end - first) / static_cast<double>(parts);
    const double middle = part * (std::floor(static_cast<double>(frame - first) / part) + 0.5);
    return find_moments(moments, first + static_cast<std::int64_t>(middle)).before;
}

}  // namespace aleph
