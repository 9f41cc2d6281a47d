#include "render/light_breaks.h"

#include <algorithm>

#include "engine/pose/parts.h"

namespace aleph {

namespace {

constexpr float max_change = 0.25f;  // from one frame to the next, of the largest value in the span

}  // namespace

/// What sends light in a frame, and what is there to receive it.
struct LightBreaks::Sources {
    std::vector<int> there;     ///< instances that can come or go: shown or not; nodes of the visible lamps
    std::vector<float> values;  ///< radiance and intensity, channel by channel

    void add(const Rgb& value) { values.insert(values.end(), {value.x, value.y, value.z}); }
};

LightBreaks::Sources LightBreaks::look(std::int64_t frame) {
    const double seconds = scene_.frame_rate.seconds_of(frame);
    if (!posed_) posed_ = pose(scene_, seconds);
    ScenePose& posed = *posed_;
    posed.seconds = seconds;
    for (const int node : plan_.nodes) place_node(scene_, node, seconds, posed);
    Sources sources;
    for (const int i : plan_.instances) sources.there.push_back(is_shown(scene_, posed, static_cast<std::size_t>(i)));
    for (const int m : plan_.materials) sources.add(pose_material(scene_.materials[m], seconds).emission);
    if (plan_.lights) {
        for (const int node : plan_.light_nodes) {
            if (posed.visible[node] == 0) continue;
            sources.there.push_back(node);
            sources.add(pose_light(scene_, node, posed.world[node], seconds).intensity);
        }
    }
    if (plan_.environment) {
        pose_environment(scene_, seconds, posed);
        sources.add(posed.environment);
    }
    return sources;
}

const std::vector<std::int64_t>& LightBreaks::find(std::int64_t first, std::int64_t last) {
    const auto [entry, is_new] = found_.try_emplace({first, last});
    if (!is_new) return entry->second;
    std::vector<Sources> frames;
    for (std::int64_t frame = first; frame <= last; ++frame) frames.push_back(look(frame));
    std::vector<float> largest(frames.front().values.size(), 0.0f);
    for (const Sources& sources : frames) {
        // With other lamps the lists differ in length: that is a jump by itself.
        for (std::size_t k = 0; k < std::min(largest.size(), sources.values.size()); ++k) {
            largest[k] = std::max(largest[k], sources.values[k]);
        }
    }
    for (std::size_t i = 1; i < frames.size(); ++i) {
        const Sources &before = frames[i - 1], &now = frames[i];
        bool jumps = before.there != now.there || before.values.size() != now.values.size();
        for (std::size_t k = 0; !jumps && k < std::min(largest.size(), now.values.size()); ++k) {
            jumps = std::abs(now.values[k] - before.values[k]) > max_change * largest[k];
        }
        if (jumps) entry->second.push_back(first + static_cast<std::int64_t>(i));
    }
    return entry->second;
}

}  // namespace aleph
