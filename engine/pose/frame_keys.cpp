#include "engine/pose/frame_keys.h"

#include <cmath>

#include "engine/base/errors.h"
#include "engine/pose/pose.h"
#include "engine/scene/transforms.h"

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
            if (is_cubic(local.translation)) sample(local.translation);
            if (is_cubic(local.scale)) sample(local.scale);
            if (local.axis_rotation) {
                sample_turns(local);
            } else if (interpolates(local.rotation)) {
                sample(local.rotation);
            }
        }
    }

  private:
    template <class T>
    static bool interpolates(const Track<T>& track) {
        return is_animated(track) &&
               (track.interpolation == Interpolation::linear || track.interpolation == Interpolation::cubic);
    }
    template <class T>
    static bool is_cubic(const Track<T>& track) {
        return is_animated(track) && track.interpolation == Interpolation::cubic;
    }

    void sample_turns(LocalTransform& local) {
        const AxisRotation turn = *local.axis_rotation;
        if (!interpolates(turn.angle)) return;
        const glm::dvec3 axis = safe_normalize(turn.axis);
        local.rotation = make([&](double seconds) {
            const double half = 0.5 * evaluate(turn.angle, seconds);
            return glm::dquat(std::cos(half), axis * std::sin(half));
        });
        local.axis_rotation.reset();
    }

    template <class T>
    void sample(Track<T>& track) {
        const Track<T> given = track;
        track = make([&](double seconds) { return evaluate(given, seconds); });
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
