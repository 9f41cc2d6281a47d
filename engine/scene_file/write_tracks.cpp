// The writer of tracks. The reader: tracks.cpp.

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <numbers>

#include "engine/scene_file/tracks.h"

namespace aleph {

namespace {

using nlohmann::ordered_json;

/// The whole frame that the reader turns into exactly these seconds; nothing if there is none.
std::optional<std::int64_t> whole_frame(double seconds, const FrameRate& rate) {
    const double frame = std::round(seconds / rate.seconds_of(1));
    if (!(std::abs(frame) <= 1e9)) return std::nullopt;
    const auto number = static_cast<std::int64_t>(frame);
    const bool exact =
        rate.seconds_of(number) == seconds && std::signbit(rate.seconds_of(number)) == std::signbit(seconds);
    return exact ? std::optional(number) : std::nullopt;
}

bool has_whole_frames(const TimeSampling& sampling, const FrameRate& rate) {
    if (sampling.kind != TimeSampling::Kind::acyclic && !whole_frame(sampling.period, rate)) return false;
    if (sampling.kind == TimeSampling::Kind::uniform && !whole_frame(sampling.start, rate)) return false;
    return std::all_of(sampling.times.begin(), sampling.times.end(),
                       [&](double time) { return whole_frame(time, rate).has_value(); });
}

template <class T, class Write>
ordered_json write_track(const Track<T>& track, const FrameRate& rate, const Write& write,
                         Interpolation absent = Interpolation::linear) {
    if (track.values.size() == 1 && track == Track<T>(track.values.front())) return write(track.values.front());
    const bool cubic = track.interpolation == Interpolation::cubic;
    const bool with_time = track.sampling.kind == TimeSampling::Kind::acyclic;
    std::vector<ordered_json> values;
    for (std::size_t key = 0; key < track.key_count(); ++key) {
        if (!cubic) {
            values.push_back(write(track.values[key]));
            continue;
        }
        ordered_json item = ordered_json::array();
        for (std::size_t part = 0; part < 3; ++part) item.push_back(write(track.values[3 * key + part]));
        values.push_back(std::move(item));
    }
    ordered_json out = ordered_json::object();
    if (track.interpolation != absent) out["interpolation"] = interpolation_words[index_of(track.interpolation)];
    out.update(write_samples(track.sampling, rate, std::move(values)));
    if (!cubic || !with_time) return out;
    for (ordered_json& key : out["keys"]) {  // [time, [in, value, out]] to [time, in, value, out]
        const ordered_json parts = std::move(key[1]);
        key.erase(1);
        for (const ordered_json& part : parts) key.push_back(part);
    }
    return out;
}

ordered_json write_plain(double value) {
    return value;
}

}  // namespace

ordered_json write_samples(const TimeSampling& sampling, const FrameRate& rate, std::vector<ordered_json> values) {
    const bool in_frames = has_whole_frames(sampling, rate);
    const auto time = [&](double seconds) {
        return in_frames ? ordered_json(*whole_frame(seconds, rate)) : ordered_json(seconds);
    };
    ordered_json out = ordered_json::object();
    if (!in_frames) out["unit"] = "seconds";
    if (sampling.kind == TimeSampling::Kind::acyclic) {
        for (std::size_t key = 0; key < values.size(); ++key) {
            out["keys"].push_back(ordered_json::array({time(sampling.times.at(key)), std::move(values[key])}));
        }
        return out;
    }
    if (sampling.kind == TimeSampling::Kind::cyclic) {
        for (const double seconds : sampling.times) out["cycle"].push_back(time(seconds));
    } else if (sampling.start != 0.0 || std::signbit(sampling.start)) {
        out["start"] = time(sampling.start);
    }
    if (sampling.period != (in_frames ? rate.seconds_of(1) : 1.0)) out["period"] = time(sampling.period);
    out["values"] = std::move(values);
    return out;
}

ordered_json write_dvec3(const glm::dvec3& v) {
    return ordered_json::array({v.x, v.y, v.z});
}

ordered_json write_number(const Track<double>& track, const FrameRate& rate) {
    return write_track(track, rate, write_plain);
}

ordered_json write_vector(const Track<glm::dvec3>& track, const FrameRate& rate) {
    return write_track(track, rate, write_dvec3);
}

ordered_json write_scale(const Track<glm::dvec3>& track, const FrameRate& rate) {
    return write_track(track, rate, [](const glm::dvec3& v) -> ordered_json {
        if (v.x == v.y && v.x == v.z) return v.x;
        return write_dvec3(v);
    });
}

ordered_json write_quaternion(const Track<glm::dquat>& track, const FrameRate& rate) {
    return write_track(track, rate, [](const glm::dquat& q) { return ordered_json::array({q.x, q.y, q.z, q.w}); });
}

ordered_json write_matrix(const Track<glm::dmat4>& track, const FrameRate& rate) {
    return write_track(track, rate, [](const glm::dmat4& m) {
        ordered_json rows = ordered_json::array();
        for (int i = 0; i < 16; ++i) rows.push_back(m[i % 4][i / 4]);
        return rows;
    });
}

ordered_json write_visibility(const Track<double>& track, const FrameRate& rate) {
    return write_track(
        track, rate,
        [](double visible) { return visible == 2.0 ? ordered_json("always") : ordered_json(visible != 0.0); },
        Interpolation::step);
}

std::optional<double> exact_degrees(double radians) {
    const double near = radians * (180.0 / std::numbers::pi);
    for (int digits = 6; digits <= 17; ++digits) {  // the shortest first
        const std::string text = fmt::format("{:.{}g}", near, digits);
        double degrees = near;
        std::from_chars(text.data(), text.data() + text.size(), degrees);
        if (to_radians(degrees) == radians) return degrees;
    }
    double below = near, above = near;
    for (int i = 0; i < 4; ++i) {
        below = std::nextafter(below, -std::numeric_limits<double>::infinity());
        above = std::nextafter(above, std::numeric_limits<double>::infinity());
        if (to_radians(below) == radians) return below;
        if (to_radians(above) == radians) return above;
    }
    return std::nullopt;
}

std::optional<ordered_json> write_degrees(const Track<double>& track, const FrameRate& rate) {
    for (const double radians : track.values) {
        if (!exact_degrees(radians)) return std::nullopt;
    }
    return write_track(track, rate, [](double radians) { return ordered_json(exact_degrees(radians).value_or(0.0)); });
}

}  // namespace aleph
