#include "render/time/lighting_keyframes.h"

#include <algorithm>
#include <cmath>

#include "engine/pose/parts.h"
#include "engine/pose/steady.h"

namespace aleph {

namespace {

constexpr std::int64_t base_span = 10;  // steps, that share a base keyframe

/// a / b towards minus infinity, for b > 0.
std::int64_t divide_down(std::int64_t a, std::int64_t b) {
    return a / b - (a % b < 0 ? 1 : 0);
}

constexpr float max_change = 0.25f;  // from one frame to the next, of the largest value in the span

bool differ_by(const std::vector<float>& a, const std::vector<float>& b, const std::vector<float>& largest) {
    for (std::size_t k = 0; k < largest.size(); ++k) {
        if (std::abs(a[k] - b[k]) > max_change * largest[k]) return true;
    }
    return false;
}

void raise_to(std::vector<float>& largest, const std::vector<float>& values) {
    for (std::size_t k = 0; k < largest.size(); ++k) largest[k] = std::max(largest[k], values[k]);
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
    const auto begins_shot = [&cuts = keyframes.cuts](std::int64_t frame) {
        return std::ranges::find(cuts, frame) != cuts.end();
    };
    if (keyframe != keyframes.range.first && !begins_shot(keyframe))
        views.push_back(find_keyframes(keyframes, keyframe - 1).before);
    if (keyframe != keyframes.range.last && !begins_shot(keyframe + 1))
        views.push_back(find_keyframes(keyframes, keyframe + 1).after);
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

/// Sources of light in a frame, and the objects that are there to receive it.
struct LightBreaks::Sources {
    std::vector<int> there;     ///< instances that can come or go, and lamps: shown or not
    std::vector<float> values;  ///< radiance, intensity by channel, range and cone of lamps; 0 of those not shown

    void add(const Rgb& value) { values.insert(values.end(), {value.x, value.y, value.z}); }
};

LightBreaks::Sources LightBreaks::look(double seconds) {
    if (!posed_) posed_ = pose(scene_, seconds);
    ScenePose& posed = *posed_;
    posed.seconds = seconds;
    for (const int node : plan_.nodes) place_node(scene_, node, seconds, posed);
    Sources sources;
    for (const int i : plan_.instances) sources.there.push_back(is_shown(scene_, posed, static_cast<std::size_t>(i)));
    for (const int m : plan_.materials) sources.add(pose_material(scene_.materials[m], seconds).emission);
    if (plan_.lights) {
        const LightValues dark{.intensity = Rgb(0.0f)};
        for (const int node : plan_.light_nodes) {
            const bool shown = posed.visible[node] != 0;
            const LightValues light = shown ? pose_light(scene_, node, posed.world[node], seconds) : dark;
            sources.there.push_back(shown);
            sources.add(light.intensity);
            sources.values.push_back(static_cast<float>(light.range));
            sources.values.push_back(light.kind == Light::Kind::spot ? static_cast<float>(light.outer_cone) : 0.0f);
        }
    }
    if (plan_.environment) {
        pose_environment(scene_.environment, seconds, posed);
        sources.add(posed.environment);
    }
    return sources;
}

const std::vector<std::int64_t>& LightBreaks::find(std::int64_t first, std::int64_t last) {
    const auto [entry, is_new] = found_.try_emplace({first, last});
    if (!is_new) return entry->second;
    std::vector<Sources> frames;
    for (std::int64_t frame = first; frame <= last; ++frame) frames.push_back(look(seconds_(frame)));
    std::vector<float> largest(frames.front().values.size(), 0.0f);
    for (const Sources& sources : frames) raise_to(largest, sources.values);
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Sources &before = frames[i - 1], &now = frames[i];
        if (before.there != now.there || differ_by(before.values, now.values, largest)) {
            entry->second.push_back(first + static_cast<std::int64_t>(i));
        }
    }
    return entry->second;
}

bool LightBreaks::changes(double open, double close) {
    constexpr int looks = 9;
    const double rate = scene_.film.frame_rate.per_second(), from = open / rate, to = close / rate;
    std::vector<double> times = find_key_times(scene_, from, to);
    for (int i = 1; i < looks; ++i) times.push_back(from + (to - from) * i / (looks - 1));
    const Sources first = look(from);
    std::vector<float> largest = first.values, smallest = first.values;
    for (const double seconds : times) {
        const Sources now = look(seconds);
        if (now.there != first.there) return true;
        raise_to(largest, now.values);
        for (std::size_t k = 0; k < smallest.size(); ++k) smallest[k] = std::min(smallest[k], now.values[k]);
    }
    return differ_by(smallest, largest, largest);
}

}  // namespace aleph
