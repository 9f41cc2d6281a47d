#include "render/time/lighting_keyframes.h"

#include <algorithm>
#include <cmath>

namespace aleph {

namespace {

constexpr std::int64_t base_span = 10;  // steps, that share a base keyframe

/// a / b towards minus infinity, for b > 0.
std::int64_t divide_down(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

bool is_start(const LightingKeyframes& keyframes, std::int64_t frame) {
    return frame == keyframes.range.first || std::ranges::find(keyframes.cuts, frame) != keyframes.cuts.end();
}

/// Returns whether frame + 1 has another camera or lies outside of the range.
bool is_end(const LightingKeyframes& keyframes, std::int64_t frame) {
    return frame == keyframes.range.last || std::ranges::find(keyframes.cuts, frame + 1) != keyframes.cuts.end();
}

}  // namespace

KeyframePair find_keyframes(const LightingKeyframes& keyframes, std::int64_t frame) {
    const std::int64_t first = keyframes.range.first, step = keyframes.step;
    KeyframePair pair;
    pair.before = first + divide_down(frame - first, step) * step;
    pair.after = pair.before == frame ? frame : pair.before + step;
    const auto add = [&](std::int64_t keyframe) {
        if (keyframe <= frame) pair.before = std::max(pair.before, keyframe);
        if (keyframe >= frame) pair.after = std::min(pair.after, keyframe);
    };
    add(keyframes.range.last);
    for (const std::int64_t cut : keyframes.cuts) {
        add(cut - 1);
        add(cut);
    }
    if (keyframes.breaks && pair.after > pair.before + 1) {
        for (const std::int64_t jump : keyframes.breaks(pair.before, pair.after)) {
            add(jump - 1);
            add(jump);
        }
    }
    if (pair.after > pair.before) {
        pair.weight = static_cast<double>(frame - pair.before) / static_cast<double>(pair.after - pair.before);
    }
    return pair;
}

std::vector<std::int64_t> find_keyframe_views(const LightingKeyframes& keyframes, std::int64_t keyframe) {
    std::vector<std::int64_t> views{keyframe};
    if (!is_start(keyframes, keyframe)) views.push_back(find_keyframes(keyframes, keyframe - 1).before);
    if (!is_end(keyframes, keyframe)) views.push_back(find_keyframes(keyframes, keyframe + 1).after);
    return views;
}

std::int64_t find_base_keyframe(const LightingKeyframes& keyframes, std::int64_t keyframe) {
    const std::int64_t frame = std::clamp(keyframe, keyframes.range.first, keyframes.range.last);
    std::int64_t first = keyframes.range.first, end = keyframes.range.last + 1;
    for (const std::int64_t cut : keyframes.cuts) {
        if (cut <= frame) first = std::max(first, cut);
        if (cut > frame) end = std::min(end, cut);
    }
    const std::int64_t span = base_span * keyframes.step, parts = (end - first + span - 1) / span;
    const double part = static_cast<double>(end - first) / static_cast<double>(parts);
    const double middle = part * (std::floor(static_cast<double>(frame - first) / part) + 0.5);
    return find_keyframes(keyframes, first + static_cast<std::int64_t>(middle)).before;
}

}  // namespace aleph
