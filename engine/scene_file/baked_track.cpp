#include "engine/scene_file/baked_track.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "engine/pose/pose.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr int most_halvings = 12;
/// Slopes at the ends of an interval come from values at one and two of so many parts of it. Their error is the third
/// derivative times the square of a part.
constexpr double parts_for_slope = 1024.0;

double distance_of(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::distance(a, b);
}
double distance_of(const glm::dquat& a, const glm::dquat& b) {
    return turn_between(a, b);
}

glm::dvec3 halfway_between(const glm::dvec3& a, const glm::dvec3& b) {
    return 0.5 * (a + b);
}
glm::dquat halfway_between(const glm::dquat& a, const glm::dquat& b) {
    return slerp_short(a, b, 0.5);
}

template <class T>
class Baker {
  public:
    Baker(const Motion<T>& motion, const std::function<void(std::size_t)>& charge) : motion_(motion), charge_(charge) {
        track_.interpolation = piece_.interpolation = Interpolation::cubic;
        track_.sampling.kind = piece_.sampling.kind = TimeSampling::Kind::acyclic;
        piece_.sampling.times.resize(2);
        piece_.values.resize(6);
    }

    Track<T> bake(const std::vector<double>& times, const T& first) {
        T left = motion_.value(times.front(), first);
        add_key(times.front(), zero_, left);
        for (std::size_t i = 1; i < times.size(); ++i) {
            const T right = motion_.value(times[i], left);
            add_interval({times[i - 1], left}, {times[i], right}, 0);
            left = right;
        }
        leave_out_held_keys();
        if (track_.sampling.times.size() == 1) return Track<T>(left);
        return std::move(track_);
    }

  private:
    struct Key {
        double time;
        T value;
    };

    void add_key(double time, const T& in, const T& value) {
        charge_(baked_key_bytes<T>);
        track_.sampling.times.push_back(time);
        track_.values.insert(track_.values.end(), {in, value, zero_});
    }

    /// The slope at a key. @param step  s, into the interval. Exactly zero where nothing moves
    T slope(const Key& key, double step) const {
        const T near = motion_.value(key.time + step, key.value), far = motion_.value(key.time + 2.0 * step, key.value);
        return ((near - key.value) * 4.0 - (far - key.value)) * (0.5 / step);
    }

    bool is_close(const Key& left, const Key& right) {
        for (const double fraction : {0.25, 0.5, 0.75}) {
            const double time = left.time + fraction * (right.time - left.time);
            const double error = distance_of(evaluate(piece_, time), motion_.value(time, left.value));
            if (!(error <= motion_.tolerance)) return false;
        }
        return true;
    }

    void add_interval(const Key& left, const Key& right, int halvings) {
        const double step = (right.time - left.time) / parts_for_slope, middle = 0.5 * (left.time + right.time);
        T out = slope(left, step), in = slope(right, -step);
        piece_.sampling.times = {left.time, right.time};
        piece_.values = {zero_, left.value, out, in, right.value, zero_};
        if (!is_close(left, right)) {
            if (halvings < most_halvings && left.time < middle && middle < right.time) {
                const Key between{middle, motion_.value(middle, left.value)};
                add_interval(left, between, halvings + 1);
                add_interval(between, right, halvings + 1);
                return;
            }
            out = in = zero_;
            track_.values.back() = zero_;
            // Two quarter turns in place of half a turn, which has no short way.
            if (left.time < middle && middle < right.time)
                add_key(middle, zero_, halfway_between(left.value, right.value));
        }
        track_.values.back() = out;
        add_key(right.time, in, right.value);
    }

    /// True where the curve from a key to another stays at their value.
    bool is_held(std::size_t left, std::size_t right) const {
        const std::vector<T>& v = track_.values;
        return v[3 * left + 1] == v[3 * right + 1] && v[3 * left + 2] == zero_ && v[3 * right] == zero_;
    }

    void leave_out_held_keys() {
        const std::size_t count = track_.sampling.times.size();
        std::size_t kept = 0;  // the last key that stays
        for (std::size_t i = 1; i < count; ++i) {
            if (i + 1 < count && is_held(kept, i) && is_held(i, i + 1)) continue;
            ++kept;
            track_.sampling.times[kept] = track_.sampling.times[i];
            for (std::size_t part = 0; part < 3; ++part) track_.values[3 * kept + part] = track_.values[3 * i + part];
        }
        track_.sampling.times.resize(kept + 1);
        track_.values.resize(3 * (kept + 1));
    }

    const T zero_ = T() * 0.0;
    const Motion<T>& motion_;
    const std::function<void(std::size_t)>& charge_;
    Track<T> track_, piece_;
};

}  // namespace

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

template <class T>
Track<T> bake_track(const Motion<T>& motion, const std::vector<double>& times, const T& first,
                    const std::function<void(std::size_t)>& charge) {
    return Baker<T>(motion, charge).bake(times, first);
}

template Track<glm::dvec3> bake_track(const Motion<glm::dvec3>&, const std::vector<double>&, const glm::dvec3&,
                                      const std::function<void(std::size_t)>&);
template Track<glm::dquat> bake_track(const Motion<glm::dquat>&, const std::vector<double>&, const glm::dquat&,
                                      const std::function<void(std::size_t)>&);

}  // namespace aleph
