#include "engine/pose/frame_keys.h"

#include "engine/base/errors.h"
#include "engine/pose/parts.h"

namespace aleph {

namespace {

constexpr std::size_t most_keys = 4000000;

class FrameKeys {
  public:
    explicit FrameKeys(Scene& scene) : scene_(scene), range_(frame_range(scene)) {}

    void add() {
        for (Node& node : scene_.nodes) {
            LocalTransform& local = node.transform;
            if (local.operations || local.matrix) continue;
            if (needs_keys(local.translation, false)) sample(local.translation);
            if (needs_keys(local.scale, false)) sample(local.scale);
            if (local.axis_rotation) {
                if (!needs_keys(local.axis_rotation->angle, true)) continue;
                local.rotation = make([&](double seconds) { return rotation_at(*local.axis_rotation, seconds); });
                local.axis_rotation.reset();
            } else if (needs_keys(local.rotation, true)) {
                sample(local.rotation);
            }
        }
    }

  private:
    /// @param linear  linear keys need them too, not only cubic ones
    template <class T>
    static bool needs_keys(const Track<T>& track, bool linear) {
        const bool is_linear = track.interpolation == Interpolation::linear;
        return is_animated(track) && (track.interpolation == Interpolation::cubic || (linear && is_linear));
    }

    template <class T>
    void sample(Track<T>& track) {
        track = make([given = track](double seconds) { return evaluate(given, seconds); });
    }

    /// @param value  from a time in s
    template <class Function>
    auto make(const Function& value) -> Track<decltype(value(0.0))> {
        Track<decltype(value(0.0))> track;
        track.sampling.kind = TimeSampling::Kind::acyclic;
        const auto count = static_cast<std::uint64_t>(range_.last - range_.first) + 1;
        if (count > most_keys - keys_)
            throw InputError(scene_.source.file, "", "a key at every frame: more than 4 million keys");
        keys_ += count;
        for (std::int64_t frame = range_.first; frame <= range_.last; ++frame) {
            track.sampling.times.push_back(scene_.film.frame_rate.seconds_of(frame));
            track.values.push_back(value(track.sampling.times.back()));
        }
        return track;
    }

    Scene& scene_;
    const FrameRange range_;
    std::size_t keys_ = 0;
};

}  // namespace

void key_frames(Scene& scene) {
    FrameKeys(scene).add();
}

}  // namespace aleph
