#include "engine/gltf/tracks.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "engine/base/errors.h"

namespace aleph {

namespace {

constexpr double doubtful_angle = 170.0 * std::numbers::pi / 180.0;  // radians

/// The earliest time that is stored as this float: a new value that is meant for a frame holds there, though the float
/// may lie behind the frame's time.
double earliest_of(double time) {
    const auto stored = static_cast<float>(time);
    return time > 0.0 ? 0.5 * (time + static_cast<double>(std::nextafter(stored, 0.0f))) : time;
}

std::vector<double> read_times(GltfReader& reader, int accessor, const std::string& place) {
    std::vector<double> times = reader.accessors.read<double>(accessor);
    for (std::size_t i = 0; i < times.size(); ++i) {
        if (times[i] < 0.0) {
            throw InputError(reader.source.file, place,
                             fmt::format("key {} lies at {} s: key times must not be negative", i, times[i]));
        }
        if (i > 0 && !(times[i] > times[i - 1])) {
            throw InputError(
                reader.source.file, place,
                fmt::format("key {} lies at {} s, the one before at {} s: key times must strictly increase", i,
                            times[i], times[i - 1]));
        }
    }
    return times;
}

/// Warns of the first two keys more than 170 degrees apart. Interpolation goes the short way, so a turn of 270 degrees
/// between two keys becomes one of -90.
void warn_of_large_steps(GltfReader& reader, const Track<glm::dquat>& track, const std::string& node) {
    for (std::size_t i = 1; i < track.values.size(); ++i) {
        const glm::dquat& a = track.values[i - 1];
        const glm::dquat b = glm::dot(a, track.values[i]) < 0.0 ? -track.values[i] : track.values[i];
        const double angle = 4.0 * std::atan2(glm::length(a - b), glm::length(a + b));
        if (angle > doubtful_angle) {
            reader.warn(node,
                        fmt::format("rotation keys {} and {} are {:.1f} degrees apart: the turn goes the short way",
                                    i - 1, i, angle * 180.0 / std::numbers::pi));
            return;
        }
    }
}

}  // namespace

GltfKeys read_keys(GltfReader& reader, const tinygltf::AnimationSampler& sampler, const std::string& place,
                   std::size_t row) {
    GltfKeys keys;
    keys.times = read_times(reader, sampler.input, place);
    keys.values = reader.accessors.read<double>(sampler.output);
    keys.row = row > 0 ? row : reader.accessors.components(sampler.output);
    keys.is_float = reader.accessors.is_float(sampler.output);
    if (sampler.interpolation == "STEP") {
        keys.interpolation = Interpolation::step;
        for (double& time : keys.times) time = earliest_of(time);
    }
    if (sampler.interpolation == "CUBICSPLINE") keys.interpolation = Interpolation::cubic;
    return keys;
}

bool clamp_keys(GltfKeys& keys, double low, double high, bool takes_zero) {
    bool clamped = false;
    for (std::size_t i = 0; i < keys.values.size(); ++i) {
        if (!keys.is_value(i / keys.row) || (takes_zero && keys.values[i] == 0.0)) continue;
        const double inside = std::clamp(keys.values[i], low, high);
        if (inside != keys.values[i]) clamped = true;
        keys.values[i] = inside;
    }
    return clamped;
}

Track<double> number_track(GltfReader& reader, const GltfKeys& keys, const std::string& place, std::size_t column) {
    return make_track<double>(reader, keys, place, [&](const double* row, std::size_t) { return row[column]; });
}

Track<glm::dvec3> vector_track(GltfReader& reader, const GltfKeys& keys, const std::string& place) {
    return make_track<glm::dvec3>(reader, keys, place,
                                  [](const double* row, std::size_t) { return glm::dvec3(row[0], row[1], row[2]); });
}

Track<glm::dquat> rotation_track(GltfReader& reader, const GltfKeys& keys, const std::string& place,
                                 const std::string& owner) {
    // The length that each key had, so that its tangents can follow.
    std::vector<double> lengths;
    std::size_t far_from_unit = 0;
    for (std::size_t i = 0; i < keys.rows(); ++i) {
        if (!keys.is_value(i)) continue;
        const UnitRotation unit =
            read_rotation(reader, &keys.values[4 * i], fmt::format("{}: {} key {}", place, owner, keys.key_of(i)));
        if (unit.was_far_from_unit(keys.is_float)) ++far_from_unit;
        lengths.push_back(unit.length);
    }
    if (far_from_unit > 0) {
        reader.warn(owner, fmt::format("{} rotation keys are not of length 1 and are normalized", far_from_unit));
    }
    Track<glm::dquat> track = make_track<glm::dquat>(reader, keys, place, [&](const double* row, std::size_t i) {
        if (keys.is_value(i)) return read_rotation(reader, row, place).rotation;
        return glm::dquat(row[3], row[0], row[1], row[2]) / lengths[keys.key_of(i)];
    });
    if (keys.interpolation == Interpolation::linear) warn_of_large_steps(reader, track, owner);
    return track;
}

}  // namespace aleph
