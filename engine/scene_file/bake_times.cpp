#include "engine/scene_file/bake_times.h"

#include <algorithm>
#include <cmath>

#include "engine/pose/pose.h"

namespace aleph {

BakedFrames find_baked_frames(const Scene& scene) {
    const FrameRange range = frame_range(scene);
    double before = 1.0, after = 1.0;
    for (const Camera& camera : scene.cameras) {
        before = std::max(before, std::ceil(-camera.shutter.x));
        after = std::max(after, std::ceil(camera.shutter.y));
    }
    constexpr double most = 1e9;
    return {scene.film.frame_rate, range.first - static_cast<std::int64_t>(std::min(before, most)),
            range.last + static_cast<std::int64_t>(std::min(after, most))};
}

std::vector<double> list_bake_times(const BakedFrames& frames, std::vector<double> keys,
                                    const std::function<void(std::size_t)>& charge) {
    constexpr double slack = 1e-6;  // frames
    const auto seconds_of = [&](std::int64_t frame) { return frames.rate.seconds_of(frame); };
    if (keys.empty()) return {seconds_of(frames.first)};
    std::sort(keys.begin(), keys.end());
    const double per_second = frames.rate.per_second();
    const auto within = [&](double frame) {
        return static_cast<std::int64_t>(
            std::clamp(frame, static_cast<double>(frames.first) - 1.0, static_cast<double>(frames.last) + 1.0));
    };
    const std::int64_t first = std::max(frames.first, within(std::ceil(keys.front() * per_second - slack)));
    const std::int64_t last = std::min(frames.last, within(std::floor(keys.back() * per_second + slack)));
    const std::size_t count = last < first ? 0 : static_cast<std::size_t>(last - first) + 1;
    charge(std::min(count, std::size_t{1} << 40));
    std::vector<double> times;
    for (std::int64_t frame = first; frame <= last; ++frame) times.push_back(seconds_of(frame));
    for (const double key : keys) {
        const bool inside = key > seconds_of(frames.first) && key < seconds_of(frames.last);
        const double frame = key * per_second;
        if (inside && std::abs(frame - std::round(frame)) > slack) times.push_back(key);
    }
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
    if (times.empty()) times.push_back(seconds_of(frames.first));
    return times;
}

}  // namespace aleph
