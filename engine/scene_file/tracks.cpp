#include "engine/scene_file/tracks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>
#include <type_traits>

#include "engine/scene/transforms.h"

namespace aleph {

namespace {

template <class T>
struct ValueReader {
    T (*value)(const JsonRef&, const ValueRange&);
    ValueRange range = any_value;  ///< of values; tangents have none

    T read(const JsonRef& at) const { return value(at, range); }
    T read_tangent(const JsonRef& at) const { return value(at, any_value); }
};

double read_time(const JsonRef& at, const FrameRate& rate, bool in_frames) {
    const double time = at.number();
    return in_frames ? time * static_cast<double>(rate.denominator) / static_cast<double>(rate.numerator) : time;
}

std::vector<double> read_times(const JsonRef& list, std::size_t count, const FrameRate& rate, bool in_frames,
                               bool first_of_key) {
    std::vector<double> times;
    times.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        const JsonRef element = list[i], at = first_of_key ? element[0] : element;
        times.push_back(read_time(at, rate, in_frames));
        if (i > 0 && !(times[i] > times[i - 1])) {
            at.fail(fmt::format("times have to ascend: {} is not above the time before", at.json().dump()));
        }
    }
    return times;
}

Interpolation read_interpolation(const JsonRef& at, Interpolation absent) {
    const auto word = at.find_string("interpolation");
    if (!word) return absent;
    const auto found = std::ranges::find(interpolation_words, *word);
    if (found == interpolation_words.end()) return Interpolation::linear;  // an easing, by the schema
    return static_cast<Interpolation>(found - interpolation_words.begin());
}

/// @param list       of "keys", or of "values"
/// @param with_time  each element begins with its time
template <class T>
void read_list(const JsonRef& list, bool with_time, Track<T>& track, const ValueReader<T>& read) {
    const bool cubic = track.interpolation == Interpolation::cubic;
    const std::size_t first = with_time ? 1 : 0, end = first + (cubic ? 3 : 1);
    for (const JsonRef item : list.elements()) {
        if (!with_time && !cubic) {
            track.values.push_back(read.read(item));
            continue;
        }
        if (with_time && item.array_size() != end) {
            item.fail(cubic ? "a cubic key is [time, in-tangent, value, out-tangent]"
                            : "a key is [time, value]; tangents need \"interpolation\": \"cubic\"");
        }
        if (!item.json().is_array() || item.array_size() != end) {
            item.fail("a cubic value is [in-tangent, value, out-tangent]");
        }
        for (std::size_t part = first; part < end; ++part) {
            const JsonRef value = item[part];
            track.values.push_back(cubic && part != first + 1 ? read.read_tangent(value) : read.read(value));
        }
    }
}

TimeSampling read_regular_times(const JsonRef& at, const FrameRate& rate, bool in_frames) {
    TimeSampling sampling;
    const auto start = at.find("start"), period = at.find("period"), cycle = at.find("cycle");
    sampling.period = period ? read_time(*period, rate, in_frames) : in_frames ? rate.seconds_of(1) : 1.0;
    if (!(sampling.period > 0.0)) period->fail("has to be above 0");
    if (start) sampling.start = read_time(*start, rate, in_frames);
    if (cycle) {
        if (start) start->fail("\"start\" does not go with \"cycle\": its times say when it starts");
        sampling.kind = TimeSampling::Kind::cyclic;
        sampling.times = read_times(*cycle, cycle->array_size(), rate, in_frames, false);
        if (!(sampling.times.back() - sampling.times.front() < sampling.period)) {
            cycle->fail("the times of a cycle have to lie within one \"period\"");
        }
    }
    return sampling;
}

TimeSampling read_sampling(const JsonRef& at, const FrameRate& rate) {
    const bool in_frames = at.find_string("unit").value_or("frames") == "frames";
    const auto keys = at.find("keys"), values = at.find("values");
    if (keys && values) at.fail("either \"keys\" or \"values\", not both");
    if (!keys && !values) at.fail("neither \"keys\" nor \"values\"");
    if (values) return read_regular_times(at, rate, in_frames);
    for (const char* other : {"start", "period", "cycle"}) {
        if (const auto found = at.find(other)) {
            found->fail(fmt::format("\"{}\" goes with \"values\"; keys have their own times", other));
        }
    }
    TimeSampling sampling;
    sampling.kind = TimeSampling::Kind::acyclic;
    sampling.times = read_times(*keys, keys->array_size(), rate, in_frames, true);
    return sampling;
}

template <class T>
Track<T> read_track(const JsonRef& at, const FrameRate& rate, const ValueReader<T>& read,
                    Interpolation absent = Interpolation::linear) {
    Track<T> track;
    if (!at.json().is_object()) {
        track = Track<T>(read.read(at));
    } else {
        track.interpolation = read_interpolation(at, absent);
        track.sampling = read_sampling(at, rate);
        if (const auto keys = at.find("keys")) read_list(*keys, true, track, read);
        if (const auto values = at.find("values")) read_list(*values, false, track, read);
    }
    validate(track, at.file(), at.pointer());
    if constexpr (!std::is_same_v<T, glm::dmat4>) {
        if (at.json().is_object()) track = apply_easing(at, std::move(track));
    }
    return track;
}

template <class T>
T read_components(const JsonRef& at, T value, int count, const ValueRange& range) {
    for (int i = 0; i < count; ++i) value[i] = read_plain(at[i], range);
    return value;
}

glm::dvec3 read_three(const JsonRef& at, const ValueRange& range) {
    return read_components(at, glm::dvec3(0.0), 3, range);
}

glm::dvec3 read_factors(const JsonRef& at, const ValueRange&) {
    return at.json().is_number() ? glm::dvec3(at.number()) : read_dvec3(at);
}

/// x, y, z, w. A zero value is found by validate: tangents may be zero.
glm::dquat read_four(const JsonRef& at, const ValueRange&) {
    const glm::dvec4 v = read_components(at, glm::dvec4(0.0), 4, any_value);
    return {v.w, v.x, v.y, v.z};
}

glm::dmat4 read_sixteen(const JsonRef& at, const ValueRange&) {
    glm::dmat4 m(1.0);
    for (int i = 0; i < 16; ++i) {
        const JsonRef number = at[i];
        m[i % 4][i / 4] = number.number();
        if (i >= 12 && m[i % 4][3] != (i == 15 ? 1.0 : 0.0))
            number.fail("the last row of a matrix has to be 0, 0, 0, 1");
    }
    return m;
}

}  // namespace

