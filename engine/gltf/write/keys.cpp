#include "engine/gltf/write/keys.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "engine/scene/operations.h"
#include "engine/scene/transforms.h"

namespace aleph {

namespace {

constexpr float infinite = std::numeric_limits<float>::infinity();

float float_at_most(double t) {
    const auto f = static_cast<float>(t);
    return double{f} > t ? std::nextafter(f, -infinite) : f;
}
float float_above(double t) {
    const auto f = static_cast<float>(t);
    return double{f} > t ? f : std::nextafter(f, infinite);
}

/// Where the value of key i begins to hold, s.
template <class T>
double step_time(const Track<T>& track, std::size_t i) {
    const double own = sample_time(track.sampling, i);
    if (track.interpolation != Interpolation::nearest || i == 0) return own;
    const double before = sample_time(track.sampling, i - 1);
    return before + 0.5 * (own - before);
}

template <class T>
WrittenKeys make_step_keys(const Track<T>& track) {
    WrittenKeys keys;
    keys.interpolation = Interpolation::step;
    keys.row = components(track.values[0]).size();
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        const double t = step_time(track, i);
        // In the middle between two keys the earlier one is still the nearest.
        const bool is_middle = track.interpolation == Interpolation::nearest && i > 0;
        const float time = std::max(is_middle ? float_above(t) : float_at_most(t), 0.0f);
        if (!keys.times.empty() && time <= keys.times.back()) {  // the later one holds
            keys.times.pop_back();
            keys.values.resize(keys.values.size() - keys.row);
        }
        const T value = evaluate(track, sample_time(track.sampling, i));
        keys.append(time, components(value));
    }
    return keys;
}

/// Times of linear keys.
template <class T>
std::vector<double> list_times(const Track<T>& track) {
    std::vector<double> times;
    for (std::size_t i = 0; i < track.key_count(); ++i) times.push_back(sample_time(track.sampling, i));
    if constexpr (std::is_same_v<T, glm::dquat>) return split_turns(times, track);
    return times;
}

template <class T>
WrittenKeys make_cubic_keys(const Track<T>& track) {
    WrittenKeys keys;
    keys.interpolation = Interpolation::cubic;
    keys.row = components(track.values[0]).size();
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        keys.times.push_back(static_cast<float>(sample_time(track.sampling, i)));
        double factor = 1.0;  // brings a key to its valid length
        if constexpr (std::is_same_v<T, glm::dquat>) factor = 1.0 / glm::length(key_value(track, i));
        for (std::size_t k = 3 * i; k < 3 * i + 3; ++k)
            for (const double number : components(track.values[k]))
                keys.values.push_back(static_cast<float>(number * factor));
    }
    return keys;
}

}  // namespace

void sort_and_unite(std::vector<double>& times) {
    std::sort(times.begin(), times.end());
    times.erase(std::unique(times.begin(), times.end()), times.end());
}

bool WrittenKeys::is_constant() const {
    if (interpolation == Interpolation::cubic) return false;
    for (std::size_t i = row; i < values.size(); ++i)
        if (values[i] != values[i - row]) return false;
    return true;
}

void WrittenKeys::append(float time, std::span<const double> value) {
    double dot = 0.0;
    if (value.size() == 4 && !values.empty() && interpolation == Interpolation::linear)
        for (std::size_t k = 0; k < 4; ++k) dot += value[k] * double{values[values.size() - 4 + k]};
    const double sign = dot < 0.0 ? -1.0 : 1.0;
    times.push_back(time);
    for (const double number : value) values.push_back(static_cast<float>(sign * number));
}

std::vector<double> split_turns(const std::vector<double>& times, const Track<glm::dquat>& rotation) {
    std::vector<double> split;
    for (const double t : times) {
        if (!split.empty() && rotation.interpolation == Interpolation::linear &&
            turn_between(evaluate(rotation, split.back()), evaluate(rotation, t)) > max_key_turn) {
            split.push_back(split.back() + 0.5 * (t - split.back()));
        }
        split.push_back(t);
    }
    return split;
}

std::vector<KeyTime> round_times(const std::vector<double>& ascending) {
    std::vector<KeyTime> keys;
    const auto first = std::upper_bound(ascending.begin(), ascending.end(), 0.0);  // the first after 0 s
    if (first != ascending.begin()) keys.push_back({});
    for (auto t = first; t != ascending.end(); ++t) {
        const auto time = static_cast<float>(*t);
        if (!std::isfinite(time)) break;
        // A jump is two keys that floats may not tell apart: it keeps their values, and one float lies between them.
        const double gap = std::min(t == ascending.begin() ? *t : *t - *std::prev(t),
                                    std::next(t) == ascending.end() ? *t : *std::next(t) - *t);
        const bool is_near = std::abs(double{time} - *t) <= 0.25 * gap;
        const double at = is_near ? double{time} : *t;
        if (!keys.empty() && time <= keys.back().time) {
            const float before = std::nextafter(keys.back().time, -infinite);
            const bool has_room = before >= 0.0f && (keys.size() == 1 || keys[keys.size() - 2].time < before);
            if (has_room) {
                keys.back().time = before;
                keys.push_back({time, *t, at});
            } else {
                keys.back() = {keys.back().time, *t, at};
            }
        } else {
            keys.push_back({time, *t, at});
        }
    }
    return keys;
}

