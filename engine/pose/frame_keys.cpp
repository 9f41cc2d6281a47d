#include "engine/pose/frame_keys.h"

#include "engine/base/errors.h"
#include "engine/pose/parts.h"

namespace aleph {

namespace {

constexpr std::size_t most_keys = 4000000;

/// @param linear  linear keys need them too, not only cubic ones
template <class T>
bool needs_keys(const Track<T>& track, bool linear) {
    const bool is_linear = track.interpolation == Interpolation::linear;
    return is_animated(track) && (track.interpolation == Interpolation::cubic || (linear && is_linear));
}

}  // namespace

void key_frames(Scene& scene) {
    const FrameRange range = frame_range(scene);
    const auto count = static_cast<std::size_t>(range.last - range.first) + 1;
    std::size_t keys = 0;
    const auto make = [&](const auto& value) {  // of a time in s
        if (count > most_keys - keys)
            throw InputError(scene.source.file, "", "a key at every frame: more than 4 million keys");
        keys += count;
        Track<decltype(value(0.0))> track({}, {});
        for (std::int64_t frame = range.first; frame <= range.last; ++frame) {
            track.sampling.times.push_back(scene.film.frame_rate.seconds_of(frame));
            track.values.push_back(value(track.sampling.times.back()));
        }
        return track;
    };
    const auto sample = [&](auto& track, bool linear) {
        if (needs_keys(track, linear)) track = make([&](double seconds) { return evaluate(track, seconds); });
    };
    for (Node& node : scene.nodes) {
        LocalTransform& local = node.transform;
        if (local.operations || local.matrix) continue;
        sample(local.translation, false);
        sample(local.scale, false);
        if (!local.axis_rotation) {
            sample(local.rotation, true);
        } else if (needs_keys(local.axis_rotation->angle, true)) {
            local.rotation = make([&](double seconds) { return rotation_at(*local.axis_rotation, seconds); });
            local.axis_rotation.reset();
        }
    }
}

}  // namespace aleph