double read_plain(const JsonRef& at, const ValueRange& range) {
    const double value = at.number();
    if (!range.holds(value)) at.fail(describe_outside(range, value));
    return value;
}

double to_radians(double degrees) {
    return degrees * (std::numbers::pi / 180.0);
}

TimeSampling read_samples(const JsonRef& at, const FrameRate& rate, const std::function<void(const JsonRef&)>& visit) {
    TimeSampling sampling = read_sampling(at, rate);
    const auto keys = at.find("keys");
    const JsonRef list = keys ? *keys : at.require("values");
    for (const JsonRef item : list.elements()) visit(keys ? item[1] : item);
    validate(sampling, list.array_size(), at.file(), at.pointer());
    return sampling;
}

glm::dvec3 read_dvec3(const JsonRef& at) {
    return read_three(at, any_value);
}

glm::dvec2 read_dvec2(const JsonRef& at) {
    return read_components(at, glm::dvec2(0.0), 2, any_value);
}

Track<double> read_number(const JsonRef& at, const FrameRate& rate, const ValueRange& range) {
    return read_track<double>(at, rate, {read_plain, range});
}

Track<double> read_degrees(const JsonRef& at, const FrameRate& rate, const ValueRange& range) {
    const auto read = [](const JsonRef& value, const ValueRange& limits) {
        return to_radians(read_plain(value, limits));
    };
    return read_track<double>(at, rate, {read, range});
}

Track<glm::dvec3> read_vector(const JsonRef& at, const FrameRate& rate, const ValueRange& range) {
    return read_track<glm::dvec3>(at, rate, {read_three, range});
}

Track<glm::dvec3> read_scale(const JsonRef& at, const FrameRate& rate) {
    return read_track<glm::dvec3>(at, rate, {read_factors});
}

Track<glm::dquat> read_quaternion(const JsonRef& at, const FrameRate& rate) {
    return read_track<glm::dquat>(at, rate, {read_four});
}

std::optional<AxisRotation> read_axis_rotation(const JsonRef& at, const FrameRate& rate) {
    const auto axis = at.json().is_object() ? at.find("axis") : std::nullopt;
    if (!axis) return std::nullopt;
    AxisRotation rotation;
    const glm::dvec3 given = read_dvec3(*axis);
    const glm::dvec3 unit = safe_normalize(given);
    if (unit == glm::dvec3(0.0)) axis->fail("the axis cannot be zero");
    // An axis that is unit within rounding keeps its bits.
    rotation.axis = std::abs(glm::length(given) - 1.0) < 1e-15 ? given : unit;
    const auto degrees = at.find("degrees"), radians = at.find("radians");
    if (degrees.has_value() == radians.has_value()) at.fail("an axis goes with either \"degrees\" or \"radians\"");
    rotation.angle = degrees ? read_degrees(*degrees, rate, any_value) : read_number(*radians, rate, any_value);
    return rotation;
}

Track<glm::dmat4> read_matrix(const JsonRef& at, const FrameRate& rate) {
    return read_track<glm::dmat4>(at, rate, {read_sixteen});
}

Track<double> read_visibility(const JsonRef& at, const FrameRate& rate) {
    const auto read = [](const JsonRef& value, const ValueRange&) {
        if (value.json().is_string()) return 2.0;  // "always", by the schema
        return value.boolean() ? 1.0 : 0.0;
    };
    return read_track<double>(at, rate, {read}, Interpolation::step);
}

}  // namespace aleph