template <class T>
WrittenKeys make_keys(const Track<T>& track) {
    switch (track.interpolation) {
        case Interpolation::linear:
            return make_sampled_keys(round_times(list_times(track)), [&](double t) { return evaluate(track, t); });
        case Interpolation::cubic:
            return make_cubic_keys(track);
        default:
            return make_step_keys(track);
    }
}

template <class T>
bool has_exact_keys(const Track<T>& track) {
    if (track.interpolation != Interpolation::cubic) return true;
    float last = -infinite;
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        const double t = sample_time(track.sampling, i);
        const auto time = static_cast<float>(t);
        if (t < 0.0 || !(time > last) || !std::isfinite(time)) return false;
        last = time;
    }
    return true;
}

void SampledTimes::add(const TimeSampling& sampling, std::size_t count) {
    for (std::size_t i = 0; count > 1 && i < count; ++i) smooth.push_back(sample_time(sampling, i));
}

void SampledTimes::add(const OperationStack& stack) {
    add(stack.sampling, sample_count(stack));
}

template <class T>
void SampledTimes::add(const Track<T>& track) {
    if (!is_animated(track)) return;
    const bool jumps = track.interpolation == Interpolation::step || track.interpolation == Interpolation::nearest;
    for (std::size_t i = 0; i < track.key_count(); ++i) {
        const double t = step_time(track, i);
        if (track.interpolation == Interpolation::nearest && i > 0) {
            steps.push_back(double{float_above(t)});
        } else {
            (jumps ? steps : smooth).push_back(t);
        }
    }
}

FrameRange SampledTimes::find_frames(const FrameRate& rate, const FrameRange& range) const {
    double first = std::numeric_limits<double>::infinity(), last = -first;
    for (const auto* times : {&smooth, &steps}) {
        for (const double t : *times) {
            first = std::min(first, t);
            last = std::max(last, t);
        }
    }
    const double begin = std::max({std::ceil(first * rate.per_second()), static_cast<double>(range.first), 0.0});
    const double end = std::min(std::floor(last * rate.per_second()), static_cast<double>(range.last));
    if (!(begin <= end)) return {0, -1};
    return {static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end)};
}

std::vector<KeyTime> SampledTimes::make_key_times() const {
    std::vector<double> jumps = steps, others = smooth;
    sort_and_unite(jumps);
    sort_and_unite(others);
    std::vector<KeyTime> keys = round_times(others);
    for (const double t : jumps) {
        const float on = float_at_most(t), before = std::nextafter(on, -infinite);
        if (on > 0.0f) keys.push_back({before, double{before}, double{before}});
        keys.push_back({std::max(on, 0.0f), std::max(t, 0.0), std::max(t, 0.0)});
    }
    // At equal times the key of a jump comes last, and holds.
    std::stable_sort(keys.begin(), keys.end(), [](const KeyTime& a, const KeyTime& b) { return a.time < b.time; });
    std::vector<KeyTime> united;
    for (const KeyTime& key : keys) {
        if (!united.empty() && united.back().time == key.time) united.pop_back();
        united.push_back(key);
    }
    return united;
}

std::optional<WrittenKeys> join_columns(std::span<const KeyColumn> columns) {
    WrittenKeys joined;
    joined.row = 0;
    for (const KeyColumn& column : columns) {
        const WrittenKeys& keys = column.keys;
        joined.row += keys.times.empty() ? column.constant.size() : keys.row;
        if (keys.times.empty()) continue;
        if (joined.times.empty()) {
            joined.times = keys.times;
            joined.interpolation = keys.interpolation;
        }
        if (joined.times != keys.times || joined.interpolation != keys.interpolation) return std::nullopt;
    }
    const std::size_t rows_per_key = joined.interpolation == Interpolation::cubic ? 3 : 1;
    const std::size_t rows = joined.times.size() * rows_per_key;
    joined.values.reserve(rows * joined.row);
    for (std::size_t i = 0; i < rows; ++i) {
        const bool is_tangent = rows_per_key == 3 && i % 3 != 1;
        for (const KeyColumn& column : columns) {
            if (column.keys.times.empty()) {
                for (const double number : column.constant)
                    joined.values.push_back(is_tangent ? 0.0f : static_cast<float>(number));
            } else {
                const auto row = column.keys.values.begin() + static_cast<std::ptrdiff_t>(i * column.keys.row);
                joined.values.insert(joined.values.end(), row, row + static_cast<std::ptrdiff_t>(column.keys.row));
            }
        }
    }
    return joined;
}

#define ALEPH_INSTANTIATE_KEYS(T)                    \
    template WrittenKeys make_keys(const Track<T>&); \
    template bool has_exact_keys(const Track<T>&);   \
    template void SampledTimes::add(const Track<T>&);
ALEPH_INSTANTIATE_KEYS(double)
ALEPH_INSTANTIATE_KEYS(glm::dvec3)
ALEPH_INSTANTIATE_KEYS(glm::dquat)
#undef ALEPH_INSTANTIATE_KEYS
template void SampledTimes::add(const Track<glm::dmat4>&);

}  // namespace aleph
