#pragma once
// Tracks as keys of glTF samplers: times and values are floats, times are not negative.
//
// A key's time moves to a float near it. Where values interpolate, the value is the track's at that float, so that the
// keys lie on the track. Where they step, the time moves down, so that the new value holds at the track's own time.

#include <optional>
#include <span>
#include <vector>

#include "engine/scene/components.h"
#include "engine/scene/scene.h"

namespace aleph {

struct WrittenKeys {
    Interpolation interpolation = Interpolation::linear;  ///< step, linear or cubic
    std::vector<float> times;                             ///< s, ascending
    std::vector<float> values;                            ///< row by row; cubic: rows of in-tangent, value, out-tangent
    std::size_t row = 1;                                  ///< numbers in a row

    /// True where the value never changes.
    bool is_constant() const;
    /// Adds a row. A rotation gets the sign that is near the row before it.
    void append(float time, std::span<const double> value);
};

/// A key's time in the file.
struct KeyTime {
    float time = 0.0f;
    double own = 0.0;  ///< the time that the float stands for, s
    double at = 0.0;   ///< at which the track has the key's value, s
};

/// The values of keys. Where a value holds from one key to the next, and at both ends, they are those at the keys' own
/// times: what rests keeps its bits.
/// @param value  from a time in s
template <class Function>
auto sample_keys(const std::vector<KeyTime>& keys, const Function& value) {
    std::vector<decltype(value(0.0))> own, values;
    for (const KeyTime& key : keys) own.push_back(value(key.own));
    for (std::size_t i = 0; i < keys.size(); ++i) {
        const bool is_end = i == 0 || i + 1 == keys.size();
        const bool rests = !is_end && (own[i] == own[i - 1] || own[i] == own[i + 1]);
        values.push_back(is_end || rests || keys[i].at == keys[i].own ? own[i] : value(keys[i].at));
    }
    return values;
}

/// Linear keys at these times. @param value  from a time in s
template <class Function>
WrittenKeys make_sampled_keys(const std::vector<KeyTime>& times, const Function& value) {
    const auto values = sample_keys(times, value);
    WrittenKeys keys;
    keys.row = decltype(components(values[0]))::extent;
    for (std::size_t i = 0; i < times.size(); ++i) keys.append(times[i].time, components(values[i]));
    return keys;
}

void sort_and_unite(std::vector<double>& times);

/// Times at which something is sampled that glTF cannot interpolate.
struct SampledTimes {
    std::vector<double> smooth;  ///< s
    std::vector<double> steps;   ///< s, where the value jumps

    template <class T>
    void add(const Track<T>& track);
    void add(const TimeSampling& sampling, std::size_t count);
    void add(const OperationStack& stack);
    std::size_t count() const { return smooth.size() + steps.size(); }
    /// The frames of a range from the first to the last of these times; the last is below the first for none.
    FrameRange find_frames(const FrameRate& rate, const FrameRange& range) const;
    /// Where a jump is, one key lies before it and one on it.
    std::vector<KeyTime> make_key_times() const;
};

/// Rotations further apart than this, radians, get keys between them: readers that interpolate quaternions straight, or
/// round them before they look for the short way, then turn the same way.
inline constexpr double max_key_turn = 2.0;

/// Floats for times that interpolate: ascending, without those before 0 s, which holds the last of them.
std::vector<KeyTime> round_times(const std::vector<double>& ascending);

/// The keys of a track whose has_exact_keys. Instantiated for double, dvec3, dquat.
template <class T>
WrittenKeys make_keys(const Track<T>& track);

/// False for cubic tracks with keys before 0 s, or closer than floats can tell apart.
template <class T>
bool has_exact_keys(const Track<T>& track);

/// Numbers of a row that change together, or do not change.
struct KeyColumn {
    WrittenKeys keys;
    std::vector<double> constant;  ///< where there are no keys
};

/// Rows of all columns, one beside the other; nothing where the keys of two lie at other times or interpolate
/// otherwise.
std::optional<WrittenKeys> join_columns(std::span<const KeyColumn> columns);

/// Key times, and times between them where `rotation` turns by more than max_key_turn.
std::vector<double> split_turns(const std::vector<double>& times, const Track<glm::dquat>& rotation);

}  // namespace aleph
